// `figures` for a paper: PDF, own labels, widths, channels, several runs in the same axes; and the
// professor's way from two runs to three figures in German.
#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::figures_for_print_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string bench = "experiments/one-joint.toml";

bool has(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

// The joint alone, and with more damping.
void run_both(const Workspace& w) {
  ASSERT_EQ(w.sinew({"run", bench, "-o", "one", "--no-report"}).code, 0);
  ASSERT_EQ(w.sinew({"run", bench, "-o", "other", "--no-report", "--set", "seed=2"}).code, 0);
}

std::string header(const fs::path& csv) {
  const std::string text = read_text(csv);
  return text.substr(0, text.find('\n'));
}

const std::string german = R"toml(format = "sinew.labels/1"
decimal_comma = true

[words]
"joint angles" = "Gelenkwinkel"
"tension" = "Zugkraft"
"pressure" = "Druck"
"time" = "Zeit"
"desired" = "Soll"

[units]
"deg" = "°"
"bar gauge" = "bar (Überdruck)"
)toml";

// Three figures with own labels from two runs, with data, in five commands.
TEST(FiguresForPrint, TheProfessorsThreeFigures) {
  if (!has("gnuplot")) GTEST_SKIP() << "gnuplot is missing";
  const Workspace w;
  run_both(w);
  write_text(w / "german.toml", german);
  const Result made =
      w.sinew({"figures",     "one",      "other",        "--label", "Versuch",  "--label",
               "Vergleich",   "--only",   "joint-angles", "tension", "pressure", "--labels",
               "german.toml", "--units",  "metric",       "--width", "84 mm",    "--font",
               "8 pt",        "--format", "pdf",          "-o",      "paper"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  for (const std::string& name :
       {std::string("joint-angles"), std::string("tension"), std::string("pressure")}) {
    const std::string pdf = read_text(w / ("paper/" + name + ".pdf"));
    EXPECT_THAT(pdf, AllOf(StartsWith("%PDF"), HasSubstr("/FontFile"),
                           HasSubstr("/MediaBox [ 0 0 238 "), Not(HasSubstr("CreationDate"))));
    EXPECT_THAT(names_in(w / "paper"), Contains(name + ".gp"));
    const std::string script = read_text(w / ("paper/" + name + ".gp"));
    EXPECT_THAT(script, AllOf(HasSubstr("'Zeit [s]'"), HasSubstr("Versuch"), HasSubstr("Vergleich"),
                              HasSubstr("set decimalsign ','")));
  }
  EXPECT_THAT(read_text(w / "paper/joint-angles.gp"), HasSubstr("'Gelenkwinkel [°]'"));
  EXPECT_THAT(read_text(w / "paper/pressure.gp"), HasSubstr("'Druck [bar (Überdruck)]'"));
  // The numbers stay what every program reads.
  const Json index = Json::parse(read_text(w / "paper/index.json"));
  ASSERT_EQ(index["figures"].size(), 3u);
  for (const Json& figure : index["figures"]) {
    EXPECT_TRUE(figure.contains("pdf"));
    for (const Json& curve : figure["curves"])
      EXPECT_THAT(header(w / ("paper/" + curve["file"].get<std::string>())),
                  HasSubstr(curve["y"].get<std::string>()));
  }
  if (!has("pdftotext")) return;
  const std::string text =
      "pdftotext '" + (w / "paper/pressure.pdf").string() + "' '" + (w / "text").string() + "'";
  ASSERT_EQ(std::system(text.c_str()), 0);
  EXPECT_THAT(read_text(w / "text"), AllOf(HasSubstr("Überdruck"), HasSubstr("Versuch")));
}

TEST(FiguresForPrint, GiveTheSameBytesAgain) {
  if (!has("gnuplot")) GTEST_SKIP() << "gnuplot is missing";
  const Workspace w;
  run_both(w);
  for (const std::string& folder : {std::string("a"), std::string("b")})
    ASSERT_EQ(w.sinew({"figures", "one", "other", "--overlay", "--only", "tension", "--format",
                       "pdf,svg,csv", "-o", folder})
                  .code,
              0);
  for (const std::string& name : names_in(w / "a"))
    EXPECT_TRUE(read_text(w / ("a/" + name)) == read_text(w / ("b/" + name))) << name;
}

TEST(FiguresForPrint, ShowAnyChannelsBesideWhatWasDesired) {
  const Workspace w;
  run_both(w);
  const Result made =
      w.sinew({"figures", "one", "--channels", "/joint/*/angle,/muscle/*/pressure", "--channels",
               "/muscle/*/inlet_duty", "--format", "csv", "--json", "-o", "own"});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json figures = Json::parse(made.out)["runs"][0]["figures"];
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0]["figure"], "joint-angle-muscle-pressure");
  std::string kinds;
  for (const Json& curve : figures[0]["curves"]) kinds += curve["kind"].get<std::string>() + " ";
  EXPECT_THAT(kinds, HasSubstr("desired")) << "what the joint was to do";
  EXPECT_THAT(figures[0]["curves"].back()["y"].get<std::string>(), HasSubstr("[kPa abs]"))
      << "a pressure that only the simulation knows is asked for without /true";
  EXPECT_THAT(figures[1]["curves"][0]["y"].get<std::string>(), HasSubstr("[%]"));
}

