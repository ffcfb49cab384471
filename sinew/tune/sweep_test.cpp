// Tables of runs do not depend on the number of threads, and equal single runs.
#include "sinew/tune/sweep.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/run/simulation/run.h"
#include "sinew/tune/study.h"
#include "sinew/tune/table.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::tune::sweep_test {
namespace {

const std::string root = sinew::test::source_dir();
const std::string lever = root + "/experiments/one-joint.toml";
const std::string leg = root + "/experiments/leg-in-air.toml";

Sweep gains() {
  return {.experiment = leg,
          .axes = {parse_axis("joint.hip.angle_gain=0.02,0.04 %/count"), seeds(3)},
          .report = parse_figures("joints.hip.tracking_rms_rad,joints.hip.tracking_rms_rad [deg],"
                                  "air_used_kg")};
}

std::string table(const Sweep& s, int threads, int lanes = 8) {
  std::string rows;
  sweep(s, {.threads = threads, .lanes = lanes, .row = [&](const Row& row) {
              rows += csv_line(row.cells);
            }});
  return csv_line(headings(s)) + rows;
}

using test::message;

// Uses the resolved file, like `sinew run` and `sinew analyze`.
analysis::Summary single_run(const std::vector<std::string>& sets) {
  const experiment::Experiment e = experiment::load(leg, sets);
  const auto resolved = config::parse_text(experiment::resolved(e, "test"), "resolved.toml");
  return analysis::summarize(run::run(e).table, analysis::read_machine(resolved));
}

TEST(Sweep, IsTheSameForAnyNumberOfThreads) {
  const std::string alone = table(gains(), 1);
  EXPECT_EQ(std::count(alone.begin(), alone.end(), '\n'), 7);
  for (int threads : {2, 3, 16}) EXPECT_EQ(table(gains(), threads), alone) << threads;
}

TEST(Sweep, IsTheSameForAnyNumberOfLanes) {
  const std::string one = table(gains(), 1, 1);
  for (int lanes : {2, 4, 8}) EXPECT_EQ(table(gains(), 1, lanes), one) << lanes;
}

TEST(Sweep, ARowEqualsTheSingleRun) {
  const Sweep s = gains();
  const std::vector<Row> rows = sweep(s, {.threads = 2});
  ASSERT_EQ(rows.size(), 6U);
  const Row& row = rows[4];
  ASSERT_EQ(row.cells.size(), headings(s).size());
  EXPECT_EQ(row.cells[0], "0.04");
  EXPECT_EQ(row.cells[1], "2");
  EXPECT_EQ(row.cells.back(), "ok");
  const analysis::Summary run = single_run({"joint.hip.angle_gain=0.04 %/count", "seed=2"});
  for (std::size_t i = 0; i < s.report.size(); ++i)
    EXPECT_EQ(row.cells[2 + i], s.report[i].cell(run)) << s.report[i].key;
  EXPECT_EQ(std::stod(row.cells[2]), *run.find("joints.hip.tracking_rms_rad")) << "bit for bit";
}

// Each point of the sample is combined with each point of the grid, which varies faster.
TEST(Sweep, ASampleIsTheSameForAnyNumberOfThreadsAndAsSingleRuns) {
  Sweep s = gains();
  s.axes = {seeds(2)};
  s.sample = Sample{Sample::Kind::latin,
                    {parse_range("joint.hip.angle_gain=0.01:0.04 %/count log"),
                     parse_range("control.stiffness.hip=20:40 lbf in/rad")},
                    5,
                    3};
  const std::string alone = table(s, 1);
  EXPECT_EQ(std::count(alone.begin(), alone.end(), '\n'), 11);
  for (int threads : {2, 7}) EXPECT_EQ(table(s, threads), alone) << threads;

  const std::vector<Row> rows = sweep(s, {.threads = 2});
  ASSERT_EQ(rows.size(), 10U);
  EXPECT_EQ(headings(s)[1], "control.stiffness.hip [lbf in/rad]");
  EXPECT_EQ(rows[6].cells[0], rows[7].cells[0]);
  EXPECT_NE(rows[7].cells[0], rows[8].cells[0]);
  const std::vector<std::string>& cells = rows[7].cells;
  EXPECT_EQ(cells[2], "2") << "its seed";
  const analysis::Summary run =
      single_run({"joint.hip.angle_gain=" + cells[0] + " %/count",
                  "control.stiffness.hip=" + cells[1] + " lbf in/rad", "seed=2"});
  EXPECT_EQ(std::stod(cells[3]), *run.find("joints.hip.tracking_rms_rad")) << "bit for bit";
}

TEST(Sweep, RefusesARangeThatTheExperimentDoesNotKnow) {
  const auto of = [](const char* range) {
    return message([=] {
      check({.experiment = lever,
             .sample = Sample{Sample::Kind::sobol, {parse_range(range)}, 4, 1},
             .report = parse_figures("duration_s")});
    });
  };
  EXPECT_EQ(of("phase.up.duration=1:2 s"), "");
  EXPECT_EQ(of("seed=1:9 whole"), "");
  EXPECT_EQ(of("seed=1:2000000000 whole"), "");
  EXPECT_NE(of("phase.up.duration=1:2 lb").find("\"1 lb\", kg (mass)"), std::string::npos);
  EXPECT_NE(of("joint.arm.angle_gian=1:2 %/count").find("; try angle_gain"), std::string::npos);
  EXPECT_NE(of("seed=1:9").find("expected a whole number"), std::string::npos);
  EXPECT_NE(of("robot=1:9").find("a list of files, in vary"), std::string::npos);
  EXPECT_NE(of("seed=1:3000000000 whole").find("0 to 2147483647"), std::string::npos);
}

// A table without any figure is refused before its runs.
TEST(Sweep, RefusesATableWithoutFigures) {
  Sweep s{.experiment = lever, .axes = {parse_axis("seed=1,2")}};
  EXPECT_NE(message([&] { check(s); }).find("expected a figure for the rows of the table"),
            std::string::npos);
  s.report = parse_figures("duration_s");
  EXPECT_EQ(message([&] { check(s); }), "");
}

// Experiments that differ in many keys are given as files.
TEST(Sweep, AnAxisOfExperiments) {
  const Sweep s{.experiment = leg,
                .axes = {parse_axis("experiment=leg-in-air.toml,one-joint.toml"), seeds(2)},
                .report = parse_figures("air_used_kg")};
  check(s);
  const std::vector<Row> rows = sweep(s, {.threads = 2});
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[2].cells[0], "one-joint.toml");
  const RunResult other = run_once(lever, {"seed=2"});
  EXPECT_EQ(std::stod(rows[3].cells[2]), *other.summary.find("air_used_kg"));

