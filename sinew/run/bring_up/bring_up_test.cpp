// The bring-up of a machine at a simulated bench, with and without faults.
#include "sinew/run/bring_up/bring_up.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "sinew/config/diagnostics.h"
#include "sinew/control/setup/boards.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/run/bring_up/muscles.h"
#include "sinew/run/bring_up/trial.h"
#include "sinew/run/simulation/remote_boards.h"
#include "sinew/run/simulation/test_board.h"
#include "sinew/run/simulation/wired_body.h"
#include "tests/places.h"

namespace sinew::run::bring_up_test {
namespace {

namespace fs = std::filesystem;
using signals::Reading;

const std::string leg = sinew::test::source_dir() + "/robots/leg/robot.toml";

struct Folder {
  Folder() {
    std::string pattern = fs::temp_directory_path() / "sinew-bring-up-XXXXXX";
    path = ::mkdtemp(pattern.data());
  }
  ~Folder() { fs::remove_all(path); }
  fs::path path;
};

// The connection of board and machine, by the channel and valve numbers of the leg's board.
struct Cables {
  std::vector<std::uint8_t> channel, valve;  // the machine's end of each wire
  std::vector<bool> reversed;                // whether a potentiometer's outer wires are swapped

  explicit Cables(const control::Board& board) {
    for (std::uint8_t i = 0; i < 32; ++i) valve.push_back(i);
    for (std::uint8_t i = 0; i < board.channel.size(); ++i) channel.push_back(i);
    reversed.assign(channel.size(), false);
  }
  plant::Wires between(plant::Wires body) const {
    return {[=, *this](signals::Tick tick, std::uint32_t open, bool current) {
              std::uint32_t there = 0;
              for (std::size_t i = 0; i < valve.size(); ++i)
                if (open >> i & 1u) there |= 1u << valve[i];
              body.valves(tick, there, current);
            },
            [=, *this](signals::Channel c, signals::Tick tick) {
              Reading r = body.read({channel[c.index]}, tick);
              if (reversed[c.index]) r.counts = static_cast<std::uint16_t>(3'790 - r.counts);
              return r;
            }};
  }
};

struct Day {
  explicit Day(std::vector<std::string> sets = {}, const std::string& robot_file = leg)
      : robot(robot_file),
        bench(bench_of(robot, folder.path, sets)),
        body(bench),
        cables(only_board(bench)) {}

  bool go() {
    const auto inform = [this](const std::string& line) { printed += line + "\n"; };
    const auto confirm = [this](const std::string& question) -> std::optional<bool> {
      printed += question + "\n";
      return answers ? answers(question) : true;
    };
    BoardInThread board(cables.between(body.wires()));
    plant::RemoteBoard remote(board.line(), 1, 100);
    const bool done =
        BringUp(bench, robot, remote, 0,
                {.inform = inform, .confirm = confirm, .moves = moves, .stops = stops}, folder.path)
            .go();
    left = remote.state();
    return done;
  }
  bool has_printed(const std::string& words) const { return printed.find(words) != printed.npos; }
  // Returns the board's number of a sensor's channel.
  std::size_t channel(const std::string& sensor) const {
    const int number = robot::find_sensor(bench.robot, sensor);
    const control::Board board = only_board(bench);
    for (std::size_t i = 0; i < board.channel.size(); ++i)
      if (board.channel[i] == number) return i;
    throw std::out_of_range(sensor);
  }

