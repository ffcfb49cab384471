// `sinew new`: what it writes is valid and runs, in both sets of units, for every shipped robot;
// and nothing that stands there is lost.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"

namespace sinew::test::new_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::ordered_json;

Words with_units(Words words, bool metric) {
  if (metric) words.emplace_back("--metric");
  return words;
}

void expect_made(const Workspace& w, const Words& words) {
  const Result r = w.sinew(words);
  EXPECT_EQ(r.code, 0) << words[1] << " " << r.err << r.out;
}

TEST(New, RobotExperimentAndPlanAreValidAndRun) {
  for (const bool metric : {false, true}) {
    const Workspace w;
    const Result robot = w.sinew(with_units({"new", "robot", "arm"}, metric));
    EXPECT_EQ(robot.code, 0) << robot.err;
    EXPECT_EQ(robot.out, "arm/robot.toml\narm/actuator.toml\narm/valves.toml\n");
    EXPECT_THAT(robot.err, HasSubstr("sinew new experiment arm-moves --of arm/robot.toml"));
    expect_made(w, with_units({"new", "experiment", "lift", "--of", "arm/robot.toml"}, metric));
    expect_made(w, with_units({"new", "plan", "gains", "--of", "lift.toml", "-o", "a/b"}, metric));
    expect_made(w, with_units({"new", "tuning", "best", "--of", "lift.toml"}, metric));
    expect_made(w, with_units({"new", "valves", "fast"}, metric));
    expect_made(w, with_units({"new", "mapping", "daq"}, metric));
    expect_made(w, with_units({"new", "actuator", "muscle-2"}, metric));
    expect_made(w, with_units({"new", "rig", "stand"}, metric));

    const Result checked =
        w.sinew({"check", "arm/robot.toml", "arm/actuator.toml", "arm/valves.toml", "lift.toml",
                 "a/b/gains.toml", "muscle-2.toml", "stand/rig.toml", "best.toml", "fast.toml",
                 "daq.toml"});
    EXPECT_EQ(checked.code, 0) << checked.out;
    const Result run = w.sinew({"run", "lift.toml", "-o", "run", "--no-report", "--quiet"});
    EXPECT_EQ(run.code, 0) << run.err;
    const Json summary = Json::parse(read_text(w / "run/summary.json"));
    EXPECT_LT(summary["joints"]["lever"]["tracking_rms_rad"].get<double>(), 0.06);
    EXPECT_EQ(w.sinew({"run", "stand/rig.toml", "-o", "rig", "--no-report", "--quiet"}).code, 0);
    const Result table = w.sinew({"sweep", "a/b/gains.toml", "-o", "gains.csv", "--quiet"});
    EXPECT_EQ(table.code, 0) << table.err;
    const std::string csv = read_text(w / "gains.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 2 * 3);
    const Result asked =
        w.sinew({"actuator", "muscle-2.toml", "--length", "80 mm", "--pressure", "4 bar gauge"});
    EXPECT_EQ(asked.code, 0) << asked.err;
    EXPECT_THAT(read_text(w / "muscle-2.toml"), HasSubstr("name   = \"muscle-2\""));
  }
}

// The wiring names the sensors and muscles of a new robot; a name that is none of them is told.
TEST(New, AWiringFitsTheNewRobotAndARefusedNameIsTold) {
  const Workspace w;
  expect_made(w, {"new", "robot", "arm"});
  expect_made(w, {"new", "wiring", "bench", "-o", "arm"});
  EXPECT_EQ(w.sinew({"check", "arm/bench.toml"}).code, 0);
  std::string robot = read_text(w / "arm/robot.toml");
  const std::string valves = "valves = \"valves.toml\"";
  robot.replace(robot.find(valves), valves.size(), valves + ", wiring = \"bench.toml\"");
  write_text(w / "arm/robot.toml", robot);
  const Result fits = w.sinew({"check", "arm/robot.toml"});
  EXPECT_EQ(fits.code, 0) << fits.out << fits.err;
  std::string wiring = read_text(w / "arm/bench.toml");
  wiring.replace(wiring.find("\"extensor\""), 10, "\"extenser\"");
  write_text(w / "arm/bench.toml", wiring);
  const Result other = w.sinew({"check", "arm/robot.toml"});
  EXPECT_NE(other.code, 0);
  EXPECT_THAT(other.out + other.err, HasSubstr("extenser"));

  EXPECT_EQ(w.sinew({"new", "wiring", "two words"}).code, 1);
  EXPECT_THAT(w.sinew({"new", "wiring", "two words"}).err, HasSubstr("a name of a to z"));
  EXPECT_THAT(w.sinew({"new", "wiring", "bench", "-o", "arm"}).err, HasSubstr("there already"));
  EXPECT_THAT(w.sinew({"new", "wiring", "x", "--of", "arm/robot.toml"}).err,
              HasSubstr("a file for a new wiring to be of"));
}

// Numbers of a text such as "[0.9969, 7.25e-08 1/Pa]".
std::vector<double> numbers_in(std::string text) {
  for (char& c : text)
    if (c == '[' || c == ']' || c == ',') c = ' ';
  std::istringstream in(text);
  std::vector<double> out;
  for (std::string word; in >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end && *end == 0) out.push_back(value);
  }
  return out;
}

