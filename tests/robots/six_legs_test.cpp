// The largest machine: 24 joints, 48 muscles, 96 valves on three boards, from files alone.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include "runs.h"
#include "sinew/config/diagnostics.h"
#include "sinew/robot/boards.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/simulation.h"
#include "sinew/run/simulation/test_same.h"
#include "tests/places.h"
#include "tests/six_legs.h"

namespace sinew::six_legs_test {
namespace {

namespace fs = std::filesystem;

class SixLegs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fs::temp_directory_path() / ("sinew-six-legs-" + std::to_string(getpid()));
    path = test::write_six_legs(folder, sinew::test::source_dir());
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }

  static experiment::Experiment load(const std::vector<std::string>& sets = {}) {
    return run::buildable(path, sets);
  }
  // The first error of the machine with these sets.
  static std::string refusal(const std::vector<std::string>& sets) {
    try {
      (void)load(sets);
    } catch (const config::Error& e) {
      return e.what();
    }
    return "nothing";
  }

  static inline fs::path folder;
  static inline std::string path;
};

TEST_F(SixLegs, AreOnThreeBoardsWithTheSameNumbers) {
  const experiment::Experiment e = load();
  EXPECT_EQ(e.robot.joints.size(), 24u);
  EXPECT_EQ(e.robot.muscles.size(), 48u);
  const std::vector<control::Board> boards = run::boards_of(e);
  ASSERT_EQ(boards.size(), 3u);
  std::set<int> valves, channels;
  for (const control::Board& b : boards) {
    EXPECT_EQ(b.joint_controller.joints, 8u);
    EXPECT_EQ(b.joint_controller.conversions, 24u);
    ASSERT_EQ(b.valve.size(), 32u);
    valves.insert(b.valve.begin(), b.valve.end());
    channels.insert(b.channel.begin(), b.channel.end());
    for (std::size_t j = 0; j < 8; ++j) {
      EXPECT_EQ(b.joint_controller.joint[j].angle.index,
                boards[0].joint_controller.joint[j].angle.index);
      EXPECT_EQ(b.joint_controller.joint[j].flexor.inlet.index,
                boards[0].joint_controller.joint[j].flexor.inlet.index);
      EXPECT_EQ(b.joint_controller.joint[j].law_tick, boards[0].joint_controller.joint[j].law_tick);
    }
  }
  EXPECT_EQ(valves.size(), 96u);
  EXPECT_EQ(*valves.rbegin(), 95);
  EXPECT_EQ(channels.size(), 72u);
}

// All joints follow their commands, all valves switch, all feet are loaded, and all air that
// entered is present or has left.
TEST_F(SixLegs, MoveInAClosedLoop) {
  const experiment::Experiment e = load();
  const run::Outcome out = run::run(e);
  ASSERT_EQ(out.status, signals::Status::ok) << run::cause_of(e, out);
  EXPECT_GT(out.duration, 3);
  const auto column = [&](const std::string& topic) -> const signals::Column& {
    const signals::Column* found = out.table.column(topic);
    EXPECT_NE(found, nullptr) << topic;
    static const signals::Column none{0.0};
    return found ? *found : none;
  };
  const auto range = [](const signals::Column& v) {
    const auto [low, high] = std::ranges::minmax_element(v);
    return *high - *low;
  };
  for (const std::string leg : test::six_legs_names) {
    const std::string of = "/leg/" + leg;
    EXPECT_GT(range(column(of + "/joint/hip/angle")), 0.2) << leg;
    EXPECT_GT(range(column(of + "/joint/knee/angle")), 0.2) << leg;
    const auto& load = *out.table.column("/true" + of + "/foot/force", "y");
    EXPECT_GT(*std::ranges::max_element(load), 5) << leg;
    for (const test::SixLegsJoint& joint : test::six_legs_joints)
      for (const char* role : {"flexor", "extensor"}) {
        const std::string muscle = of + "/muscle/" + joint.name + "_" + role;
        const auto gained = [&](const char* what) {
          const auto& kg = column("/true" + muscle + what);
          return kg.back() - kg.front();
        };
        EXPECT_NEAR(gained("/mass"), gained("/air_in") - gained("/air_out"), 1e-12) << muscle;
        for (const char* valve : {"inlet", "exhaust"}) {
          const signals::Series* edges =
              out.table.find(of + "/valve/" + joint.name + "_" + role + "/" + valve + "/open");
          ASSERT_NE(edges, nullptr);
          EXPECT_GT(edges->time_ns.size(), 2u) << muscle << " " << valve;
        }
      }
  }

  // Every reader of a log can read all of it.
  const config::Node root = config::compose(path);
  const analysis::Summary summary = analysis::summarize(out.table, analysis::read_machine(root));
  double used = 0;
  for (const std::string leg : test::six_legs_names)
    used += test::figure(summary, ("legs." + leg + ".air_used_kg").c_str());
  EXPECT_NEAR(used, test::figure(summary, "air_used_kg"), 1e-12);
}

