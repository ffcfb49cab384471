// `report`, and the page that `run` and `import` leave. What the page shows is tested in a browser:
// web/test.
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace sinew::test::report_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
namespace fs = std::filesystem;

const std::string walk = "experiments/walk-test-1.toml";
const std::string bench = "experiments/one-joint.toml";

#if SINEW_HAS_PAGE

TEST(Report, IsLeftByARunAndMadeAgainByteForByte) {
  const Workspace w;
  for (const std::string& experiment :
       {walk, bench, std::string("experiments/cylinder-following.toml"),
        std::string("experiments/rig/duty-sweep.toml"),
        std::string("experiments/rig/feedback.toml")}) {
    ASSERT_EQ(w.sinew({"run", experiment, "-o", "run", "--force"}).code, 0);
    const Result made = w.sinew({"report", "run", "-o", "again.html", "--force"});
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string left = read_text(w / "run/report.html");
    EXPECT_GT(left.size(), 90000u);
    EXPECT_TRUE(left == read_text(w / "again.html")) << experiment;
  }
}

TEST(Report, HoldsOnlyTheChannelsOfTheLog) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run", "--set", R"(log.channels=["/joint/*"])"}).code, 0);
  const std::string page = read_text(w / "run/report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("/joint/lever/angle"), Not(HasSubstr("/true/joint"))));
  ASSERT_EQ(w.sinew({"report", "run", "--force"}).code, 0);
  EXPECT_TRUE(page == read_text(w / "run/report.html"));
}

TEST(Report, IsNotLeftWithoutALogOrWhereItIsNotWanted) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run", "--no-report"}).code, 0);
  EXPECT_FALSE(fs::exists(w / "run/report.html"));
  ASSERT_EQ(w.sinew({"run", bench, "-o", "off", "--set", "log.enabled=false"}).code, 0);
  EXPECT_FALSE(fs::exists(w / "off/report.html"));
}

TEST(Report, OfARunThatIsNotThereNamesWhatIsMissing) {
  const Workspace w;
  EXPECT_THAT(w.sinew({"report", "nowhere"}).err, StartsWith("nowhere: found nothing"));
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run"}).code, 0);
  const Result again = w.sinew({"report", "run"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, AllOf(StartsWith("run/report.html: found a file"), HasSubstr("--force")));
  EXPECT_THAT(w.sinew({"report", "run", "-o", "run", "--force"}).err,
              StartsWith("run: found a folder; expected the name of a file"));
  EXPECT_THAT(w.sinew({"report", "run", "-o", "away/run.html"}).err,
              HasSubstr("found no folder away"));
  fs::remove(w / "run/resolved.toml");
  EXPECT_THAT(w.sinew({"report", "run", "--force"}).err, HasSubstr("--machine"));
  EXPECT_EQ(w.sinew({"report", "run", "--force", "--machine", bench}).code, 0);
}

TEST(Report, OfAStudyStandsBesideIt) {
  const Workspace w;
  for (const char* name : {"one.db", "two.db"})
    ASSERT_EQ(w.sinew({"sweep", bench, "--seeds", "3", "--report", "air_used_kg", "--results", name,
                       "-o", "t.csv", "--force"})
                  .code,
              0);
  const Result made = w.sinew({"report", "one.db"});
  EXPECT_EQ(made.code, 0);
  EXPECT_THAT(made.err, StartsWith("one.html, "));
  EXPECT_THAT(read_text(w / "one.html"), HasSubstr("air_used [kg]"));
  EXPECT_THAT(w.sinew({"report", "one.db"}).err,
              AllOf(StartsWith("one.html: found a file"), HasSubstr("--force")));
  EXPECT_EQ(w.sinew({"report", "one.db", "two.db", "-o", "both.html"}).code, 0);
  EXPECT_THAT(read_text(w / "both.html"), AllOf(HasSubstr("one.db"), HasSubstr("two.db")));
}

TEST(Report, OfAStudyRefusesWhatIsNone) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run"}).code, 0);
  const Result two = w.sinew({"report", "run", "run"});
  EXPECT_EQ(two.code, 2);
  EXPECT_THAT(two.err, HasSubstr("sinew compare"));
  EXPECT_EQ(w.sinew({"report", "a.db", "--machine", bench}).code, 2);
  EXPECT_THAT(w.sinew({"report", "a.db"}).err, StartsWith("a.db: "));
  EXPECT_THAT(w.sinew({"view", "a.db", "--no-open"}).err, StartsWith("a.db: "));
  write_text(w / "words.db", "not a study");
  EXPECT_THAT(w.sinew({"report", "words.db"}).err, StartsWith("words.db"));
}

TEST(Report, IsMadeOfALogThatWasCutAndSaysSo) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "run", "--no-report"}).code, 0);
  fs::resize_file(w / "run/log.mcap", fs::file_size(w / "run/log.mcap") / 2);
  const Result made = w.sinew({"report", "run"});
  EXPECT_EQ(made.code, 0);
  EXPECT_THAT(made.err, HasSubstr("was cut off or is damaged"));
  EXPECT_THAT(read_text(w / "run/report.html"), HasSubstr("the log was cut off or is damaged"));
}

TEST(Report, IsMadeOfTheThesissOwnLog) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "run", "--no-report"}).code, 0);
  ASSERT_EQ(w.sinew({"export", "run", "--format", "out.dat", "-o", "out.dat"}).code, 0);
  ASSERT_EQ(w.sinew({"import", "out.dat", "--experiment", walk, "-o", "imported"}).code, 0);
  const std::string page = read_text(w / "imported/report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("measured angles"), Not(HasSubstr("\"/true/"))));
  ASSERT_EQ(w.sinew({"report", "imported", "--force"}).code, 0);
  EXPECT_TRUE(page == read_text(w / "imported/report.html"));
}

TEST(Report, KeepsATitleInItsPlace) {
  const Workspace w;
  w.edit(bench, "One joint on the bench", "</script><script>alert(1)</script>");
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run"}).code, 0);
  EXPECT_THAT(read_text(w / "run/report.html"), Not(HasSubstr("<script>alert(1)")));
}

#else

TEST(Report, WithoutNpmIsRefusedAndARunGoesWithoutIt) {
  const Workspace w;
  const Result run = w.sinew({"run", bench, "-o", "run"});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.err, HasSubstr("no report.html"));
  EXPECT_FALSE(fs::exists(w / "run/report.html"));
  const Result report = w.sinew({"report", "run"});
  EXPECT_EQ(report.code, 1);
  EXPECT_THAT(report.err, HasSubstr("npm ci in web/"));
}

#endif

}  // namespace
}  // namespace sinew::test::report_test