TEST(New, BothSetsOfUnitsDescribeTheSameMachine) {
  const Workspace w;
  int compared = 0;
  const std::pair<const char*, const char*> kinds[] = {{"robot", "/robot.toml"},
                                                       {"rig", "/rig.toml"},
                                                       {"actuator", ".toml"},
                                                       {"experiment", ".toml"}};
  for (const auto& [kind, file] : kinds) {
    Json values[2];
    for (const bool metric : {false, true}) {
      const std::string folder = std::string(kind) + (metric ? "-metric" : "-inch");
      expect_made(w, with_units({"new", kind, "x", "-o", folder}, metric));
      values[metric] = Json::parse(w.sinew({"show", folder + "/x" + file, "--json"}).out);
    }
    ASSERT_EQ(values[0].size(), values[1].size()) << kind;
    for (std::size_t i = 0; i < values[0].size(); ++i) {
      const Json &a = values[0][i], &b = values[1][i];
      EXPECT_EQ(a["key"], b["key"]);
      if (!a.contains("si")) {
        EXPECT_TRUE(a["key"] == "robot" || a["written"] == b["written"]) << a["key"];
        continue;
      }
      const std::vector<double> x = numbers_in(a["si"]), y = numbers_in(b["si"]);
      ASSERT_EQ(x.size(), y.size()) << a["key"];
      for (std::size_t k = 0; k < x.size(); ++k, ++compared)
        EXPECT_NEAR(x[k], y[k], 1e-3 * std::abs(x[k])) << kind << ": " << a["key"];
    }
  }
  EXPECT_GT(compared, 200);
}

// The thesis's units do not appear in a metric file, nor the other way round.
TEST(New, AFileKeepsToItsUnits) {
  for (const bool metric : {false, true}) {
    const Workspace w;
    for (const char* kind : {"robot", "rig", "actuator", "experiment", "plan", "tuning", "valves",
                             "wiring", "mapping"}) {
      expect_made(w, with_units({"new", kind, std::string("x-") + kind}, metric));
    }
    const std::vector<const char*> others =
        metric ? std::vector<const char*>{"psi", "lbf", " in\"", " lb\"", "in2", "in3", "degR"}
               : std::vector<const char*>{"bar gauge", "bar abs", " mm", "N m", " kg\"", "degC"};
    for (const auto& entry : fs::recursive_directory_iterator(w.path())) {
      const std::string path = entry.path().lexically_relative(w.path()).string();
      if (!path.starts_with("x-") || !entry.is_regular_file()) continue;
      for (const char* other : others)
        EXPECT_THAT(read_text(entry.path()), Not(HasSubstr(other))) << path;
    }
  }
}

