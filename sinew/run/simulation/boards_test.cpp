// A machine on several boards behaves like one on a single board.
#include "sinew/run/controllers/boards.h"
#include "sinew/run/setup/installation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sinew/control/setup/joint_controllers.h"
#include "sinew/control/setup/supervision.h"
#include "sinew/run/simulation/run.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/run/simulation/test_same.h"
#include "tests/places.h"

namespace sinew::run::boards_test {
namespace {

using control::Trip;
using signals::Tick;
using Sets = std::vector<std::string>;

// The terminals of [wiring] are those of one board.
const Sets once{"sequence.repeat=1"},
    split{"sequence.repeat=1", "joint.knee.board=2", "wiring.present=false"};

experiment::Experiment load(const std::string& name, Sets sets = once, const Sets& more = {}) {
  sets.insert(sets.end(), more.begin(), more.end());
  return experiment::load(sinew::test::source_dir() + "/experiments/" + name + ".toml", sets);
}

// Readings, laws and edges of a joint depend only on its own ticks: on a board of its own, the knee
// behaves the same, bit for bit.
TEST(Boards, TheLegOnTwoIsTheLegOnOne) {
  for (const char* name : {"walk-test-1", "derivative-control", "walk-with-pressures"}) {
    const Outcome one = run(load(name)), two = run(load(name, split));
    expect_same(one.table, two.table);
    EXPECT_EQ(one.controller.phase, two.controller.phase);
    EXPECT_EQ(one.supervised.rejected, two.supervised.rejected);
  }
}

// The cylinder's loop on a board of its own, too.
TEST(Boards, TheCylinderOnItsOwnIsTheSame) {
  const Outcome one = run(load("cylinder-following", {}));
  const Outcome two = run(load("cylinder-following", {"cylinder.board=2", "wiring.present=false"}));
  expect_same(one.table, two.table);
}

// Two legs, each on a board: each uses bits of its own port, and both scans begin at tick 1. The
// right leg's readings are taken at other ticks than on one board, so only the law is the same.
TEST(Boards, TwoLegsWithTheSameTicksAndBits) {
  Sets sets = once;
  for (const std::string part : {"hip", "knee"}) {
    sets.push_back("joint.right_" + part + ".board=2");
    for (const std::string side : {"flexor", "extensor"}) {
      const std::string of = "_" + part + "_" + side;
      const experiment::Experiment e = load("walk-two-legs");
      const auto left = static_cast<std::size_t>(robot::find_muscle(e.robot, "left" + of));
      const robot::Muscle& m = e.robot.muscles[left];
      sets.push_back("muscle.right" + of + ".inlet.bit=" + std::to_string(m.inlet_bit));
      sets.push_back("muscle.right" + of + ".exhaust.bit=" + std::to_string(m.exhaust_bit));
    }
  }
  const experiment::Experiment loaded = load("walk-two-legs", sets);
  experiment::Experiment e = loaded;
  const std::size_t half = e.robot.sensors.size() / 2;
  for (std::size_t s = half; s < 2 * half; ++s) {
    ASSERT_EQ(e.robot.sensors[s].kind, e.robot.sensors[s - half].kind);
    e.robot.sensors[s].tick = e.robot.sensors[s - half].tick;
    e.robot.sensors[s].channel = e.robot.sensors[s - half].channel;
  }
  ASSERT_TRUE(robot::contradictions(e.robot).empty());

  const std::vector<control::Board> boards = boards_of(e);
  ASSERT_EQ(boards.size(), 2u);
  EXPECT_EQ(boards[1].joint, (std::vector<std::uint8_t>{2, 3}));
  EXPECT_EQ(boards[1].valve, (std::vector<std::uint8_t>{8, 9, 10, 11, 12, 13, 14, 15}));
  const control::JointControllerConfig &left = boards[0].joint_controller,
                                       &right = boards[1].joint_controller;
  ASSERT_EQ(left.conversions, right.conversions);
  for (std::size_t c = 0; c < left.conversions; ++c)
    EXPECT_EQ(left.conversion[c].read, right.conversion[c].read);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_EQ(left.joint[j].law_tick, right.joint[j].law_tick);
    EXPECT_EQ(left.joint[j].flexor.inlet.index, right.joint[j].flexor.inlet.index);
    EXPECT_EQ(left.joint[j].angle.index, right.joint[j].angle.index);
  }