TEST_F(SixLegs, VisitedAtEveryTickAndLookedAtHasTheSameBits) {
  const experiment::Experiment e = load({"sequence.repeat=1"});
  const run::Outcome once = run::run(e),
                     visited = run::run(e, {.every_tick = true, .extra_readers = 1});
  run::expect_same(once.table, visited.table);
}

// Restored at random instants, also into another simulation.
TEST_F(SixLegs, GoOnFromASave) {
  const experiment::Experiment e = load({"sequence.repeat=1"});
  run::Simulation straight(e);
  auto held = std::make_unique<run::Simulation>(e);
  straight.advance_to(straight.last());
  std::mt19937 random(5);
  for (int i = 0; i < 10; ++i) {
    held->advance_to(held->tick() + 1 + static_cast<signals::Tick>(random() % 2000));
    const std::vector<std::byte> saved = held->save();
    held->advance_by(0.02);
    if (i % 2 == 1) held = std::make_unique<run::Simulation>(e);
    held->restore(saved);
  }
  held->advance_to(held->last());
  for (std::size_t c = 0; c < straight.channels().size(); ++c) {
    const double a = straight.read(c), b = held->read(c);
    ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << straight.channels()[c].name;
  }
}

// A sensor of the third board that breaks ends all six legs, and is named with its board.
TEST_F(SixLegs, AFaultNamesItsBoard) {
  experiment::Experiment e = load({"sequence.repeat=1"});
  e.faults = {{.at = 1, .of = "e_knee_angle", .what = experiment::Fault::What::open}};
  const run::Outcome out = run::run(e);
  EXPECT_EQ(out.supervised.board, 3);
  EXPECT_TRUE(run::cause_of(e, out).starts_with("sensor e_knee_angle on board 3 at 1.0"))
      << run::cause_of(e, out);
  EXPECT_EQ(out.controller.phase, control::Phase::off);
}

TEST_F(SixLegs, SayWhatIsTooMuch) {
  const std::string joint = refusal(
      {"link.tail={ parent = \"body\", length = \"1 in\", mass = \"1 lb\", center_of_mass = \"0.5 "
       "in\", inertia = \"1 lb in2\" }",
       "joint.tail={ kind = \"passive\", rest_angle = \"270 deg\", dry_friction = \"0 N m\", "
       "damping = \"0 N m s/rad\" }",
       "start.joint_angles.tail=270 deg"});
  EXPECT_NE(joint.find("joint: found 25 joints; expected 1 to 24"), std::string::npos) << joint;

  const std::string muscle = refusal(
      {"muscle.f_over={ joint = \"f_ankle\", role = \"flexor\", actuator = \"bpa\", mount_length = "
       "\"3.15 in\", count = 1, external_volume = \"0.1 in3\", inlet = { valve = \"inlet\", bit = "
       "30 }, "
       "exhaust = { valve = \"exhaust\", bit = 31 } }"});
  EXPECT_NE(muscle.find("muscle: found 49 muscles; expected at most 48"), std::string::npos)
      << muscle;

  std::vector<std::string> crowded{"joint.c_hip.board=1"};
  for (const std::string leg : {"a", "b"})
    for (const test::SixLegsJoint& j : test::six_legs_joints)
      crowded.push_back("joint." + leg + "_" + j.name + ".board=1");
  const std::string board = refusal(crowded);
  EXPECT_NE(board.find("found 9 joints on board 1; expected at most 8 joints on a board"),
            std::string::npos)
      << board;
  EXPECT_NE(refusal({"joint.c_hip.board=9"}).find("joint.c_hip.board: found 9; expected 0 to 6"),
            std::string::npos)
      << refusal({"joint.c_hip.board=9"});
}

}  // namespace
}  // namespace sinew::six_legs_test