TEST(New, AnExperimentIsOfEveryShippedRobot) {
  const Workspace w;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(w / "robots")) {
    const std::string robot = (entry.path() / "robot.toml").lexically_relative(w.path()).string();
    if (!fs::exists(w / robot)) continue;
    const std::string name = entry.path().filename().string();
    expect_made(w, {"new", "experiment", name, "--of", robot});
    expect_made(w, {"new", "plan", name + "-plan", "--of", name + ".toml"});
    expect_made(w, {"new", "tuning", name + "-tuning", "--of", name + ".toml"});
    ++count;
  }
  EXPECT_GE(count, 10);
  const std::string text = read_text(w / "leg.toml");
  EXPECT_THAT(text, AllOf(HasSubstr("robot  = \"robots/leg/robot.toml\""), HasSubstr("hip = "),
                          HasSubstr("knee = "), Not(HasSubstr("lever"))));
}

TEST(New, NamesAndFoldersOfAnyLettersStandInTheFile) {
  const Workspace w;
  expect_made(w, {"new", "robot", "NEW", "-o", "my \"robots\" NEW"});
  expect_made(w, {"new", "experiment", "lever", "--of", "my \"robots\" NEW/NEW/robot.toml"});
  expect_made(w, {"new", "robot", "actuator", "-o", "über"});
  expect_made(
      w, {"new", "experiment", "lift", "-o", "line\nbreak", "--of", "über/actuator/robot.toml"});
  EXPECT_EQ(
      w.sinew({"check", "lever.toml", "über/actuator/robot.toml", "line\nbreak/lift.toml"}).code,
      0);
  EXPECT_THAT(read_text(w / "line\nbreak/lift.toml"),
              HasSubstr("robot  = \"../über/actuator/robot.toml\""));
}

TEST(New, NothingIsOverwritten) {
  const Workspace w;
  expect_made(w, {"new", "robot", "arm"});
  const std::string valves = "mine\n";
  write_text(w / "arm/valves.toml", valves);
  fs::remove(w / "arm/robot.toml");
  const Result again = w.sinew({"new", "robot", "arm", "--metric"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("found a file that is there already"));
  EXPECT_EQ(read_text(w / "arm/valves.toml"), valves);
  EXPECT_THAT(names_in(w / "arm"), ElementsAre("actuator.toml", "valves.toml"));
  fs::create_symlink("nowhere", w / "link.toml");
  EXPECT_EQ(w.sinew({"new", "plan", "link"}).code, 1);
  EXPECT_FALSE(fs::exists(w / "nowhere"));
}

TEST(New, WrongInputsAreRefusedInWords) {
  const Workspace w;
  write_text(w / "file", "no folder\n");
  write_text(w / "cut.toml", "format = \"sinew.robot/1\"\n[link\n");
  write_text(w / "bare.toml", "format = \"sinew.robot/1\"\nname = \"x\"\n");
  const std::string robot = "robots/leg/robot.toml", lift = "experiments/one-joint.toml";
  struct Case {
    Words words;
    int code;
    const char* says;
  };
  const Case cases[] = {
      {{"robt", "x"}, 2, "KIND: found \"robt\""},
      {{"robot"}, 2, "NAME: missing"},
      {{}, 2, "KIND: missing"},
      {{"robot", ""}, 1, "expected a name"},
      {{"robot", "a/b"}, 1, "found \"a/b\"; expected a name"},
      {{"robot", ".."}, 1, "found \"..\""},
      {{"robot", "arm.toml"}, 1, "try \"arm\""},
      {{"robot", "my arm"}, 1, "try \"my-arm\""},
      {{"robot", "ärm"}, 1, "found \"ärm\""},
      {{"robot", std::string(65, 'a')}, 1, "a name of 65 letters"},
      {{"robot", "x", "-o", "file"}, 1, "file: found a file; expected a folder"},
      {{"robot", "x", "-o", "file/below"}, 1, "file/below/x: found no folder"},
      {{"robot", "x", "--of", robot}, 1, "for a new robot to be of"},
      {{"actuator", "x", "--of", robot}, 1, "for a new actuator to be of"},
      {{"experiment", "x", "--of", "none.toml"}, 1, "none.toml: found no readable file"},
      {{"experiment", "x", "--of", "robots"}, 1, "robots: found a folder"},
      {{"experiment", "x", "--of", lift}, 1, "expected the robot that the new experiment is of"},
      {{"experiment", "x", "--of", "robots/leg/valves.toml"},
       1,
       "found format = \"sinew.valves/1\""},
      {{"experiment", "x", "--of", "cut.toml"}, 1, "cut.toml:2:"},
      {{"experiment", "x", "--of", "bare.toml"}, 1, "no joint with muscles"},
      {{"plan", "x", "--of", robot}, 1, "expected the experiment that the new plan is of"},
      {{"robot", "x", "--actuator", robot}, 1, "expected an actuator's file"},
      {{"robot", "x", "--actuator", "none.toml"}, 1, "none.toml: found no readable file"},
      {{"plan", "x", "--actuator", "none.toml"}, 1, "an actuator for a new plan"},
      {{"plan", "x", "--force"}, 2, "--force"},
  };
  for (const Case& c : cases) {
    Words words{"new"};
    words.insert(words.end(), c.words.begin(), c.words.end());
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, c.code) << c.says << r.err;
    EXPECT_THAT(r.err, HasSubstr(c.says));
    EXPECT_THAT(r.out, IsEmpty());
  }
  EXPECT_THAT(names_in(w.path()),
              ElementsAre("bare.toml", "cut.toml", "experiments", "file", "robots"));
}