  Folder folder;
  std::string robot;
  experiment::Experiment bench;
  WiredBody body;
  Cables cables;
  std::function<std::optional<bool>(const std::string&)> answers;
  std::function<bool()> stops;
  std::function<void(bool)> moves;
  control::BoardState left = control::BoardState::fault;  // state of the board at the end
  std::string printed;
};

TEST(BringUp, AWholeBenchPassesEveryStepAndItsRobotsFileIsLearned) {
  Day day;
  EXPECT_TRUE(day.go()) << day.printed;
  EXPECT_TRUE(day.has_printed("11/11")) << day.printed;
  const experiment::MachineFile learned =
      experiment::load_machine_file(day.folder.path / "robot.toml");
  const robot::Robot& robot = learned.experiment.robot;
  const auto at = [&](const char* name) {
    return robot.sensors[static_cast<std::size_t>(robot::find_sensor(robot, name))];
  };
  EXPECT_NEAR(at("hip_angle").assumed_at_rest, 1'895, 1);
  EXPECT_NEAR(at("hip_flexor_tension").assumed_at_rest, 53, 5);
  EXPECT_EQ(at("hip_flexor_tension").assumed_at_rest, at("hip_flexor_tension").at_rest);
  const Progress kept =
      read_progress(day.folder.path / "bring-up.json", fs::weakly_canonical(leg).string());
  ASSERT_EQ(kept.strokes.size(), 2u);
  for (const auto& [joint, stroke] : kept.strokes)
    EXPECT_GT(stroke.highest - stroke.lowest, 300) << joint;
  std::ifstream svg(day.folder.path / "wiring.svg");
  const std::string drawing{std::istreambuf_iterator<char>(svg), {}};
  EXPECT_NE(drawing.find("hip_flexor inlet"), std::string::npos);
  EXPECT_NE(drawing.find("bit 0, pins 31 and 32"), std::string::npos);
}

TEST(BringUp, OtherRobotsPassAsWell) {
  for (const char* name :
       {"one-joint", "leg-with-pressures", "three-muscle-leg", "cricket", "leg-3-way"}) {
    Day day({}, (sinew::test::source_dir() + "/robots/") + name + "/robot.toml");
    EXPECT_TRUE(day.go()) << name << "\n" << day.printed;
  }
}

TEST(BringUp, AStopWhileValvesMoveVentsAndIsGoneOnFrom) {
  Day day;
  int periods = 0;
  day.stops = [&] { return ++periods == 250; };
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("Stopped: the muscles were vented.")) << day.printed;
  EXPECT_EQ(day.left, control::BoardState::idle);
  EXPECT_EQ(periods, 250) << "nothing moves after it";
  day.stops = {};
  EXPECT_TRUE(day.go()) << day.printed;
}

TEST(BringUp, GoesOnWhereItStopped) {
  Day day;
  day.answers = [](const std::string& question) -> std::optional<bool> {
    if (question.find("supply's air, and stay clear") != question.npos) return {};
    return true;
  };
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("Stopped. The same command continues from here."));
  EXPECT_FALSE(fs::exists(day.folder.path / "robot.toml"));
  day.printed.clear();
  day.answers = {};
  EXPECT_TRUE(day.go()) << day.printed;
  EXPECT_TRUE(day.has_printed("what the sensors read at rest: done before")) << day.printed;
  EXPECT_FALSE(day.has_printed("hang still")) << "what is done is not asked again";
}

TEST(BringUp, RequestsTheAirInEachSessionThatMovesValvesWithIt) {
  Day day;
  day.answers = [](const std::string& question) -> std::optional<bool> {
    return question.find("emergency stop") == question.npos;
  };
  EXPECT_FALSE(day.go());
  const std::string air = "Is it open, and is everybody clear?";
  EXPECT_EQ(day.printed.find(air), day.printed.rfind(air)) << "once";
  day.printed.clear();
  day.answers = [&](const std::string& question) -> std::optional<bool> {
    if (question.find(air) != question.npos) return false;
    return true;
  };
  int moved = 0;
  day.moves = [&](bool now) { moved += now; };
  EXPECT_FALSE(day.go()) << "all steps with air but the last one are done before";
  EXPECT_TRUE(day.has_printed("fill, hold and empty knee_extensor: done before")) << day.printed;
  EXPECT_EQ(moved, 0) << "no valve has moved";
}

TEST(BringUp, BeginsAgainWithARobotOfOtherValuesAndAtAnotherBoard) {
  Day day;
  EXPECT_TRUE(day.go()) << day.printed;
  day.printed.clear();
  day.bench = bench_of(day.robot, day.folder.path, {"joint.hip.angle_gain=0.3 %/count"});
  day.answers = [](const std::string&) -> std::optional<bool> { return {}; };
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("done again: the robot's values are others")) << day.printed;
  EXPECT_FALSE(day.has_printed("done before"));

  EXPECT_EQ(
      read_progress(day.folder.path / "bring-up-before.json", fs::weakly_canonical(leg).string())
          .done.size(),
      11u);
  const fs::path kept = day.folder.path / "bring-up.json";
  std::ifstream in(kept);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = text.find("\"board\": \"") + 10;
  text.insert(at, "another ");
  std::ofstream(kept) << text;
  day.printed.clear();
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("done again: this is another board or program than \"another "))
      << day.printed;
  EXPECT_FALSE(day.has_printed("done before"));
}

TEST(BringUp, ACylindersValvesClickAndWhatIsNotTriedWithAirIsReported) {
  Day day({"cylinder.mode=valves"});
  EXPECT_TRUE(day.go()) << day.printed;
  for (const char* valve :
       {"the inlet of cylinder_up (output 8", "the exhaust of cylinder_up (output 9",
        "the inlet of cylinder_down (output 10", "the exhaust of cylinder_down (output 11"})
    EXPECT_TRUE(day.has_printed(valve)) << valve << day.printed;
  EXPECT_TRUE(day.has_printed("not tried: the cylinder with air.")) << day.printed;
}

TEST(BringUp, AThreeWayValveIsOneWireAndItsMuscleIsNotHeld) {
  Day day({}, sinew::test::source_dir() + "/robots/leg-3-way/robot.toml");
  EXPECT_TRUE(day.go()) << day.printed;
  EXPECT_TRUE(day.has_printed("the inlet of hip_flexor (output 0"));
  EXPECT_FALSE(day.has_printed("the exhaust of")) << day.printed;
  EXPECT_FALSE(day.has_printed("% lost")) << day.printed;
}

