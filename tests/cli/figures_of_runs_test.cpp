// `figures DIR…`: of a walk, of the stand, of a log without truth.
#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::figures_of_runs_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string bench = "experiments/one-joint.toml";
const std::string stand = "experiments/rig/feedback.toml";

bool has_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

void run(const Workspace& w, const std::string& experiment, const std::string& folder) {
  ASSERT_EQ(w.sinew({"run", experiment, "-o", folder, "--no-report"}).code, 0);
}

Words endings(const Workspace& w, const std::string& folder, const std::string& ending) {
  Words out;
  for (const std::string& name : names_in(w / folder))
    if (name.ends_with(ending)) out.push_back(name);
  return out;
}

TEST(FiguresOfRuns, HaveTheirCsvAndAnIndexAndTheSameBytesAgain) {
  const Workspace w;
  for (const auto& [experiment, folder] : {std::pair(bench, "bench"), std::pair(stand, "stand")}) {
    run(w, experiment, folder);
    const std::string figures = std::string(folder) + "/figures/";
    const Result made = w.sinew({"figures", folder, "--json", "--format", "csv"});
    ASSERT_EQ(made.code, 0) << made.err;
    const Json index = Json::parse(made.out);
    EXPECT_EQ(index["format"], "sinew.figures/1");
    const Json& one = index["runs"].at(0);
    EXPECT_GE(one["figures"].size(), 5u) << experiment;
    for (const Json& figure : one["figures"])
      for (const Json& curve : figure["curves"]) {
        const std::string csv = read_text(w / (figures + curve["file"].get<std::string>()));
        EXPECT_THAT(csv.substr(0, csv.find('\n')), AllOf(HasSubstr(curve["x"].get<std::string>()),
                                                         HasSubstr(curve["y"].get<std::string>())));
        EXPECT_THAT(curve["y"].get<std::string>(), HasSubstr(" ["));
      }
    ASSERT_EQ(w.sinew({"figures", folder, "-o", "again", "--force", "--format", "csv"}).code, 0);
    EXPECT_EQ(names_in(w / "again"), names_in(w / figures));
    for (const std::string& name : names_in(w / "again"))
      EXPECT_TRUE(read_text(w / ("again/" + name)) == read_text(w / (figures + name))) << name;
  }
}