// A muscle from somebody's forces gets a robot around it: mounted within the lengths that were
// measured, on a load cell that reaches its force, at a supply within its pressures.
TEST(New, RobotOfAMuscleOfOnesOwnIsValidAndRuns) {
  const Workspace w;
  const std::string map = SINEW_SOURCE_DIR "/data/martens_boblan_2017/DMSP-10-250_force_map.csv";
  ASSERT_EQ(w.sinew({"identify", "static", map, "--map", "length=L_m,pressure=P_gauge_Pa,force=F_N",
                     "--unit", "L_m=m", "--unit", "P_gauge_Pa=Pa gauge", "--unit", "F_N=N",
                     "--rest-length", "250 mm", "--name", "dmsp", "-o", "dmsp.toml", "--no-report",
                     "--quiet"})
                .code,
            0);
  for (const bool metric : {false, true}) {
    const std::string name = metric ? "arm-mm" : "arm-in";
    const Result made =
        w.sinew(with_units({"new", "robot", name, "--actuator", "dmsp.toml"}, metric));
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.out, name + "/robot.toml\n" + name + "/valves.toml\n");
    const Result shown = w.sinew({"show", name + "/robot.toml", "muscle.flexor.mount_length",
                                  "air.supply.pressure", "--json"});
    EXPECT_EQ(shown.code, 0) << shown.err;
    EXPECT_EQ(w.sinew({"check", name + "/robot.toml"}).code, 0);
    expect_made(w, with_units({"new", "experiment", name + "-lifts", "--of", name + "/robot.toml"},
                              metric));
    EXPECT_EQ(
        w.sinew({"run", name + "-lifts.toml", "-o", name + "-run", "--no-report", "--quiet"}).code,
        0);
    const Json summary = Json::parse(read_text(w / (name + "-run/summary.json")));
    EXPECT_LT(summary["joints"]["lever"]["tracking_rms_rad"].get<double>(), 0.12);
  }
  EXPECT_THAT(read_text(w / "arm-mm/robot.toml"), HasSubstr("value = \"224 mm\""));
  EXPECT_THAT(read_text(w / "arm-mm/robot.toml"), HasSubstr("value = \"6.5 bar gauge\""));
}

}  // namespace
}  // namespace sinew::test::new_test