  Sweep missing = s;
  missing.axes[0] = parse_axis("experiment=leg-in-air.toml,no-such-leg.toml");
  EXPECT_NE(message([&] { check(missing); }).find("no-such-leg.toml"), std::string::npos);
}

// A run that is refused and one that diverges are both rows.
TEST(Sweep, FailuresAreRows) {
  Sweep s{.experiment = root + "/experiments/walk-test-1.toml",
          .axes = {parse_axis("link.femur.length=8,8.875 in"),
                   parse_axis("muscle.knee_extensor.bladder_stiffness=300,1e8 N/m")},
          .report = parse_figures("trolley.distance_m")};
  const std::vector<Row> rows = sweep(s, {.threads = 2});
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_NE(rows[0].cells.back().find("refused: "), std::string::npos);
  EXPECT_NE(rows[0].cells.back().find("out of reach"), std::string::npos);
  EXPECT_EQ(rows[0].cells[2], "");
  EXPECT_FALSE(rows[0].ok);
  EXPECT_TRUE(rows[2].ok);
  EXPECT_EQ(rows[3].cells.back().find("ended early: "), 0U);
  EXPECT_EQ(rows[3].cells[2], "");
}

TEST(Sweep, StopsAfterTheRunsThatHaveBegun) {
  std::atomic<bool> stop{false};
  std::size_t told = 0;
  Sweep steps = gains();
  steps.axes = {
      parse_axis("sequence.repeat=2,1,4,3")};  // the shorter of two side by side begins first
  const auto rows_of = [&](int lanes) {
    stop = false;
    told = 0;
    return sweep(steps, {.threads = 1,
                         .lanes = lanes,
                         .stop = &stop,
                         .row =
                             [&](const Row&) {
                               if (++told == 2) stop = true;
                             }})
        .size();
  };
  EXPECT_EQ(rows_of(1), 2U);
  EXPECT_EQ(told, 2U);
  EXPECT_EQ(rows_of(2), 3U);  // the first alone, then two side by side
  EXPECT_EQ(told, 3U);
}