TEST(BringUp, ABoardThatForgetsItsConfigurationIsNoBoardToReadFrom) {
  const experiment::Experiment e =
      experiment::load(sinew::test::source_dir() + "/experiments/kick.toml", {});
  WiredBody body(e);
  BoardInThread board(body.wires());
  plant::RemoteBoard remote(board.line(), 1, 100);
  EXPECT_THROW(listen(remote, configuration_of(e), 0.1), plant::BoardError);
}

// --- faulty benches ------------------------------------------------------------------------------

TEST(BrokenBench, CablesOfTwoAnglesHaveChangedPlaces) {
  Day day;
  std::swap(day.cables.channel[day.channel("hip_angle")],
            day.cables.channel[day.channel("knee_angle")]);
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("its cable another's?")) << day.printed;
}

TEST(BrokenBench, CablesOfTwoTensionsHaveChangedPlaces) {
  Day day;
  std::swap(day.cables.channel[day.channel("hip_flexor_tension")],
            day.cables.channel[day.channel("knee_flexor_tension")]);
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(
      day.has_printed("the cables of hip_flexor_tension and knee_flexor_tension have changed"))
      << day.printed;
}

TEST(BrokenBench, APotentiometerIsReversed) {
  Day day;
  day.cables.reversed[day.channel("hip_angle")] = true;  // mirrored about its rest
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("hip_angle goes the wrong way: change the two outer wires"))
      << day.printed;
}

TEST(BrokenBench, AnInletIsWiredToAnotherMuscle) {
  Day day;
  std::swap(day.cables.valve[0], day.cables.valve[4]);  // the inlets of hip and knee flexor
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("knee_flexor pulled in its place: the inlet")) << day.printed;
}

TEST(BrokenBench, InletAndExhaustHaveChangedPlaces) {
  Day day;
  std::swap(day.cables.valve[0], day.cables.valve[1]);
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("wrong:")) << day.printed;
}

TEST(BrokenBench, TheSupplyIsOff) {
  Day day({"air.supply.pressure=0 psi gauge"});
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("nothing happened: is the supply's air on")) << day.printed;
}

TEST(BrokenBench, AMuscleLeaks) {
  Day day({"muscle.hip_flexor.leak.conductance=2e-10 kg/(s Pa)"});
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("% in a second with its valves shut")) << day.printed;
}

TEST(BrokenBench, AValveDoesNotClick) {
  Day day;
  day.answers = [](const std::string& question) -> std::optional<bool> {
    return question.find("exhaust of knee_flexor") == question.npos;
  };
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed(
      "the exhaust of knee_flexor (output 5: bit 10, pins 47 and 48) did not click"))
      << day.printed;
}

TEST(BrokenBench, AJointsEndIsBeyondItsSensor) {
  Day day;
  const control::Board board = only_board(day.bench);
  std::vector<BenchMuscle> muscles = bench_muscles(day.bench, board, nullptr);
  for (const BenchJoint& joint : bench_joints(board, muscles)) {
    ASSERT_EQ(joint.muscles.size(), 2u);
    const double middle = 0.5 * (joint.lowest + joint.top);
    const double flexed = middle + 200 * muscles[joint.muscles[0]].direction;
    EXPECT_TRUE(wrong_with_ends(joint, muscles, {flexed, middle}).empty());
    const auto beyond = wrong_with_ends(joint, muscles, {flexed, flexed > middle ? 3.0 : 4'094.0});
    ASSERT_EQ(beyond.size(), 1u);
    EXPECT_NE(beyond[0].find("turn the sensor on its shaft"), std::string::npos) << beyond[0];
    const auto stuck = wrong_with_ends(joint, muscles, {middle, middle});
    ASSERT_EQ(stuck.size(), 1u);
    EXPECT_NE(stuck[0].find("from end to end; expected 60 at least"), std::string::npos);
  }
}

TEST(BrokenBench, TheEmergencyStopLetsNoAirOut) {
  Day day;
  day.answers = [](const std::string& question) -> std::optional<bool> {
    return question.find("emergency stop") == question.npos;
  };
  EXPECT_FALSE(day.go());
  EXPECT_TRUE(day.has_printed("do not work at this machine until it does")) << day.printed;
}

TEST(BrokenBench, TheFolderHasAnotherRobotsSteps) {
  Day day;
  EXPECT_TRUE(day.go());
  day.robot = sinew::test::source_dir() + "/robots/one-joint/robot.toml";
  try {
    day.go();
    FAIL() << day.printed;
  } catch (const config::Error& e) {
    EXPECT_NE(std::string(e.what()).find("this one has the steps of another robot"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace sinew::run::bring_up_test
