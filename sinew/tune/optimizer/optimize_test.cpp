// Generations of real runs: the candidates do not depend on the number of threads or on
// interruptions, and a study continues from its file.
#include "sinew/tune/optimizer/optimize.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "sinew/config/diagnostics.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/tune/optimizer/tuned_text.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::tune::optimize_test {
namespace {

namespace fs = std::filesystem;

const std::string root = sinew::test::source_dir();
const std::string lever = root + "/experiments/one-joint.toml";

TuningFile lever_file() {
  TuningFile out;
  out.title = "A lever that follows";
  out.experiment = lever;
  out.set = {"sequence.repeat=1"};
  out.tune = {"joint.lever.angle_gain=0.01:0.3 %/count log",
              "control.stiffness.lever=4:20 lbf in/rad"};
  out.minimize = {"joints.lever.tracking_rms_rad [deg]"};
  out.where = {"joints.lever.passiveness >= 50 %"};
  out.population = 6;
  out.generations = 3;
  return out;
}

Tuning lever_tuning(const TuningFile& file = lever_file()) {
  return tuning_of(root + "/studies/lever.toml", file);
}

std::string text_of(const std::vector<Candidate>& candidates) {
  std::string out;
  for (const Candidate& c : candidates) {
    for (const std::string& cell : candidate_cells(c)) out += cell + ",";
    out += "\n";
  }
  return out;
}

using test::message;

class OptimizeTest : public ::testing::Test {
 protected:
  OptimizeTest() { fs::create_directories(folder_); }
  ~OptimizeTest() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::temp_directory_path() / ("sinew-optimize-" + std::to_string(getpid()));
  const fs::path file_ = folder_ / "study.db";
};

TEST_F(OptimizeTest, BeginsWithWhatTheExperimentHas) {
  const Tuning t = lever_tuning();
  const Tuned tuned = optimize(t, {});
  ASSERT_EQ(tuned.candidates.size(), 18U);
  const experiment::Experiment e = run::buildable(lever, {"sequence.repeat=1"});
  const config::Origin* gain = config::find_origin(e.origins, "joint.lever.angle_gain");
  ASSERT_NE(gain, nullptr);
  EXPECT_TRUE(gain->text.starts_with(tuned.candidates[0].values[0].cell)) << gain->text;
  const RunResult result = run_once(lever, {"sequence.repeat=1"});
  EXPECT_NEAR(tuned.candidates[0].evaluation.goals[0],
              *result.summary.find("joints.lever.tracking_rms_rad") * 180 / M_PI, 1e-6);
}

TEST_F(OptimizeTest, FindsABetterOneThatIsOneWhenItIsRunAgain) {
  TuningFile file = lever_file();
  file.generations = 8;
  const Tuning t = lever_tuning(file);
  const Tuned tuned = optimize(t, {.runs = {.threads = 2}});
  ASSERT_EQ(tuned.best.size(), 1U);
  const Candidate& best = tuned.candidates[tuned.best[0]];
  EXPECT_LT(best.evaluation.goals[0], 0.9 * tuned.candidates[0].evaluation.goals[0]);
  EXPECT_EQ(best.evaluation.violation, 0);

  const auto reported_end = [&](std::size_t end) {
    Tuned moved = tuned;
    moved.candidates[moved.best[0]].values[0] = t.runs.sample->ranges[0].axis.values[end];
    return text_of(t, moved, nullptr);
  };
  EXPECT_NE(reported_end(0).find("is at the lower end of its range"), std::string::npos);
  EXPECT_NE(reported_end(1).find("is at the upper end of its range"), std::string::npos);
  // Runs the file that is written for the candidate.
  const fs::path written = folder_ / "best.toml";
  std::ofstream(written) << experiment_of(t, best, written);
  const RunResult again = run_once(written.string(), {});
  ASSERT_TRUE(again.ok()) << again.status;
  EXPECT_EQ(t.goals.goals[0].figure.cell(again.summary), row_of(best).cells[2])
      << experiment_of(t, best, written);
}

TEST_F(OptimizeTest, IsTheSameForAnyThreadsAndLanes) {
  const Tuning t = lever_tuning();
  const std::string alone = text_of(optimize(t, {.runs = {.threads = 1, .lanes = 1}}).candidates);
  EXPECT_EQ(text_of(optimize(t, {.runs = {.threads = 3}}).candidates), alone);
}

// A study that is stopped after any number of runs and continued is the same, without repeated
// runs.
TEST_F(OptimizeTest, GoesOnFromItsFile) {
  const Tuning t = lever_tuning();
  const std::string whole = text_of(optimize(t, {}).candidates);
  for (const int stop_after : {1, 7, 12, 17}) {
    fs::remove(file_);
    std::atomic<bool> stop{false};
    std::atomic<std::int64_t> runs{0};
    StoredTuningOptions first{.tune = {.runs = {.threads = 1, .lanes = 1, .stop = &stop}}};
    first.tune.runs.progress = &runs;
    std::thread stopper([&] {
      while (runs.load() < stop_after) std::this_thread::yield();
      stop = true;
    });
    const Tuned part = optimize_and_store(t, file_, first);
    stopper.join();
    EXPECT_TRUE(part.stopped || stop_after >= 12);
    const StoredStudy held = read_results(file_);
    EXPECT_GE(held.rows.size(), std::size_t(stop_after));
    StoredTuningOptions second{};
    std::vector<std::string> notes;
    second.notices.on_note = [&](std::string_view note) { notes.emplace_back(note); };
    const Tuned all = optimize_and_store(t, file_, second);
    EXPECT_EQ(text_of(all.candidates), whole);
    ASSERT_FALSE(notes.empty());
    EXPECT_NE(notes[0].find(std::to_string(held.rows.size()) + " of 18 runs are there"),
              std::string::npos)
        << notes[0];
    const StoredStudy end = read_results(file_);
    EXPECT_EQ(end.rows.size(), 18U);
    EXPECT_EQ(end.candidates.size(), 18U);
  }
}

TEST_F(OptimizeTest, MoreGenerationsGoOnWithTheSameStudy) {
  TuningFile file = lever_file();
  optimize_and_store(lever_tuning(file), file_, {});
  file.generations = 4;
  const Tuned more = optimize_and_store(lever_tuning(file), file_, {});
  EXPECT_EQ(more.candidates.size(), 24U);
  EXPECT_EQ(text_of(more.candidates), text_of(optimize(lever_tuning(file), {}).candidates));
  EXPECT_EQ(read_results(file_).request.points, 24U);
}

TEST_F(OptimizeTest, AnotherTuningIsRefused) {
  TuningFile file = lever_file();
  file.generations = 1;
  optimize_and_store(lever_tuning(file), file_, {});
  file.where = {"joints.lever.passiveness >= 60 %"};
  const std::string words = message([&] { optimize_and_store(lever_tuning(file), file_, {}); });
  EXPECT_NE(words.find("where = joints.lever.passiveness >= 50 %"), std::string::npos) << words;
  EXPECT_NE(words.find("60 %"), std::string::npos) << words;
}

// Rows of a file that another program wrote are refused.
TEST_F(OptimizeTest, RowsOfOtherCandidatesAreRefused) {
  TuningFile file = lever_file();
  file.generations = 1;
  const Tuning t = lever_tuning(file);
  std::vector<Row> rows;
  optimize(t, {.runs = {.done = [&](const Row& row) { rows.push_back(row); }}});
  std::ranges::sort(rows, {}, &Row::point);
  rows[3].cells[1] = "12.345";
  const std::string words = message([&] { optimize(t, {.runs = {.known = rows}}); });
  EXPECT_NE(words.find("point 3 has control.stiffness.lever [lbf in/rad] = 12.345; expected"),
            std::string::npos)
      << words;
}

TEST_F(OptimizeTest, WithoutInformationItReportsThat) {
  TuningFile file = lever_file();
  file.minimize = {"ground_reaction.peak_normal_N"};  // a lever has no contact with the ground
  std::string words = message([&] { optimize(lever_tuning(file), {}); });
  EXPECT_NE(words.find("minimize: found ground_reaction.peak_normal_N; expected a figure that the "
                       "runs have"),
            std::string::npos)
      << words;
  file = {.experiment = root + "/experiments/walk-test-1.toml",
          .tune = {"link.femur.length=7.5:8 in"},  // the foot path is out of reach
          .maximize = {"trolley.distance_m"},
          .population = 5,
          .generations = 1};
  words = message([&] { optimize(lever_tuning(file), {}); });
  EXPECT_NE(words.find("none of the first generation's 5 runs has figures: refused: "),
            std::string::npos)
      << words;
}

TEST_F(OptimizeTest, ACandidateIsRunInEveryCircumstance) {
  TuningFile file = lever_file();
  file.generations = 1;
  file.population = 5;
  file.seeds = 2;
  file.spread = {"air.supply.pressure=70:90 psi gauge"};
  file.draws = 3;
  file.cases = {{.name = "as it is", .experiment = "", .sets = {}},
                {.name = "slow", .experiment = "", .sets = {"phase.up.duration=1 s"}, .weight = 3}};
  const Tuning t = lever_tuning(file);
  EXPECT_EQ(t.runs_of_candidate(), 12U);
  const Tuned tuned = optimize_and_store(t, file_, {});
  const StoredStudy held = read_results(file_);
  ASSERT_EQ(held.rows.size(), 60U);
  // Calculates the second candidate's goal by hand.
  double sum = 0, weight = 0;
  for (std::size_t i = 12; i < 24; ++i) {
    const std::vector<std::string>& cells = held.rows[i].cells;
    EXPECT_EQ(cells[0], tuned.candidates[1].values[0].cell);
    const double own = cells[3] == "slow" ? 3 : 1;
    sum += own * std::stod(cells[5]);
    weight += own;
  }
  EXPECT_NEAR(tuned.candidates[1].evaluation.goals[0], sum / weight, 1e-12);
  ASSERT_EQ(held.request.cases.size(), 2U);
  EXPECT_EQ(held.request.cases[1].name, "slow");
  EXPECT_EQ(held.request.cases[1].sets, file.cases[1].sets);
  // Draws are the same for all candidates.
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(held.rows[i].cells[2], held.rows[24 + i].cells[2]);
}

TEST_F(OptimizeTest, SeveralGoalsHaveAFront) {
  TuningFile file = lever_file();
  file.minimize.push_back("air_used_kg [g]");
  file.where.clear();
  file.population = 8;
  const Tuning t = lever_tuning(file);
  const Tuned tuned = optimize(t, {.runs = {.threads = 2}});
  ASSERT_GT(tuned.best.size(), 1U);
  const std::string words = tune::text_of(t, tuned);
  EXPECT_NE(words.find("on the front"), std::string::npos) << words;
}

}  // namespace
}  // namespace sinew::tune::optimize_test