TEST(Sweep, RefusesWhatTheExperimentDoesNotKnow) {
  const auto of = [](const char* axis, const char* report = "duration_s") {
    return message([=] {
      sweep({.experiment = lever, .axes = {parse_axis(axis)}, .report = parse_figures(report)}, {});
    });
  };
  EXPECT_NE(of("joint.arm.angle_gian=1 %/count").find("; try angle_gain"), std::string::npos);
  EXPECT_NE(of("seeed=1,2").find("try \"seed\""), std::string::npos);
  EXPECT_NE(of("phase.up.duration=1,2 lb").find("\"1 lb\", kg (mass)"), std::string::npos);
  EXPECT_NE(of("phase.up.duration=1,2").find("1 without a unit"), std::string::npos);
  EXPECT_NE(of("seed=1", "durations_s").find("try \"duration_s\""), std::string::npos);
  EXPECT_EQ(of("seed=1", "of.another.machine_m"), "") << "a key that does not apply";
  EXPECT_NE(of("seed=1,3e9").find("vary: found seed: 3000000000"), std::string::npos);
  EXPECT_NE(of("seed=1,3e9").find("0 to 2147483647"), std::string::npos);
  EXPECT_NE(of("seed=1,1e30").find("0 to 2147483647"), std::string::npos);
}

// A missing figure is reported in the status.
TEST(Sweep, WhatARunLacksItsStatusNames) {
  Sweep s{.experiment = lever,
          .axes = {seeds(1)},
          .report = parse_figures("duration_s, of.another.machine_m")};
  std::vector<Row> rows = sweep(s, {});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows[0].ok);
  EXPECT_EQ(rows[0].notes.lacks, std::vector<std::string>{"of.another.machine_m"});
  EXPECT_EQ(rows[0].cells.back(), "without of.another.machine_m");
  EXPECT_EQ(rows[0].cells[2], "");

  s.report = parse_figures("duration_s");
  s.axes.clear();
  s.largest = Search{parse_axis("seed=1:3:3"), {parse_condition("of.another.machine_m < 1 m")}, 1};
  rows = sweep(s, {});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_FALSE(rows[0].ok);
  EXPECT_EQ(rows[0].cells.back(), "without of.another.machine_m");
}

// The condition holds for the result, and fails for the next finer value.
TEST(Sweep, FindsTheLargestValueThatHolds) {
  const Axis gain = parse_axis("joint.hip.angle_gain=0.02:0.3:8 %/count");
  const auto where = parse_condition("joints.hip.swing_oscillation_rms_rad < 3 deg");
  const Sweep s{.experiment = leg, .largest = Search{gain, {where}, 5}};
  const std::vector<Row> rows = sweep(s, {});
  ASSERT_EQ(rows.size(), 1U);
  ASSERT_TRUE(rows[0].ok) << rows[0].cells.back();
  const double found = std::stod(rows[0].cells[0]), step = 0.04 / 32;
  const auto holds = [&](double x) { return where.holds(single_run({gain.set(gain.at(x))})); };
  EXPECT_TRUE(holds(found));
  EXPECT_FALSE(holds(found + step));

  Sweep never = s;
  never.largest->where = {parse_condition("joints.hip.swing_oscillation_rms_rad < 0 deg")};
  EXPECT_EQ(sweep(never, {})[0].cells.back(), "does not hold at the first value");
  Sweep always = s;
  always.largest->where = {parse_condition("joints.hip.swing_oscillation_rms_rad >= 0 deg")};
  EXPECT_EQ(sweep(always, {})[0].cells[0], "0.3");
  EXPECT_EQ(sweep(always, {})[0].cells.back(), "holds to the last value");
}

TEST(Sweep, AFileThatChangesMeanwhileChangesNoRow) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("sinew-sweep-of-one-version-" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string file = (folder / "own.toml").string();
  const auto put = [&](int seed) {
    std::ofstream(file) << "format = \"sinew.experiment/1\"\nbase = \"" << lever
                        << "\"\nseed = " << seed << "\n";
  };
  Sweep s{.experiment = file,
          .axes = {parse_axis("joint.lever.angle_gain=0.02,0.03,0.04 %/count")},
          .report = parse_figures("air_used_kg, duration_s")};
  const auto rows_of = [&](bool edit, int threads) {
    put(1);
    std::vector<std::vector<std::string>> cells;
    for (const Row& row : sweep(s, {.threads = threads, .done = [&](const Row&) {
                                      if (edit) put(2);
                                    }}))
      cells.push_back(row.cells);
    return cells;
  };
  const auto still = rows_of(false, 1);
  EXPECT_EQ(rows_of(true, 1), still);
  EXPECT_EQ(rows_of(true, 2), still);
  put(2);
  EXPECT_NE(sweep(s, {})[0].cells, still[0]) << "the edit changes a run";
  fs::remove_all(folder);
}

TEST(Csv, QuotesWhatNeedsIt) {
  EXPECT_EQ(csv_line({"a", "b,c", "d\"e", ""}), "a,\"b,c\",\"d\"\"e\",\n");
}

// --- plans ---

