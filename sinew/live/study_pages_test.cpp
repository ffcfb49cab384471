// A study that is served while it grows: each change is sent once, and rows can be run.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "sinew/json/json.h"
#include "sinew/live/served.h"
#include "sinew/report/page/page.h"
#include "sinew/tune/results/results.h"
#include "tests/places.h"

namespace sinew::live::study_pages_test {
namespace {

namespace fs = std::filesystem;

const std::string lever = sinew::test::source_dir() + "/experiments/one-joint.toml";

tune::Sweep a_sweep() {
  return {.experiment = lever,
          .axes = {tune::seeds(9)},
          .report = tune::parse_figures("sequence_duration_s")};
}

tune::Row row(std::size_t point, const std::string& seed = "1") {
  return {.point = point, .cells = {seed, "3.5", "ok"}, .ok = true};
}

std::vector<std::size_t> numbers(const std::vector<tune::StudyRow>& rows) {
  std::vector<std::size_t> out;
  for (const tune::StudyRow& r : rows) out.push_back(r.number);
  return out;
}

class StudyPagesTest : public ::testing::Test {
 protected:
  StudyPagesTest() : before_(fs::current_path()) {
    fs::create_directories(folder_);
    fs::current_path(folder_);
  }
  ~StudyPagesTest() override {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }

  const fs::path before_;
  const fs::path folder_ =
      fs::temp_directory_path() / ("sinew-study-pages-" + std::to_string(getpid()));
  const fs::path file_ = folder_ / "study.db";
};

// Rows come in any order while the file is written.
TEST_F(StudyPagesTest, ReportsEachRowOnceAsItComes) {
  tune::Results results(file_, request_of(a_sweep()));
  results.add(row(4));
  StudyFeed feed(file_);
  EXPECT_EQ(feed.changes(), 1u);
  results.add(row(2));
  results.add(row(7));
  feed.refresh();
  EXPECT_EQ(feed.changes(), 3u);
  EXPECT_EQ(numbers(feed.since(1)), (std::vector<std::size_t>{2, 7}));
  EXPECT_EQ(numbers(feed.since(0)), (std::vector<std::size_t>{4, 2, 7}));
  EXPECT_TRUE(feed.since(3).empty());
  EXPECT_TRUE(feed.since(99).empty());
  feed.refresh();
  EXPECT_EQ(feed.changes(), 3u) << "nothing was written";
}

TEST_F(StudyPagesTest, AnswersWithWhatIsNew) {
  if (!report::has_page()) GTEST_SKIP() << "built without pages";
  tune::Results results(file_, request_of(a_sweep()));
  results.add(row(0));
  StudyPages pages({file_}, {});
  EXPECT_EQ(pages.get("/").status, 200);
  results.add(row(3));
  const Reply reply = pages.get("/rows/1");
  EXPECT_EQ(reply.type, "application/json");
  const Json json = Json::parse(reply.body);
  EXPECT_EQ(json["known"], 2);
  EXPECT_EQ(json["expected"], 9);
  EXPECT_EQ(json["rows"].size(), 1u);
  EXPECT_EQ(json["rows"][0][0], 3);
  EXPECT_FALSE(json.contains("error"));
  for (const char* path : {"/rows/", "/rows/-1", "/rows/1x", "/run/", "/runs", "/study.db", ""})
    EXPECT_EQ(pages.get(path).status, 404) << path;
}

// The open page reports that the file was removed.
TEST_F(StudyPagesTest, ReportsAMissingFile) {
  if (!report::has_page()) GTEST_SKIP() << "built without pages";
  { tune::Results(file_, request_of(a_sweep())).add(row(0)); }
  StudyPages pages({file_}, {});
  fs::remove(file_);
  const Json json = Json::parse(pages.get("/rows/1").body);
  EXPECT_NE(json["error"].string().find("study.db"), std::string::npos);
  EXPECT_EQ(json["known"], 1);
}

TEST_F(StudyPagesTest, RunsARowOnceAndShowsIt) {
  if (!report::has_page()) GTEST_SKIP() << "built without pages";
  { tune::Results(file_, request_of(a_sweep())).add(row(2, "3")); }
  std::vector<std::string> notes;
  StudyPages pages({file_}, {.on_note = [&](std::string_view n) { notes.emplace_back(n); }});
  Reply reply;
  for (int i = 0; i < 60; ++i) {
    reply = pages.get("/run/2");
    ASSERT_EQ(reply.status, 200) << reply.body;
    if (reply.body.find("http-equiv=\"refresh\"") == reply.body.npos) break;
  }
  EXPECT_NE(reply.body.find("\"seed\""), reply.body.npos);
  EXPECT_EQ(pages.get("/run/2").body, reply.body);
  EXPECT_EQ(notes, std::vector<std::string>{"row 2: kept in runs/one-joint/1"});
  EXPECT_TRUE(fs::exists(folder_ / "runs/one-joint/1/log.mcap"));
  EXPECT_FALSE(fs::exists(folder_ / "runs/one-joint/2"));
  const Reply none = pages.get("/run/5");
  EXPECT_EQ(none.status, 500);
  EXPECT_EQ(none.body, "study.db: found no row 5; expected one of 1 rows that are there\n");
}

// A row that cannot be run gives the reason instead of a page.
TEST_F(StudyPagesTest, ReportsWhyARowCannotRun) {
  if (!report::has_page()) GTEST_SKIP() << "built without pages";
  tune::StudyRequest request = request_of(a_sweep());
  request.experiment = "gone.toml";
  { tune::Results(file_, request).add(row(2)); }
  StudyPages pages({file_}, {});
  const Reply reply = pages.get("/run/2");
  EXPECT_EQ(reply.status, 500);
  EXPECT_NE(reply.body.find("gone.toml"), reply.body.npos) << reply.body;
}

TEST_F(StudyPagesTest, IsServedByItsFile) {
  if (!report::has_page()) GTEST_SKIP() << "built without pages";
  { tune::Results(file_, request_of(a_sweep())).add(row(0)); }
  const Served study = served(file_.string(), "");
  EXPECT_EQ(study.get("/rows/0").status, 200);
  EXPECT_EQ(study.description(""), file_.string() + "; Ctrl-C ends");
  EXPECT_THROW((void)served("nowhere.db", ""), std::exception);
  EXPECT_THROW((void)served("", ""), std::exception) << "there is no run here";
}

// Rows and runs of the second study are below /b.
TEST_F(StudyPagesTest, TwoStudiesStandBesideEachOther) {
  if (!report::has_page()) GTEST_SKIP() << "built without pages";
  const fs::path other = folder_ / "other.db";
  tune::Results first(file_, request_of(a_sweep())), second(other, request_of(a_sweep()));
  first.add(row(0));
  second.add(row(4));
  const Served both = served(std::vector{file_.string(), other.string()}, "");
  EXPECT_EQ(both.description(""), file_.string() + " and " + other.string() + "; Ctrl-C ends");
  const std::string page = both.get("/").body;
  EXPECT_NE(page.find("\"known\":[1,1]"), page.npos);
  second.add(row(7));
  EXPECT_EQ(Json::parse(both.get("/rows/1").body)["rows"].size(), 0u);
  const Json json = Json::parse(both.get("/b/rows/1").body);
  EXPECT_EQ(json["known"], 2);
  EXPECT_EQ(json["rows"][0][0], 7);
  EXPECT_EQ(both.get("/b/run/0").body,
            "other.db: found no row 0; expected one of 2 rows that are there\n");
  EXPECT_EQ(served(std::vector{file_.string()}, "").get("/b/rows/0").status, 404);
}

TEST_F(StudyPagesTest, OtherThingsDoNotStandBesideEachOther) {
  { tune::Results(file_, request_of(a_sweep())).add(row(0)); }
  const auto said = [](const std::vector<std::string>& what) -> std::string {
    try {
      (void)served(what, "");
    } catch (const std::exception& wrong) {
      return wrong.what();
    }
    return "nothing";
  };
  EXPECT_NE(said({file_.string(), "runs/a"})
                .find("no study's file; expected one run, one study, or two studies"),
            std::string::npos)
      << said({file_.string(), "runs/a"});
  EXPECT_NE(said({file_.string(), file_.string(), file_.string()}).find("a third one"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::live::study_pages_test
