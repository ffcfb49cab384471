// tests/cli/units_test.cpp - in whose units the program shows numbers, and who says so.
#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "tests/cli/json.h"

namespace sinew::test::units_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const Words muscle = {"actuator",   "robots/leg/actuator.toml", "--length", "80 mm", "--pressure",
                      "4 bar gauge"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

void run_lever(const Workspace& w, const Words& more = {}) {
  const Result run =
      w.sinew(with({"run", "experiments/one-joint.toml", "-o", "lever", "--quiet"}, more));
  ASSERT_EQ(run.code, 0) << run.err;
}

TEST(Units, CalculatorsShowThoseThatAreAskedFor) {
  const Workspace w;
  EXPECT_THAT(w.sinew(muscle).out, AllOf(HasSubstr("0.08 m"), HasSubstr("3.14961 in")));
  EXPECT_THAT(w.sinew(with(muscle, {"--units", "metric"})).out,
              AllOf(HasSubstr("80 mm"), HasSubstr("4 bar gauge"), HasSubstr(" N/mm\n"),
                    HasSubstr(" deg\n"), Not(HasSubstr(" in\n"))));
  EXPECT_THAT(w.sinew(with(muscle, {"--units", "metric,length=cm"})).out, HasSubstr("8 cm\n"));
  const Words table = {"actuator",   "robots/leg/actuator.toml",
                       "--length",   "80mm:90mm:5mm",
                       "--pressure", "4 bar gauge",
                       "--units",    "metric"};
  EXPECT_THAT(w.sinew(table).out, AllOf(HasSubstr("length [mm]"), HasSubstr("pressure [bar gauge]"),
                                        HasSubstr("k at p [N/mm]"), HasSubstr("volume [mL]")));
  EXPECT_THAT(w.sinew({"valve", "robots/leg/valves.toml", "inlet", "--upstream", "6 bar gauge",
                       "--downstream", "0 bar gauge", "--volume", "20 mL", "--units", "metric"})
                  .out,
              AllOf(HasSubstr(" mm2"), HasSubstr("20 mL between 0 bar gauge and 6 bar gauge"),
                    Not(HasSubstr("in2"))));
  EXPECT_THAT(w.sinew({"kinematics", "robots/leg/robot.toml", "--foot", "-50 mm, -330 mm",
                       "--force", "0 N, -90 N", "--units", "metric"})
                  .out,
              AllOf(HasSubstr("foot at -50 mm, -330 mm"), HasSubstr("Jacobian [mm/rad]"),
                    HasSubstr(" N m\n")));
  EXPECT_THAT(w.sinew({"force-beam", "--units", "metric"}).out,
              AllOf(HasSubstr(" MPa"), HasSubstr(" mV/N"), Not(HasSubstr("lbf"))));
}

TEST(Units, TheOptionIsStrongerThanTheEnvironmentTheRunAndThePerson) {
  const Workspace w;
  const auto length = [&](const Words& more) {
    const std::string out = w.sinew(with(muscle, more)).out;
    return out.substr(out.find("length") + 6,
                      out.find('\n', out.find("length")) - out.find("length") - 6);
  };
  std::filesystem::create_directories(w / "config/sinew");
  write_text(w / "config/sinew/settings.toml",
             "format = \"sinew.settings/1\"\nunits = \"metric\"\n");
  EXPECT_THAT(length({}), HasSubstr(" 80 mm"));
  setenv("SINEW_UNITS", "length=cm", 1);
  EXPECT_THAT(length({}), HasSubstr(" 8 cm"));
  EXPECT_THAT(length({"--units", "thesis"}), HasSubstr(" 3.14961 in"));
  unsetenv("SINEW_UNITS");
}

TEST(Units, ARunSaysInWhichItIsShown) {
  const Workspace w;
  run_lever(w, {"--set", "page.units=thesis", "--no-report"});
  EXPECT_THAT(w.sinew({"analyze", "lever"}).out, HasSubstr(" deg"));
  EXPECT_THAT(w.sinew({"analyze", "lever", "--units", "si"}).out, HasSubstr(" rad"));
  EXPECT_THAT(read_text(w / "lever/resolved.toml"), HasSubstr("units"));
}

TEST(Units, AVerdictsReportedWordsStayTheSources) {
  const Workspace w;
  ASSERT_EQ(
      w.sinew({"run", "experiments/walk-test-1.toml", "-o", "walk", "--quiet", "--no-report"}).code,
      0);
  EXPECT_THAT(w.sinew({"analyze", "walk"}).out, HasSubstr("55 in to 60 in"));
  EXPECT_THAT(w.sinew({"analyze", "walk", "--units", "metric"}).out,
              AllOf(HasSubstr("55 to 60 in"), HasSubstr("1397 mm to 1524 mm"), HasSubstr(" N ")));
}

TEST(Units, AnswersForProgramsStayInSI) {
  const Workspace w;
  run_lever(w);
  const std::string plain = w.sinew({"analyze", "lever", "--json"}).out;
  EXPECT_EQ(w.sinew({"analyze", "lever", "--json", "--units", "metric"}).out, plain);
  EXPECT_EQ(w.sinew(with(muscle, {"--json", "--units", "metric"})).out,
            w.sinew(with(muscle, {"--json"})).out);
  const std::string json = read_text(w / "lever/summary.json");
  setenv("SINEW_UNITS", "metric", 1);
  EXPECT_EQ(w.sinew({"analyze", "lever", "--json"}).out, plain);
  unsetenv("SINEW_UNITS");
}

TEST(Units, APageBeginsInThem) {
  if (!SINEW_HAS_PAGE) GTEST_SKIP() << "built without npm";
  const Workspace w;
  run_lever(w);
  const auto start = [&](const Words& more) {
    const Result made = w.sinew(with({"report", "lever", "-o", "page.html", "--force"}, more));
    EXPECT_EQ(made.code, 0) << made.err;
    const std::string page = read_text(w / "page.html");
    const std::size_t at = page.find("{\"start\":\"");
    return at == page.npos ? "" : page.substr(at + 10, page.find('"', at + 10) - at - 10);
  };
  EXPECT_EQ(start({}), "si");
  EXPECT_EQ(start({"--units", "metric"}), "metric");
  EXPECT_EQ(start({"--units", "metric,length=cm"}), "own");
}

TEST(Units, WrongWordsSayWhereTheyStand) {
  const Workspace w;
  const Result option = w.sinew(with(muscle, {"--units", "imperial"}));
  EXPECT_EQ(option.code, 2);
  EXPECT_THAT(option.err, HasSubstr("--units: found \"imperial\"; expected si, thesis or metric"));
  setenv("SINEW_UNITS", "mertic", 1);
  const Result variable = w.sinew(muscle);
  EXPECT_EQ(variable.code, 1);
  EXPECT_THAT(variable.err,
              HasSubstr("SINEW_UNITS: found \"mertic\"; expected si, thesis or metric, "
                        "then QUANTITY=UNIT; try \"metric\""));
  unsetenv("SINEW_UNITS");
  std::filesystem::create_directories(w / "config/sinew");
  write_text(w / "config/sinew/settings.toml",
             "format = \"sinew.settings/1\"\n\nunits = \"length=bar\"\n");
  EXPECT_THAT(w.sinew(muscle).err,
              HasSubstr("config/sinew/settings.toml:3:1: units: found \"bar\", which "
                        "measures something else"));
  EXPECT_THAT(
      w.sinew({"run", "experiments/one-joint.toml", "-o", "x", "--set", "page.units=inch"}).err,
      HasSubstr("page.units: found \"inch\""));
}

TEST(Units, WhatIsSaidNowIsStrongerThanATuningsFile) {
  const Workspace w;
  write_text(w / "lever.toml",
             "format = \"sinew.tuning/1\"\ntitle = \"A lever\"\n"
             "experiment = \"experiments/one-joint.toml\"\n"
             "tune = [\"joint.lever.angle_gain=0.05:0.3 %/count log\"]\n"
             "minimize = [\"joints.lever.tracking_rms_rad\"]\n"
             "where = [\"joints.lever.excursion_rad <= 3 rad\"]\n"
             "population = 6\ngenerations = 1\n");
  const Words tune = {"tune", "lever.toml", "--quiet"};
  const Result plain = w.sinew(tune);
  EXPECT_THAT(plain.out, AllOf(HasSubstr("minimize  joints.lever.tracking_rms [rad]"),
                               HasSubstr("where     joints.lever.excursion_rad <= 3 rad")));
  EXPECT_THAT(w.sinew(with(tune, {"--units", "metric"})).out,
              AllOf(HasSubstr("minimize  joints.lever.tracking_rms [deg]"),
                    HasSubstr("where     joints.lever.excursion <= 171.9 deg"),
                    HasSubstr("joint.lever.angle_gain [%/count]")));
  // The units of the person's settings leave those that the file names.
  std::filesystem::create_directories(w / "config/sinew");
  write_text(w / "config/sinew/settings.toml",
             "format = \"sinew.settings/1\"\nunits = \"metric\"\n");
  EXPECT_THAT(w.sinew(tune).out, AllOf(HasSubstr("minimize  joints.lever.tracking_rms [deg]"),
                                       HasSubstr("joints.lever.excursion_rad <= 3 rad")));
  EXPECT_EQ(w.sinew(with(tune, {"--json"})).out,
            w.sinew(with(tune, {"--json", "--units", "thesis"})).out);
}

TEST(Units, ASweepShowsFiguresThatNameNoUnitInThem) {
  const Workspace w;
  const Words sweep = {
      "sweep",    "experiments/one-joint.toml",
      "--vary",   "joint.lever.angle_gain=0.02,0.03 %/count",
      "--report", "joints.lever.tracking_rms_rad, joints.lever.excursion_rad [rad]",
      "--quiet"};
  EXPECT_THAT(w.sinew(sweep).out, HasSubstr("joints.lever.tracking_rms [rad]"));
  EXPECT_THAT(w.sinew(with(sweep, {"--units", "metric"})).out,
              AllOf(HasSubstr("joints.lever.tracking_rms [deg]"),
                    HasSubstr("joints.lever.excursion [rad]")));
  EXPECT_EQ(w.sinew(with(sweep, {"--units", "metric", "--json"})).out,
            w.sinew(with(sweep, {"--json"})).out);
}

TEST(Units, AnIdentificationShowsWhatItFoundInThem) {
  const Workspace w;
  write_text(w / "mesh.csv", "length [mm],diameter [mm]\n65,11.7\n75,10.5\n85,9.0\n95,6.8\n");
  const Words mesh = {"identify", "geometry", "mesh.csv", "--quiet"};
  const auto unit_of_length = [](const std::string& out) {
    const std::string row = out.substr(out.find("\nthread_length") + 1);
    std::istringstream words(row);
    std::string name, unit;
    double value = 0;
    words >> name >> value >> unit;
    return unit;
  };
  EXPECT_EQ(unit_of_length(w.sinew(mesh).out), "m");
  EXPECT_EQ(unit_of_length(w.sinew(with(mesh, {"--units", "thesis"})).out), "in");
  EXPECT_EQ(w.sinew(with(mesh, {"--units", "thesis", "--json"})).out,
            w.sinew(with(mesh, {"--json"})).out);
  setenv("SINEW_UNITS", "length=cm", 1);
  EXPECT_EQ(unit_of_length(w.sinew(mesh).out), "cm");
  unsetenv("SINEW_UNITS");
  write_text(w / "weights.csv",
             "load [lbf],a [V],b [V]\n0,0.1,0.1\n1,0.6,0.4\n2,1.1,0.7\n3,1.6,1.0\n4,2.1,1.3\n");
  const Words weights = {"identify", "sensor", "weights.csv", "--quiet"};
  EXPECT_THAT(w.sinew(weights).out, HasSubstr("scale [V/lbf]"));
  EXPECT_THAT(w.sinew(with(weights, {"--units", "metric"})).out, HasSubstr("scale [mV/N]"));
}

// Metric times are in ms; a difference of some seconds is not.
TEST(Units, ALongTimesDifferenceIsInSeconds) {
  const Workspace w;
  const Words run = {"run", "experiments/one-joint.toml", "--quiet", "--no-report", "-o"};
  ASSERT_EQ(w.sinew(with(run, {"once"})).code, 0);
  ASSERT_EQ(w.sinew(with(run, {"twice", "--set", "sequence.repeat=2"})).code, 0);
  const std::string out = w.sinew({"compare", "once", "twice", "--units", "metric", "--quiet"}).out;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(out, found, std::regex("\n *duration +([^\n]*)"))) << out;
  EXPECT_THAT(found[1].str(), AllOf(HasSubstr(" s "), Not(HasSubstr(" ms")))) << out;
}

// Digits that nobody wrote are not shown, and no bit is lost on the way through resolved.toml.
TEST(Units, ValuesAreShownAsTheyWereWritten) {
  const Workspace w;
  run_lever(w, {"--set", "joint.lever.angle_gain=0.035 %/count", "--no-report"});
  EXPECT_THAT(read_text(w / "lever/resolved.toml"),
              AllOf(HasSubstr("0.035 %/count"), Not(HasSubstr("0.00035000000000000005"))));
  const Words show = {"show", "lever/resolved.toml", "joint.lever.angle_gain"};
  EXPECT_THAT(w.sinew(show).out, AllOf(HasSubstr("0.035 %/count"), HasSubstr(" 0.00035 1/count"),
                                       Not(HasSubstr("000000005"))));
  EXPECT_EQ(json(w, show)[0]["si"], "0.00035000000000000005 1/count");
}

}  // namespace
}  // namespace sinew::test::units_test