class Plan : public ::testing::Test {
 protected:
  std::string file(const std::string& text) const {
    std::ofstream(path_) << text;
    return path_.string();
  }
  void TearDown() override { std::filesystem::remove(path_); }
  const std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                      ("sinew-sweep-" + std::to_string(getpid()) + ".toml");
};

TEST_F(Plan, PrintsWhatTheCommandLinePrints) {
  const std::string name =
      file("format = \"sinew.plan/1\"\ntitle = \"gains\"\nexperiment = \"" + leg +
           "\"\nvary = [\"joint.hip.angle_gain=0.02,0.04 %/count\"]\n"
           "seeds = 3\nreport = [\"joints.hip.tracking_rms_rad\", "
           "\"joints.hip.tracking_rms_rad [deg],air_used_kg\"]\n");
  EXPECT_EQ(table(sweep_of(load_study(name)), 2), table(gains(), 1));
}

TEST_F(Plan, NamesItsExperimentFromWhereItStands) {
  const std::string there = std::filesystem::path(leg).lexically_relative(path_.parent_path());
  const std::string name =
      file("format = \"sinew.plan/1\"\ntitle = \"t\"\nexperiment = \"" + there + "\"\n");
  EXPECT_EQ(load_study(name).experiment, leg);
}

// Without `report`, a plan reports what the sources report, each key once and in their unit.
TEST_F(Plan, ReportsWhatIsReported) {
  const std::string start = "format = \"sinew.plan/1\"\ntitle = \"t\"\nexperiment = \"" + root +
                            "/experiments/walk-test-1.toml\"\n";
  const Sweep s = sweep_of(load_study(file(start)));
  const experiment::Experiment e = experiment::load(s.experiment);
  std::set<std::string> keys;
  for (const config::Reported& r : e.reported) keys.insert(r.key);
  ASSERT_EQ(s.report.size(), keys.size());
  const auto distance = std::ranges::find(s.report, "trolley.distance_m", &Figure::key);
  ASSERT_NE(distance, s.report.end());
  EXPECT_EQ(distance->unit, "in");
  EXPECT_EQ(sweep_of(load_study(file(start + "report = [\"duration_s\"]\n"))).report.size(), 1U);
}

TEST_F(Plan, Samples) {
  const std::string name = file("format = \"sinew.plan/1\"\ntitle = \"s\"\nexperiment = \"" + leg +
                                "\"\nrange = [\"joint.hip.angle_gain=0.01:0.04 %/count log\"]\n"
                                "sample = \"random\"\npoints = 12\nsample_seed = 4\nseeds = 2\n");
  const Sweep s = sweep_of(load_study(name));
  ASSERT_TRUE(s.sample);
  EXPECT_EQ(s.sample->kind, Sample::Kind::random);
  EXPECT_EQ(s.sample->seed, 4U);
  EXPECT_EQ(points(s), 24U);
}

TEST_F(Plan, ReportsWhatIsWrong) {
  const std::string start =
      "format = \"sinew.plan/1\"\ntitle = \"t\"\nexperiment = \"" + leg + "\"\n";
  const auto of = [&](const std::string& text) {
    const std::string name = file(text);
    return message([&] { sweep_of(load_study(name)); });
  };
  EXPECT_NE(of(start + "varry = []\n").find("; try vary"), std::string::npos);
  EXPECT_NE(of("format = \"sinew.plan/1\"\ntitle = \"t\"\n").find("experiment"), std::string::npos);
  EXPECT_NE(of(start + "where = [\"passiveness > 0.5\"]\n").find("largest value"),
            std::string::npos);
  EXPECT_NE(of(start + "largest = \"k=1:2:3 m\"\n").find("nothing that must hold"),
            std::string::npos);
  EXPECT_NE(of(start + "points = 5\n").find("ranges to sample from"), std::string::npos);
  EXPECT_NE(of(start + "range = [\"k=1:2 m\"]\n").find("how many points"), std::string::npos);
  EXPECT_NE(of(start + "range = [\"k=1:2 m\", \"k=1:3 m\"]\npoints = 2\n").find("given twice"),
            std::string::npos);
  EXPECT_NE(
      of(start + "range = [\"k=1:2 m\"]\nvary = [\"k=1,2 m\"]\npoints = 2\n").find("given twice"),
      std::string::npos);
  EXPECT_NE(of(start + "sample = \"halton\"\n").find("\"sobol\", \"latin\" or \"random\""),
            std::string::npos);
  EXPECT_NE(of("format = \"sinew.valves/1\"\n").find("\"sinew.plan/1\""), std::string::npos);
}

}  // namespace
}  // namespace sinew::tune::sweep_test
