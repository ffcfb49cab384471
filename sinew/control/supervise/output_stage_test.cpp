#include "sinew/control/supervise/output_stage.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "sinew/control/joint/test_leg.h"

namespace sinew::control::output_stage_test {
namespace {

using signals::Edge;
using signals::Tick;

constexpr OpenMask one(int valve) { return OpenMask{1} << valve; }

Edge edge(int valve, bool open) { return {0, {static_cast<std::uint8_t>(valve)}, open}; }

TEST(OutputStage, AfterAResetAllIsShutAndNoCoilHasCurrent) {
  OutputStage fresh;
  EXPECT_EQ(fresh.at(0), 0u);
  OutputStage leg(test_leg(), 0);
  EXPECT_EQ(leg.at(0), 0u);
  for (std::size_t v = 0; v < max_valves; ++v) EXPECT_EQ(leg.level(v), 0);
  EXPECT_EQ(rest_word(false), 0u);
  EXPECT_EQ(rest_word(true), ~0u);
}

// Expected level of each valve: current if open differs from inverted; an active-low driver has 0
// for current.
TEST(OutputStage, PolarityIsTheDriversAlone) {
  std::mt19937 random(1);
  for (int i = 0; i < 1'000; ++i) {
    const OpenMask open = random(), inverted = random();
    for (int v = 0; v < 32; ++v) {
      const bool current = ((open & one(v)) != 0) != ((inverted & one(v)) != 0);
      ASSERT_EQ((drive_word(open, inverted, false) & one(v)) != 0, current);
      ASSERT_EQ((drive_word(open, inverted, true) & one(v)) == 0, current);
    }
  }
}

TEST(OutputStage, AnEdgeOfAnInvertedExhaustOpensItByTakingItsCurrent) {
  JointControllerConfig leg = test_leg();
  leg.joint[hip].flexor.exhaust_inverted = true;
  OutputStage out(leg, 0);
  EXPECT_EQ(out.inverted(), one(1));
  out.drive(edge(1, false));
  EXPECT_EQ(out.at(1), one(1));
  EXPECT_EQ(drive_word(out.at(1), out.inverted(), false), 0u);
  out.drive(edge(1, true));
  EXPECT_EQ(out.at(2), 0u);
  EXPECT_EQ(drive_word(out.at(2), out.inverted(), false), one(1));
}

// For all requests: no muscle is open to both sides, only requested valves are open, and those that
// stay shut are counted.
TEST(OutputStage, NeverBothSidesOfAMuscle) {
  std::mt19937 random(2);
  OutputStage out(test_leg(), 0);
  OpenMask asked = 0;
  bool cylinder_both = false;
  for (Tick t = 0; t < 200'000; ++t) {
    for (unsigned n = random() % 3; n > 0; --n) {
      const int valve = static_cast<int>(random() % 12);
      const bool open = random() % 2;
      asked = open ? asked | one(valve) : asked & ~one(valve);
      out.drive(edge(valve, open));
    }
    const OpenMask open = out.at(t);
    ASSERT_EQ(open & ~asked, 0u);
    OpenMask allowed = asked;
    for (int inlet = 0; inlet < 8; inlet += 2)  // hip and knee
      if (asked & one(inlet + 1)) allowed &= ~one(inlet);
    ASSERT_EQ(open, allowed);
    cylinder_both = cylinder_both || (open & (one(8) | one(9))) == (one(8) | one(9));
  }
  EXPECT_GT(out.interlocks(), 1'000u);
  EXPECT_TRUE(cylinder_both) << "its feed-forward may (appendix B)";
}

TEST(OutputStage, NorOfAnActuatorThatAHostTimes) {
  JointControllerConfig config;
  config.joints = 1;
  config.joint[0].kind = JointKind::timed;
  config.joint[0].flexor.inlet = {0};
  config.joint[0].flexor.exhaust = {1};
  config.joint[0].extensor.present = false;
  OutputStage out(config, 0);
  for (const int valve : {0, 1}) out.drive(edge(valve, true));
  EXPECT_EQ(out.at(0), one(1));
}

TEST(OutputStage, AValveThatHasShutStaysShutForItsRefractoryTime) {
  for (const std::uint32_t refractory : {1u, 5u, 100u}) {
    std::mt19937 random(refractory);
    OutputStage out(test_leg(), refractory);
    std::array<Tick, 12> shut_at;
    shut_at.fill(-1'000);
    OpenMask before = 0, asked = 0;
    std::uint32_t openings = 0;
    for (Tick t = 0; t < 50'000; ++t) {
      if (random() % 4 == 0) {
        const int valve = static_cast<int>(2 * (random() % 6));  // inlets only
        asked ^= one(valve);
        out.drive(edge(valve, (asked & one(valve)) != 0));
      }
      const OpenMask open = out.at(t);
      for (int v = 0; v < 12; ++v) {
        const auto k = static_cast<std::size_t>(v);
        if ((open & ~before & one(v)) != 0) {
          ++openings;
          ASSERT_GE(t - shut_at[k], refractory);
        }
        if ((before & ~open & one(v)) != 0) shut_at[k] = t;
        // It opens as soon as permitted.
        if ((asked & one(v)) != 0 && t - shut_at[k] >= refractory) {
          ASSERT_NE(open & one(v), 0u);
        }
        if ((asked & one(v)) == 0) {
          ASSERT_EQ(open & one(v), 0u) << "shutting never waits";
        }
      }
      before = open;
    }
    EXPECT_GT(openings, 100u);
    EXPECT_EQ(out.refractories() > 0, refractory > 1);
  }
}

TEST(OutputStage, VentingWaitsForNothing) {
  OutputStage out(test_leg(), 100);
  out.drive(edge(1, true));
  EXPECT_EQ(out.at(0), one(1));
  out.drive(edge(1, false));
  out.drive(edge(2, true));
  EXPECT_EQ(out.at(1), one(2));
  out.vent(2);
  EXPECT_EQ(out.at(2), 0xaaau);
  EXPECT_EQ(out.at(3), 0xaaau);
}

TEST(OutputStage, AValveThatNoBoardHasDoesNothing) {
  OutputStage out(test_leg(), 0);
  out.drive(edge(32, true));
  out.drive(edge(255, true));
  EXPECT_EQ(out.at(0), 0u);
}

}  // namespace
}  // namespace sinew::control::output_stage_test