  // Visiting and reading every tick gives the same bits. It walks like the legs on one board.
  const Outcome out = run(e), visited = run(e, {.every_tick = true, .extra_readers = 2});
  ASSERT_EQ(out.status, signals::Status::ok);
  expect_same(out.table, visited.table);
  const Outcome one = run(load("walk-two-legs"));
  const auto end = [](const Outcome& o) {
    return o.table.find("/true/trolley/position")->columns[0].back();
  };
  EXPECT_NEAR(end(out) / end(one), 1, 0.1);
}

// The scan of all boards: each conversion once, ascending, with the machine's channels.
TEST(Boards, OneScanOfAll) {
  const experiment::Experiment e = load("walk-test-1", split);
  const Boards boards(boards_of(e));
  const signals::Scan scan = boards.scan();
  ASSERT_EQ(scan.conversions.size(), e.robot.sensors.size());
  std::vector<int> seen;
  for (std::size_t i = 0; i < scan.conversions.size(); ++i) {
    const signals::Conversion& c = scan.conversions[i];
    EXPECT_EQ(c.read, e.robot.sensors[c.channel.index].tick);
    EXPECT_TRUE(i == 0 || c.read >= scan.conversions[i - 1].read);
    seen.push_back(c.channel.index);
  }
  std::ranges::sort(seen);
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<int>(i));
}

// A fault that ends one board's run ends the other's in the same tick: all muscles are vented, and
// the report names sensor and board.
TEST(Boards, OneThatTripsEndsAll) {
  for (const auto& [sensor, board] : {std::pair{"hip_angle", 1}, std::pair{"knee_angle", 2}}) {
    experiment::Experiment e = load("walk-test-1", split);
    e.faults = {{.at = 1, .of = sensor, .what = experiment::Fault::What::open}};
    const Outcome out = run(e);
    EXPECT_EQ(out.supervised.trip.cause, Trip::Cause::range);
    EXPECT_EQ(out.supervised.board, board);
    EXPECT_EQ(out.controller.fault, signals::Status::fault);
    EXPECT_EQ(out.controller.phase, control::Phase::off);
    const int s = robot::find_sensor(e.robot, sensor);
    EXPECT_EQ(out.supervised.trip.channel.index, s);
    EXPECT_EQ(out.controller.fault_channel.index, s);
    const std::string text = cause_of(e, out), on = " on board " + std::to_string(board) + " at ";
    EXPECT_TRUE(text.starts_with("sensor " + std::string(sensor) + on)) << text;

    // Every inlet shuts within two ticks of the trip, and every exhaust is open then.
    const std::int64_t end = (out.supervised.trip.at + 2) * signals::tick_nanoseconds;
    for (const signals::Series& series : out.table.series) {
      if (!signals::is_of_valve(series.topic.name)) continue;
      const auto after = std::ranges::upper_bound(series.time_ns, end) - series.time_ns.begin();
      if (after == 0) continue;  // never moved
      const bool open = series.columns[0][static_cast<std::size_t>(after) - 1] > 0;
      EXPECT_EQ(open, series.topic.name.find("/exhaust/") != std::string::npos)
          << series.topic.name;
    }
  }
}

// A command that is invalid for one board's joint holds and then vents that board, and all others.
TEST(Boards, BadCommandsNameTheirJoint) {
  const experiment::Experiment e = load("walk-test-1", split);
  Boards boards(boards_of(e));
  MachineCommand command{};
  command[1].angle = 1'000'000;
  Tick t = 0;
  for (; boards.state().phase != control::Phase::off && t < 200'000; t = boards.next_event(t)) {
    if (t % boards.scan().period == 0) boards.command(command);
    for (Board& b : boards.each()) (void)b.edges(t);
    for (Board& b : boards.each())
      if (const signals::Conversion* c = b.due(t)) b.take(*c, {2000, signals::Status::ok}, t);
  }
  const SupervisedTotals totals = boards.supervised_totals();
  EXPECT_EQ(totals.trip.cause, Trip::Cause::command);
  EXPECT_EQ(totals.trip.joint, 1);
  EXPECT_EQ(totals.board, 2);
  const std::string text = control::to_text(totals.trip, e.robot, totals.board);
  EXPECT_TRUE(text.starts_with("the commands for joint knee on board 2 at ")) << text;
}

std::string refusal_of(const Sets& sets) {
  try {
    (void)load("walk-test-1", sets);
  } catch (const config::Error& e) {
    return e.what();
  }
  return "nothing";
}

TEST(Boards, SayWhatDoesNotFit) {
  EXPECT_NE(refusal_of({"joint.knee.board=3"}).find("a board 3 and no board 2"), std::string::npos);
  EXPECT_NE(refusal_of({"joint.knee.board=7"}).find("joint.knee.board"), std::string::npos);
  EXPECT_NE(refusal_of({"joint.knee.board=2"}).find("one board, whose terminals it lists"),
            std::string::npos);
}

}  // namespace
}  // namespace sinew::run::boards_test