TEST(FiguresOfRuns, AreDrawn) {
  if (!has_gnuplot()) GTEST_SKIP() << "gnuplot is missing";
  const Workspace w;
  run(w, bench, "run");
  const Result made =
      w.sinew({"figures", "run", "--only", "joint-angles", "tension", "--units", "thesis"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_THAT(made.out, AllOf(HasSubstr("run/figures"), HasSubstr("Joint angles")));
  EXPECT_EQ(endings(w, "run/figures", ".svg"), (Words{"joint-angles.svg", "tension.svg"}));
  EXPECT_EQ(endings(w, "run/figures", ".png"), (Words{"joint-angles.png", "tension.png"}));
  EXPECT_THAT(read_text(w / "run/figures/joint-angles.svg"), HasSubstr("joint angles [deg]"));
  // The script beside it draws the same picture again.
  const std::string svg = read_text(w / "run/figures/joint-angles.svg");
  const std::string again = "cd " + (w / "run/figures").string() + " && gnuplot -d joint-angles.gp";
  fs::remove(w / "run/figures/joint-angles.svg");
  ASSERT_EQ(std::system(again.c_str()), 0);
  EXPECT_TRUE(svg == read_text(w / "run/figures/joint-angles.svg"));
}

TEST(FiguresOfRuns, WithoutGnuplotAreDataAndScripts) {
  const Workspace w;
  run(w, bench, "run");
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const Result warned = w.sinew({"figures", "run"});
  const Result refused = w.sinew({"figures", "run", "--format", "png", "-o", "png"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(warned.code, 0);
  EXPECT_THAT(warned.err, AllOf(HasSubstr("gnuplot is missing"), HasSubstr("gnuplot-nox")));
  EXPECT_EQ(refused.code, 1) << "pictures that were asked for by name";
  for (const std::string& folder : {std::string("run/figures"), std::string("png")}) {
    EXPECT_THAT(names_in(w / folder), AllOf(Contains("joint-angles.csv"),
                                            Contains("joint-angles.gp"), Contains("index.json")));
    EXPECT_THAT(read_text(w / (folder + "/index.json")), Not(HasSubstr(".svg")));
  }
}

TEST(FiguresOfRuns, ReplaceOnlyWhatTheyKnow) {
  const Workspace w;
  run(w, bench, "run");
  const Words csv{"figures", "run", "--format", "csv"};
  ASSERT_EQ(w.sinew(csv).code, 0);
  write_text(w / "run/figures/mine.txt", "mine");
  const Result kept = w.sinew(csv);
  EXPECT_EQ(kept.code, 1);
  EXPECT_THAT(kept.err,
              AllOf(HasSubstr("run/figures/index.json: found a file"), HasSubstr("--force")));

  // A figure that is not made again goes; a file that is none of theirs stays.
  const Result only =
      w.sinew({"figures", "run", "--format", "csv", "--force", "--only", "tension"});
  ASSERT_EQ(only.code, 0) << only.err;
  EXPECT_THAT(endings(w, "run/figures", ".csv"), (Words{"tension.csv"}));
  EXPECT_EQ(read_text(w / "run/figures/mine.txt"), "mine");

  // A run in the place of the old one has no figures yet.
  ASSERT_EQ(w.sinew({"run", bench, "-o", "run", "--force", "--no-report"}).code, 0);
  EXPECT_EQ(names_in(w / "run/figures"), (Words{"mine.txt"}));

  // An index that somebody wrote cannot send it elsewhere.
  write_text(w / "run/figures/index.json",
             R"({"format":"sinew.figures/1","page":7,"figures":[3,{"svg":"../log.mcap"},)"
             R"({"script":"/etc/x.gp"},{"png":"mine.txt","curves":[1,{"file":".csv"}]}]})");
  ASSERT_EQ(w.sinew({"figures", "run", "--format", "csv", "--force"}).code, 0);
  EXPECT_TRUE(fs::exists(w / "run/log.mcap"));
  EXPECT_TRUE(fs::exists(w / "run/figures/mine.txt"));
}

TEST(FiguresOfRuns, OfSeveralRunsStandInTheirOwnFolders) {
  const Workspace w;
  run(w, bench, "a");
  run(w, stand, "b");
  ASSERT_EQ(w.sinew({"figures", "--format", "csv", "a", "b"}).code, 0);
  EXPECT_TRUE(fs::exists(w / "a/figures/index.json"));
  EXPECT_TRUE(fs::exists(w / "b/figures/index.json"));
  ASSERT_EQ(w.sinew({"figures", "a", "b", "--format", "csv", "-o", "all"}).code, 0);
  EXPECT_EQ(names_in(w / "all"), (Words{"a", "b"}));
  EXPECT_THAT(w.sinew({"figures", "a", "a", "-o", "x", "--format", "csv"}).err,
              HasSubstr("a second time"));
}

TEST(FiguresOfRuns, WrongWordsAreToldApart) {
  const Workspace w;
  run(w, bench, "run");
  EXPECT_THAT(w.sinew({"figures", "nowhere"}).err, HasSubstr("nowhere: found nothing"));
  EXPECT_THAT(w.sinew({"figures", "run", "--only", "tensoin"}).err,
              AllOf(HasSubstr("\"tensoin\""), HasSubstr("tension")));
  EXPECT_THAT(w.sinew({"figures", "run", "--format", "ps"}).err, HasSubstr("svg, png or csv"));
  EXPECT_THAT(w.sinew({"figures", "run", "--from", "2"}).err,
              StartsWith("--from: found 2 without a unit"));
  EXPECT_THAT(w.sinew({"figures", "run", "--from", "3 s", "--to", "2 s"}).err, HasSubstr("--to"));
  EXPECT_THAT(w.sinew({"figures", "run", "--from", "1 h"}).err, HasSubstr("found no samples"));
  EXPECT_THAT(w.sinew({"figures", "run", "--units", "cgs"}).err, HasSubstr("\"cgs\""));
  write_text(w / "file", "");
  EXPECT_THAT(w.sinew({"figures", "run", "-o", "file"}).err, StartsWith("file: found"));
  EXPECT_EQ(w.sinew({"figures"}).code, 2);
  EXPECT_EQ(w.sinew({"figures", "run", "--thesis", "-o", "x"}).code, 2);
  EXPECT_FALSE(fs::exists(w / "run/figures"));
}

}  // namespace
}  // namespace sinew::test::figures_of_runs_test
