// The program refuses what cannot be: with its message, its exit code, and nothing left behind.
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace sinew::test::bad_input_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::string walk = "experiments/walk-test-1.toml";
const std::string robot = "robots/leg/robot.toml";

std::string at(const std::string& file, int line) { return file + ":" + std::to_string(line); }

// --- values of a file ---

struct Case {
  const char* name;
  const char* file;
  const char* from;
  const char* to;
  std::vector<const char*> says;
};

// For the test's name.
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class BadValue : public ::testing::TestWithParam<Case> {};

TEST_P(BadValue, IsNamedWithItsPlaceAndNothingRuns) {
  const Case& c = GetParam();
  const Workspace w;
  const int line = w.edit(c.file, c.from, c.to);
  for (const char* command : {"run", "check"}) {
    const Result result = w.sinew({command, walk});
    EXPECT_EQ(result.code, 1) << result.err;
    const std::string said = result.err + result.out;
    EXPECT_THAT(said, HasSubstr(at(c.file, line) + ":"));
    for (const char* words : c.says) EXPECT_THAT(said, HasSubstr(words));
  }
  EXPECT_FALSE(std::filesystem::exists(w / "runs"));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadValue,
    ::testing::Values(
        Case{"WrongUnit",
             "robots/leg/robot.toml",
             R"("23.8 lb")",
             R"("23.8 lbf")",
             {"trolley.total_mass: found \"23.8 lbf\", N (force); expected kg (mass)",
              "try lb: lbf is force, lb is mass"}},
        Case{"NoUnit",
             "robots/leg/robot.toml",
             R"("5 ft")",
             "5",
             {"trolley.track_length: found 5 without a unit; expected m (length)"}},
        Case{"GaugeOrAbsMissing",
             "robots/leg/robot.toml",
             R"("100 psi gauge")",
             R"("100 psi")",
             {"a pressure without its reference", "try \"100 psi gauge\" or \"100 psi abs\""}},
        Case{"UnknownKey",
             "experiments/walk-test-1.toml",
             "settle       =",
             "setle        =",
             {"start.setle: found an unknown key", "did you mean that?", "settle"}},
        Case{"NegativeMass",
             "robots/leg/robot.toml",
             R"("0.469 lb")",
             R"("-0.469 lb")",
             {"link.tibia.mass: found \"-0.469 lb\"",
              "expected at least 1e-09 kg: a link has a mass"}},
        Case{"MassOfNoMachine",
             "robots/leg/robot.toml",
             R"("23.8 lb")",
             R"("1e300 kg")",
             {"trolley.total_mass: found \"1e300 kg\"", "an elephant has 6000 kg"}},
        Case{"EfficiencyAboveAll",
             "robots/leg/valves.toml",
             R"(area = "9.774e-6 ft2", efficiency = 0.85)",
             R"(area = "9.774e-6 ft2", efficiency = 1.1)",
             {"valve.inlet.flow.efficiency: found 1.1; expected 0 to 1",
              "a share of the ideal flow"}},
        Case{"PoleBelowZero",
             "robots/leg/robot.toml",
             R"("10 deg")",
             R"("-10 deg")",
             {"low_level.stiffness_pole_clamp: found a distance below 0", "-800 deg for never"}},
        Case{"ScaleTheOtherWay",
             "robots/leg/robot.toml",
             R"("0.1689 V/lbf")",
             R"("-0.1689 V/lbf")",
             {"sensor.hip_flexor_tension.real.scale: found",
              "a sensor's reading rises with what it measures"}},
        Case{"AssumedLengthOfNoLeg",
             "robots/leg/robot.toml",
             R"("3.15 in", source = "B.1: 2416 count")",
             R"("315 in", source = "B.1: 2416 count")",
             {"low_level.assumed_mount_length: found 241605 count of sensor.hip_angle",
              "at most 20000 count"}},
        Case{"AssumedThreadOfNoLeg",
             "robots/leg/robot.toml",
             R"("4.218 in", source = "B.1)",
             R"("300 in", source = "B.1)",
             {"low_level.assumed_thread_length: found 230100 count"}},
        Case{"BandInAnotherUnit",
             "experiments/walk-test-1.toml",
             R"(wording = "range")",
             "accept = [\"40 lb\", \"60 lb\"]\nband_reason = \"ours\"",
             {"reported[0].accept: found \"40 lb\"", "expected m (length)"}},
        Case{"ChannelThatIsNone",
             "experiments/walk-test-1.toml",
             R"(channels = ["*"])",
             R"(channels = ["/jiont/*"])",
             {"log.channels: found \"/jiont/*\""}},
        Case{"NotANumber",
             "experiments/walk-test-1.toml",
             R"("0.6 s")",
             R"("nan s")",
             {"start.settle: found \"nan s\"; expected a finite number of s (time)"}},
        Case{"BareNotANumber",
             "robots/leg/robot.toml",
             "stiffness_factor      = 5.5",
             "stiffness_factor      = nan",
             {"low_level.stiffness_factor: found nan"}},
        Case{"DecimalComma",
             "experiments/walk-test-1.toml",
             R"("0.6 s")",
             R"("0,6 s")",
             {"start.settle: found \"0,6 s\"", "try a decimal point: \"0.6 s\""}},
        Case{"NewerFormat",
             "experiments/walk-test-1.toml",
             "sinew.experiment/1",
             "sinew.experiment/2",
             {"or older", "a newer Sinew"}}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(BadPath, OutOfReachIsNamedUnlessTheNearestPointWillDo) {
  const Workspace w;
  w.edit(walk, R"(["-13.5 in"])", R"(["-16 in"])");
  for (const char* command : {"run", "check"}) {
    const Result result = w.sinew({command, walk});
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(
        result.err + result.out,
        AllOf(HasSubstr(walk + ":"), HasSubstr("phase.propulsion: found a path out of reach"),
              HasSubstr("try the nearest point")));
  }
  EXPECT_FALSE(std::filesystem::exists(w / "runs"));

  const Result nearest = w.sinew({"run", walk, "--allow-unreachable"});
  EXPECT_EQ(nearest.code, 0);
  EXPECT_THAT(nearest.err, HasSubstr("the foot is out of reach in "));
}

TEST(BadFile, AllOfItsProblemsAreToldAtOnce) {
  const Workspace w;
  const int first = w.edit(robot, R"("23.8 lb")", R"("23.8 lbf")");
  const int second = w.edit(robot, R"("0.469 lb")", R"("-0.469 lb")");
  const Result result = w.sinew({"run", walk});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr(at(robot, first)), HasSubstr(at(robot, second))));
  EXPECT_THAT(result.out, IsEmpty());
}

TEST(BadFile, MissingExperimentIsNamed) {
  const Workspace w;
  const Result result = w.sinew({"run", "experiments/wlak.toml"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, StartsWith("experiments/wlak.toml: found no readable file"));
}

TEST(BadFile, MissingRobotIsNamedWhereItIsAskedFor) {
  const Workspace w;
  const int line = w.edit(walk, "../robots/leg/robot.toml", "../robots/dog/robot.toml");
  const Result result = w.sinew({"run", walk});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, AllOf(HasSubstr(at(walk, line)), HasSubstr("a file that exists")));
}

TEST(BadFile, ARobotIsNoExperiment) {
  const Workspace w;
  const Result result = w.sinew({"run", robot});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("found \"robot\"; expected \"sinew.experiment/1\""));
}

// --- predict.dat ---

TEST(BadValveTiming, CutShort) {
  const Workspace w;
  const std::string text = read_text(w / "robots/leg/predict.dat");
  write_text(w / "robots/leg/predict.dat", text.substr(0, text.size() / 2));
  for (const Words& words : {Words{"run", walk}, Words{"check", "robots/leg/predict.dat"}}) {
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err + result.out, AllOf(HasSubstr("predict.dat:"), HasSubstr("cut short")));
  }
}

// Inlet and exhaust of one muscle could be open together.
TEST(BadValveTiming, OpenAtDutyZero) {
  const Workspace w;
  const std::string text = read_text(w / "robots/leg/predict.dat");
  write_text(w / "robots/leg/predict.dat", "0,0,50" + text.substr(text.find('\n')));
  for (const Words& words : {Words{"run", walk}, Words{"check", walk}, Words{"check", robot},
                             Words{"check", "robots/leg/predict.dat"}}) {
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err + result.out,
                AllOf(HasSubstr("predict.dat:1:"),
                      HasSubstr("open: found 50 at duty 0, which does not shut at once")));
  }
}

TEST(BadValveTiming, NotMonotone) {
  const Workspace w;
  std::string text = read_text(w / "robots/leg/predict.dat");
  const std::size_t row = text.find("\n60,") + 1, close = text.find(',', row) + 1;
  text = text.substr(0, close) + "1" + text.substr(text.find(',', close));
  write_text(w / "robots/leg/predict.dat", text);
  for (const Words& words : {Words{"run", walk}, Words{"check", "robots/leg/predict.dat"}}) {
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err + result.out,
                AllOf(HasSubstr("predict.dat:61:"), HasSubstr("close: found 1 after")));
  }
}

// --- --set ---

TEST(BadSet, TyposAreSuggestedRight) {
  const Workspace w;
  const Result table = w.sinew({"run", walk, "--set", "troley.drag=1 lbf"});
  EXPECT_EQ(table.code, 2);
  EXPECT_THAT(table.err, AllOf(HasSubstr("--set: troley.drag"), HasSubstr("try \"trolley\"")));

  const Result key = w.sinew({"run", walk, "--set", "trolley.darg=1 lbf"});
  EXPECT_EQ(key.code, 2);
  EXPECT_THAT(key.err, AllOf(HasSubstr("--set: trolley.darg"), HasSubstr("try drag")));

  const Result form = w.sinew({"run", walk, "--set", "trolley.drag"});
  EXPECT_EQ(form.code, 2);
  EXPECT_THAT(form.err, HasSubstr("expected key=value"));
  EXPECT_FALSE(std::filesystem::exists(w / "runs"));
}

// No number is taken for another one: what is too large is refused with the range.
TEST(BadSet, NumbersThatNothingHolds) {
  const Workspace w;
  const auto said = [&](const std::string& set) {
    const Result r = w.sinew({"run", walk, "--set", set});
    EXPECT_EQ(r.code, 2) << set;
    return r.err;
  };
  for (const char* seed : {"9223372036854775808", "-9223372036854775809", "18446744073709551616",
                           "1e300", "2147483648", "-1"})
    EXPECT_THAT(said(std::string("seed=") + seed), HasSubstr("expected 0 to 2147483647")) << seed;
  EXPECT_THAT(said("seed=1.5"), HasSubstr("expected a whole number"));
  for (const char* drag : {"1e400 lbf", "-1e400 lbf", "1e-400 lbf"})
    EXPECT_THAT(said(std::string("trolley.drag=") + drag), HasSubstr("a finite number"));
  EXPECT_THAT(said("joint.hip.angle_gain=0.07"), HasSubstr("try \"0.07 %/count\""));
  EXPECT_FALSE(std::filesystem::exists(w / "runs"));
}

TEST(BadSet, AnUnknownChannelIsSuggestedRight) {
  const Workspace w;
  const Result result = w.sinew({"run", walk, "--set", R"(log.channels=["/jiont/*"])"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("log.channels: found \"/jiont/*\""), HasSubstr("try \"/joint/*\"")));
  EXPECT_FALSE(std::filesystem::exists(w / "runs"));
}

// --- a run that cannot go on ---

TEST(Fault, EndsTheRunWithItsLastRecords) {
  const Workspace w;
  const Result result =
      w.sinew({"run", walk, "-o", "run", "--set", "actuator.bpa.loss.viscous=5000 N s/m"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("the run was ended: the "), HasSubstr("was no number any more at "),
                    HasSubstr("less stiffness or damping, or a smaller "
                              "plant_steps.body"),
                    HasSubstr(" s  /sensor/hip_angle/count  ")));
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(names_in(w / "run"), ::testing::ElementsAre("log.mcap", "resolved.toml"));
}

// --- wrong usage ---

TEST(Usage, WhatCannotBeUnderstoodIsExitCodeTwo) {
  const Workspace w;
  for (const Words& words :
       {Words{}, Words{"wlak"}, Words{"run"}, Words{"run", walk, "--pace", "fast"},
        Words{"run", walk, "--pace", "-1"}, Words{"run", walk, "--force=maybe"},
        Words{"run", walk, "--speed", "2"}, Words{"export", "somewhere"},
        Words{"kinematics", robot}, Words{"valve", "robots/leg/valves.toml", "inlet"}}) {
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, 2) << ::testing::PrintToString(words);
    EXPECT_THAT(result.err, ::testing::Not(IsEmpty()));
    EXPECT_THAT(result.out, IsEmpty());
  }
  EXPECT_THAT(w.sinew({"rnu", walk}).err, HasSubstr("try run"));
}

TEST(Usage, EverySubcommandHasAnExampleAtTheEndOfItsHelp) {
  const Workspace w;
  for (const char* command :
       {"run", "analyze", "export", "replay", "show", "check", "actuator", "valve", "kinematics"}) {
    const Result result = w.sinew({command, "--help"});
    EXPECT_EQ(result.code, 0);
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out, HasSubstr(std::string("\nExample:\n  sinew ") + command + " "));
  }
  EXPECT_THAT(w.sinew({"--version"}).out, StartsWith("sinew 0."));
}

// --- what is nearly right ---

TEST(Usage, AFolderIsNoExperiment) {
  const Workspace w;
  const Result r = w.sinew({"run", "robots"});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.err, StartsWith("robots: found a folder; expected a TOML file"));
}

TEST(Usage, AStepOfPressureIsADifference) {
  const Workspace w;
  const Result r = w.sinew({"actuator", "robots/leg/actuator.toml", "--length", "3 in",
                            "--pressure", "20 psi gauge:100 psi gauge:25 psi gauge"});
  EXPECT_EQ(r.code, 2);
  EXPECT_EQ(r.err,
            "--pressure: found \"25 psi gauge\"; expected a step, which is a difference of two "
            "pressures; try \"25 psi\"\n");
}

TEST(Usage, APaceMustBeOneThatAClockCanKeep) {
  const Workspace w;
  for (const char* pace : {"1e-300", "-1", "inf", "x"}) {
    const Result r = w.sinew({"run", walk, "--pace", pace});
    EXPECT_EQ(r.code, 2) << pace;
    EXPECT_THAT(r.err + r.out, HasSubstr("expected 0, or a number from 0.001 on"));
  }
}

TEST(BadBringUp, IsRefusedBeforeAnythingIsOpenedOrWritten) {
  const Workspace w;
  for (const char* place : {"comedi:/dev/comedi0", "simulated"}) {
    const Result r = w.sinew({"bring-up", robot, "--port", place});
    EXPECT_EQ(r.code, 2);
    EXPECT_THAT(r.err + r.out, HasSubstr(std::string("found \"") + place + "\"; expected a board"));
  }
  const Result yes = w.sinew({"bring-up", robot, "--port", "serial:/dev/null", "--yes"});
  EXPECT_EQ(yes.code, 2);
  EXPECT_THAT(yes.err, HasSubstr("expected a person who answers"));
  EXPECT_FALSE(std::filesystem::exists(w / "bring-up"));
}

TEST(BadFlash, NamesAFileThatIsNotThere) {
  const Workspace w;
  const Result r = w.sinew({"firmware", "flash", "stm32f405", "nothing.elf"});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.err, HasSubstr("nothing.elf: found no such file"));
}

// Beside robots/, and in a folder whose name only ends so, numbers need no source.
TEST(Check, AsksForSourcesInRobotsAlone) {
  const Workspace w;
  for (const char* folder : {"myrobots/lever", "robots/lever"}) {
    std::filesystem::create_directories(w / folder);
    for (const auto& entry : std::filesystem::directory_iterator(w / "robots/leg"))
      std::filesystem::copy(entry.path(), w / folder / entry.path().filename());
    write_text(w / folder / "more.toml",
               "format = \"sinew.robot/1\"\nbase = \"robot.toml\"\n[trolley]\ndrag = \"1 lbf\"\n");
  }
  EXPECT_EQ(w.sinew({"check", "myrobots/lever/more.toml"}).code, 0);
  EXPECT_EQ(w.sinew({"check", "robots/lever/more.toml"}).code, 1);
}

}  // namespace
}  // namespace sinew::test::bad_input_test
