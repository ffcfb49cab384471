// A stored run can be read back unchanged, and only a run's own files are ever replaced.
#include "sinew/run/folder/run_storage.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "sinew/log/reader.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/drawn_run.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/page.h"
#include "tests/places.h"

namespace sinew::run::kept_run_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class KeptRunTest : public ::testing::Test {
 protected:
  KeptRunTest() { fs::create_directories(root_); }
  ~KeptRunTest() override { fs::remove_all(root_); }

  RunRequest request(const std::string& name) const {
    return {.experiment = sinew::test::source_dir() + "/experiments/leg-in-air.toml",
            .folder = (root_ / name).string(),
            .sets = {"sequence.repeat=1"}};
  }

  const fs::path root_ = fs::temp_directory_path() / ("sinew-kept-run-" + std::to_string(getpid()));
};

TEST_F(KeptRunTest, ReadsBackAsWhatItWas) {
  const auto kept = run_and_store(request("a"));
  EXPECT_EQ(kept.folder, root_ / "a");
  EXPECT_EQ(kept.json, text_of(root_ / "a" / summary_name));

  // The summary is calculated from the log and resolved.toml alone.
  const RunFiles recorded = run_files(root_ / "a");
  const signals::Table table = log::read(recorded.log);
  EXPECT_TRUE(table.complete);
  const analysis::Summary again = analysis::summarize(table, kept.machine);
  ASSERT_EQ(again.entries().size(), kept.summary.entries().size());
  for (const analysis::Entry& e : again.entries())
    EXPECT_EQ(e.value, *kept.summary.find(e.key)) << e.key;

  EXPECT_EQ(kept.page, report::has_page());
  if (kept.page) {
    EXPECT_EQ(page_of(recorded, ""), text_of(root_ / "a" / report_name));
  }
}

TEST_F(KeptRunTest, IsReplacedOnlyByForceAndIsTheSameAgain) {
  (void)run_and_store(request("a"));
  const std::string log = text_of(root_ / "a" / log_name);
  std::ofstream(root_ / "a" / "mine.txt") << "mine";

  RunRequest again = request("a");
  try {
    (void)run_and_store(again);
    ADD_FAILURE() << "replaced";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("force=true"), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find("--"), std::string::npos) << e.what();
  }
  again.force = true;
  (void)run_and_store(again);
  EXPECT_EQ(text_of(root_ / "a" / log_name), log);
  EXPECT_EQ(text_of(root_ / "a" / "mine.txt"), "mine");
}

TEST_F(KeptRunTest, ATableThatIsKeptIsTheRunItCameFrom) {
  const auto ran = run_and_store(request("a"));
  const signals::Table table = log::read(root_ / "a" / log_name);
  const experiment::Experiment e = experiment::load(request("").experiment, request("").sets);
  const auto kept = store_table(table, e, request("b"));
  EXPECT_EQ(kept.summary.entries().size(), ran.summary.entries().size());

  const report::Comparison both =
      compare_runs({(root_ / "a").string(), (root_ / "b").string()}, report::Align::start);
  ASSERT_FALSE(both.channels.empty());
  for (const report::ChannelRow& row : both.channels)
    EXPECT_TRUE(row.differences[1] && row.differences[1]->same) << row.channel.topic;
  for (const analysis::FigureRow& row : both.figures)
    EXPECT_EQ(row.values[0], row.values[1]) << row.key;
}

TEST_F(KeptRunTest, ReportsAnImpossibleExperimentBeforeItMakesAFolder) {
  RunRequest bad = request("a");
  bad.sets.push_back("joint.hip.angle_gain=9 lbf");
  EXPECT_THROW((void)run_and_store(bad), config::Error);
  EXPECT_FALSE(fs::exists(root_ / "a"));
}

TEST_F(KeptRunTest, FiguresOfARunAreListedInTheirIndex) {
  (void)run_and_store(request("a"));
  DrawingRequest drawing;
  drawing.only = {"joint-angles"};
  drawing.files.pictures.clear();
  const std::string index = draw_run(root_ / "a", root_ / "f", drawing);
  EXPECT_EQ(index, text_of(root_ / "f" / "index.json"));
  for (const std::string& name : figures_in(root_ / "f"))
    EXPECT_TRUE(fs::exists(root_ / "f" / name)) << name;

  drawing.only = {"joint-angels"};
  EXPECT_THROW((void)draw_run(root_ / "a", root_ / "g", drawing), config::Error);
  EXPECT_FALSE(fs::exists(root_ / "g"));
}

TEST_F(KeptRunTest, FilesOfAnotherKindAreNotReplacedEvenByForce) {
  constexpr FileKind page{"page", "a page", "\"format\":\"page/"};
  for (const char* name : {"robot.toml", "log.mcap", "page.html"}) {
    std::ofstream(root_ / name) << "mine";
    EXPECT_THROW(refuse_to_overwrite(root_ / name, true, page), config::Error) << name;
  }
  std::ofstream(root_ / "empty.html");
  EXPECT_NO_THROW(refuse_to_overwrite(root_ / "empty.html", true, page));

  std::ofstream(root_ / "page.html") << "<html>{ \"format\": \"page/1\" }";
  EXPECT_THROW(refuse_to_overwrite(root_ / "page.html", false, page), config::Error);
  EXPECT_THROW(refuse_to_overwrite(root_ / "page.html", true, page, {root_ / "page.html"}),
               config::Error);
  EXPECT_NO_THROW(refuse_to_overwrite(root_ / "page.html", true, page));
}

TEST_F(KeptRunTest, AMarkIsSearchedAtItsPlace) {
  std::ofstream(root_ / "t.csv") << "time [s],a /b,status\n1,2,last\n";
  using At = FileKind::At;
  const auto is = [&](std::string_view mark, At at) {
    return is_of_kind(root_ / "t.csv", {"table", "a table", mark, at});
  };
  EXPECT_TRUE(is("time[s],", At::start));
  EXPECT_FALSE(is("a /b", At::start));
  EXPECT_TRUE(is(" /b", At::first_line));
  EXPECT_FALSE(is("last", At::first_line));
  EXPECT_TRUE(is("status", At::end_of_first_line));
  EXPECT_FALSE(is("last", At::end_of_first_line));
  EXPECT_TRUE(is("last", At::anywhere));
}

TEST_F(KeptRunTest, AFolderWithAnotherFileOfARunsNameIsRefused) {
  const fs::path folder = root_ / "lab", file = folder / measured_name;
  fs::create_directories(folder);
  std::ofstream(file) << "time [s],force [N]\n0,1\n";
  RunRequest again = request("lab");
  again.force = true;
  EXPECT_THROW((void)run_and_store(again), std::exception);
  EXPECT_EQ(text_of(file), "time [s],force [N]\n0,1\n");

  // In the folder of a run, too, and where the run reads it.
  fs::remove(file);
  (void)run_and_store(again);
  std::ofstream(folder / summary_name) << "mine";
  EXPECT_THROW((void)run_and_store(again), std::exception);
  EXPECT_EQ(text_of(folder / summary_name), "mine");
  fs::remove(folder / summary_name);
  again.experiment = (folder / resolved_name).string();
  EXPECT_THROW((void)run_and_store(again), std::exception);
  EXPECT_TRUE(fs::exists(folder / resolved_name));
}

}  // namespace
}  // namespace sinew::run::kept_run_test