// A run that begins a second later is laid on the other by its first motion.
TEST(FiguresForPrint, LayRunsOnEachOther) {
  const Workspace w;
  for (const auto& [folder, settle] : {std::pair("one", "1 s"), std::pair("late", "2 s")})
    ASSERT_EQ(w.sinew({"run", bench, "-o", folder, "--no-report", "--set",
                       "start.settle=" + std::string(settle)})
                  .code,
              0);
  const Result made = w.sinew({"figures", "one", "late", "--align", "event", "--only",
                               "joint-angles", "--format", "csv", "-o", "both", "--json"});
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string told = "late: laid on one by a shift of ";
  const std::size_t at = made.err.find(told);
  ASSERT_NE(at, std::string::npos) << made.err;
  EXPECT_NEAR(std::stod(made.err.substr(at + told.size())), 1, 0.02);
  const Json curves = Json::parse(made.out)["runs"][0]["figures"][0]["curves"];
  EXPECT_EQ(curves[0]["curve"], "one");
  EXPECT_THAT(w.sinew({"figures", "one", "late", "--event", "x", "-o", "x"}).code, 2);
}

TEST(FiguresForPrint, HaveAFileOfLabelsToBeginWith) {
  const Workspace w;
  run_both(w);
  const Result made = w.sinew({"figures", "one", "--labels-template"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, AllOf(StartsWith("format = \"sinew.labels/1\""),
                              HasSubstr("\"joint angles\" = \"joint angles\"")));
  write_text(w / "mine.toml", made.out);
  const Result used = w.sinew({"figures", "one", "--labels", "mine.toml", "--format", "csv"});
  EXPECT_EQ(used.code, 0);
  EXPECT_EQ(used.err, "") << "every word of it is one that a figure says";
  EXPECT_FALSE(fs::exists(w / "one/figures/labels.toml"));
}

TEST(FiguresForPrint, WrongWordsAreToldWithTheRightOnes) {
  const Workspace w;
  run_both(w);
  const auto told = [&](Words more) {
    Words words{"figures", "one"};
    words.insert(words.end(), more.begin(), more.end());
    const Result r = w.sinew(words);
    EXPECT_NE(r.code, 0);
    return r.err;
  };
  EXPECT_THAT(told({"--width", "0 mm"}), StartsWith("--width: found \"0 mm\""));
  EXPECT_THAT(told({"--width", "3 m"}), StartsWith("--width: found \"3 m\""));
  EXPECT_THAT(told({"--width", "84"}), StartsWith("--width: found 84 without a unit"));
  EXPECT_THAT(told({"--font", "9 mm"}), AllOf(StartsWith("--font: "), HasSubstr("\"9 pt\"")));
  EXPECT_THAT(told({"--height", "20 mm", "--only", "tension"}),
              AllOf(StartsWith("--height: found 20 mm"), HasSubstr("mm at least for figure")));
  EXPECT_THAT(told({"--format", "eps"}), HasSubstr("pdf, svg, png or csv"));
  EXPECT_THAT(told({"--channels", "/joint/*/angel"}),
              AllOf(StartsWith("--channels: found \"/joint/*/angel\""), HasSubstr("try ")));
  EXPECT_THAT(told({"--label", "a", "--label", "b", "-o", "x"}),
              StartsWith("--label: found 2 labels; expected one for each run, 1 at most"));
  EXPECT_THAT(told({"other", "--label", "a", "--label", "a", "-o", "x"}), HasSubstr("two runs"));
  EXPECT_THAT(told({"--title", "A title"}), StartsWith("--title: "));
  EXPECT_EQ(w.sinew({"figures", "one", "other", "--overlay"}).code, 2) << "no folder";
  write_text(w / "bad.toml", "format = \"sinew.labels/1\"\n[words]\n\"tension\" = 3\n");
  EXPECT_THAT(told({"--labels", "bad.toml"}), StartsWith("bad.toml:3:"));
  EXPECT_THAT(told({"--labels", "nowhere.toml"}), HasSubstr("nowhere.toml"));
  EXPECT_FALSE(fs::exists(w / "one/figures"));
  EXPECT_FALSE(fs::exists(w / "x"));

  write_text(w / "slip.toml", "format = \"sinew.labels/1\"\n[words]\n\"tenson\" = \"Kraft\"\n");
  const Result warned = w.sinew({"figures", "one", "--labels", "slip.toml", "--format", "csv"});
  EXPECT_EQ(warned.code, 0);
  EXPECT_THAT(warned.err, AllOf(HasSubstr("slip.toml:3:"), HasSubstr("\"tension\"")));
}

}  // namespace
}  // namespace sinew::test::figures_for_print_test
