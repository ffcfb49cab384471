// A study's page: each column with its role, each row unchanged, and the command that repeats it.
#include <gtest/gtest.h>
#include <unistd.h>

#include "sinew/config/diagnostics.h"
#include "sinew/json/json.h"
#include "sinew/log/file.h"
#include "sinew/report/page/page.h"
#include "sinew/tune/page/study_view.h"
#include "sinew/tune/results/results.h"
#include "tests/message.h"
#include "tests/places.h"

namespace sinew::tune::study_page_test {
namespace {

namespace fs = std::filesystem;
using Role = StudyColumn::Role;

const std::string root = sinew::test::source_dir();
const std::string lever = root + "/experiments/one-joint.toml";

Sweep a_sweep() {
  return {.experiment = lever,
          .sets = {"sequence.repeat=2"},
          .sample =
              Sample{.ranges = {parse_range("joint.lever.damping=0.1:0.2 N m s/rad")}, .points = 2},
          .axes = {parse_axis("low_level.duty_rounding=none,truncate sum"), seeds(2)},
          .report = parse_figures("sequence_duration_s [ms], air_used_kg"),
          .allow_unreachable = true};
}

std::vector<Row> some_rows() {
  return {{.point = 0, .cells = {"0.1", "none", "1", "1e-05", "0.3", "ok"}, .ok = true},
          {.point = 5, .cells = {"0.2", "truncate sum", "2", "", "", "refused: </script> \xff"}}};
}

using test::message;

class StudyPageTest : public ::testing::Test {
 protected:
  StudyPageTest() {
    fs::create_directories(folder_);
    Results results(file_, request_of(a_sweep()));
    results.add_all(some_rows());
  }
  ~StudyPageTest() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::temp_directory_path() / ("sinew-study-page-" + std::to_string(getpid()));
  const fs::path file_ = folder_ / "study.db";
};

TEST_F(StudyPageTest, KnowsWhatItsColumnsAre) {
  const StudyView view = study_view(file_);
  EXPECT_EQ(view.title, "One joint");
  EXPECT_EQ(view.kind, "sweep");
  EXPECT_EQ(view.experiment, lever);
  EXPECT_EQ(view.file, "study.db");
  EXPECT_EQ(view.expected, 8u);
  EXPECT_FALSE(view.version.empty());
  std::vector<Role> roles;
  for (const StudyColumn& c : view.columns) roles.push_back(c.role);
  EXPECT_EQ(roles, (std::vector<Role>{Role::parameter, Role::parameter, Role::other, Role::figure,
                                      Role::figure, Role::other}));
  EXPECT_TRUE(view.columns[2].set) << "a seed is no parameter, and a run has it";
  EXPECT_FALSE(view.columns[1].number);
}

TEST_F(StudyPageTest, HasEachRowAsItStandsInTheFile) {
  const StudyView view = study_view(file_);
  ASSERT_EQ(view.rows.size(), 2u);
  EXPECT_EQ(view.rows[0].cells, some_rows()[0].cells);
  EXPECT_EQ(view.rows[1].number, 5u);
  EXPECT_TRUE(view.rows[0].ok);
  EXPECT_FALSE(view.rows[1].ok);
}

// With the settings of every run.
TEST_F(StudyPageTest, RunsARowAgainWithAllThatItHad) {
  const StudyRun run = run_of(study_view(file_), 5);
  EXPECT_EQ(run.experiment, lever);
  EXPECT_TRUE(run.allow_unreachable);
  EXPECT_EQ(run.sets,
            (std::vector<std::string>{"sequence.repeat=2", "joint.lever.damping=0.2 N m s/rad",
                                      "low_level.duty_rounding=truncate sum", "seed=2"}));
  EXPECT_TRUE(message([&] { (void)run_once(run.experiment, run.sets); }).empty());
  EXPECT_EQ(message([&] { (void)run_of(study_view(file_), 4); }),
            "study.db: found no row 4; expected one of 2 rows that are there");
}

TEST_F(StudyPageTest, IsJsonThatAnybodyReads) {
  const Json json = Json::parse(study_json(study_view(file_)));
  EXPECT_EQ(json["format"], "sinew.study_page/1");
  const Json& study = json["studies"][0];
  EXPECT_EQ(study["columns"][0]["role"], "parameter");
  EXPECT_EQ(study["columns"][0]["set"], true);
  EXPECT_EQ(study["columns"][3]["set"], false);
  EXPECT_EQ(study["rows"][0], Json({0, 1, -1, 0.0, {"0.1", "none", "1", "1e-05", "0.3", "ok"}}));
  EXPECT_EQ(study["sets"].text(), R"(["sequence.repeat=2"])");
  EXPECT_EQ(rows_json({}), "[]");
}

TEST_F(StudyPageTest, NeverLeavesItsElement) {
  if (!report::has_page()) GTEST_SKIP() << "built without pages";
  const std::string page = study_page(study_view(file_));
  EXPECT_EQ(page.find("refused: </script>"), page.npos);
  EXPECT_EQ(page.find("connect-src"), page.npos) << "a file asks nobody";
  EXPECT_NE(study_page(std::vector{study_view(file_)}, {.known = {2}}).find("connect-src 'self'"),
            page.npos);
  EXPECT_EQ(study_page(study_view(file_)), page) << "the same study gives the same bytes";
  EXPECT_NE(study_page_of({file_, file_}).find("One joint and One joint"), page.npos);
}

TEST_F(StudyPageTest, IsRequestedOfStudiesOnly) {
  EXPECT_TRUE(is_study(file_));
  EXPECT_TRUE(is_study("nowhere.db"));
  EXPECT_FALSE(is_study(lever));
  EXPECT_FALSE(is_study(folder_));
  EXPECT_NE(message([&] { (void)study_view(folder_ / "nowhere.db"); }).find("nowhere.db"),
            std::string::npos);
  fs::resize_file(file_, 100);
  EXPECT_NE(message([&] { (void)study_view(file_); }).find("study.db"), std::string::npos);
}

// A tuning's rows are its candidates. A goal with a limit has two columns.
TEST_F(StudyPageTest, ShowsTheCandidatesOfATuning) {
  using From = Column::Role;
  const fs::path file = folder_ / "tuning.db";
  StudyRequest request = request_of(a_sweep());
  request.title = "A faster lever";
  request.text += "draws = 2, 0.5\n";
  request.points = 40;
  request.of_candidates = {{"joint.lever.damping [N m s/rad]", true, From::parameter},
                           {"air_used [kg]", true, From::minimize},
                           {"sequence_duration [ms]", true, From::maximize},
                           {"air_used [kg]", true, From::limit}};
  {
    Results results(file, request);
    results.add_all(some_rows());
    results.add_candidates(
        {{.number = 0, .feasible = true, .cells = {"0.1", "1", "2", "1"}},
         {.number = 3, .generation = 1, .violation = 0.5, .cells = {"0.2", "", "", ""}}});
  }
  const StudyView view = study_view(file);
  EXPECT_EQ(view.title, "A faster lever");
  EXPECT_EQ(view.kind, "tune");
  EXPECT_EQ(view.expected, 10u) << "of four runs each: two seeds, two draws";
  EXPECT_EQ(view.columns[1].role, Role::objective);
  EXPECT_FALSE(view.columns[1].maximize);
  EXPECT_TRUE(view.columns[2].maximize);
  EXPECT_EQ(view.columns[3].role, Role::constraint);
  EXPECT_EQ(view.columns[3].heading, "air_used worst [kg]");
  ASSERT_EQ(view.rows.size(), 2u);
  EXPECT_TRUE(view.rows[0].ok);
  EXPECT_EQ(view.rows[1].number, 3u);
  EXPECT_EQ(view.rows[1].generation, 1);
  EXPECT_EQ(view.rows[1].violation, 0.5);
  EXPECT_FALSE(view.rows[1].ok);
  EXPECT_EQ(run_of(view, 3).sets.back(), "joint.lever.damping=0.2 N m s/rad");
}

// If the experiment is missing or has changed, the study can still be read; its command is that of
// the request.
TEST_F(StudyPageTest, IsReadWithoutItsExperiment) {
  const fs::path study = folder_ / "own.db";
  StudyRequest request = request_of(a_sweep());
  request.experiment = (folder_ / "gone.toml").string();
  { Results(study, request).add_all(some_rows()); }
  const StudyView view = study_view(study);
  EXPECT_EQ(view.rows.size(), 2u);
  EXPECT_EQ(view.sets, std::vector<std::string>{"sequence.repeat=2"});
}

}  // namespace
}  // namespace sinew::tune::study_page_test
