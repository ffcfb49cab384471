// Tests that a chosen rate carries what a board really sends.
#include "sinew/control/link/baud.h"

#include <gtest/gtest.h>

#include "sinew/control/joint/test_leg.h"
#include "sinew/control/link/telemetry.h"
#include "sinew/control/link/test_wire.h"

namespace sinew::link::baud_test {
namespace {

constexpr std::uint32_t choices[] = {2'000'000, 115'200, 460'800, 921'600, 230'400, 1'000'000};

// The largest machine of a board.
control::JointControllerConfig largest() {
  control::JointControllerConfig out;
  out.joints = control::max_joints;
  out.conversions = control::max_conversions;
  for (std::uint8_t i = 0; i < control::max_conversions; ++i) out.conversion[i].channel = {i};
  return out;
}

std::size_t telemetry_bytes(const control::JointControllerConfig& config) {
  const Telemetry t{.joints = static_cast<std::uint8_t>(config.joints),
                    .channels = channels_of(config)};
  std::size_t out = 0;
  for (std::uint8_t p = 0; p < parts_of(t.joints, t.channels); ++p)
    out += min_frame + part_of(t, p).body.size;
  return out;
}

TEST(Baud, TheLoadIsWhatIsSent) {
  for (const control::JointControllerConfig& config : {control::test_leg(), largest()}) {
    const LineLoad load = load_of(config, false);
    EXPECT_EQ(load.to_host,
              telemetry_bytes(config) + frame_of(Reply{}).size() + frame_of(Event{}).size());
    CommandFor command{.joints = static_cast<std::uint8_t>(config.joints)};
    EXPECT_EQ(load.to_board, frame_of(command).size() + frame_of(SetGains{}).size());
  }
}

TEST(Baud, EdgesAreFourOfEachValve) {
  const control::JointControllerConfig leg = control::test_leg();
  std::size_t expected = 0, edges = 4 * 4 * leg.joints;
  while (edges > 0) {
    Edges message{.count = static_cast<std::uint8_t>(std::min(edges, max_edges))};
    edges -= message.count;
    expected += frame_of(message).size();
  }
  EXPECT_EQ(load_of(leg, true).to_host - load_of(leg, false).to_host, expected);
}

TEST(Baud, TheSlowestThatCarriesAllIsChosen) {
  control::JointControllerConfig config = control::test_leg();
  for (const bool edges : {false, true})
    for (const std::uint16_t period : {20, 50, 100, 200, 400}) {
      config.period = period;
      const std::uint32_t baud = choose_baud(config, edges, choices);
      const LineLoad load = load_of(config, edges);
      for (const std::uint32_t other : choices)
        EXPECT_EQ(carries(other, load, period), baud != 0 && other >= baud) << other;
      if (baud == 0) continue;
      // bits of a period compared with bits that the line carries in it
      EXPECT_LE(10.0 * load.to_host, 0.9 * baud * period * 1e-4);
      EXPECT_LE(10.0 * load.to_board, 0.9 * baud * period * 1e-4);
    }
}

// Numbers of docs/reference/wire.md.
TEST(Baud, OfTheLegAndOfTheLargestBoard) {
  EXPECT_EQ(load_of(control::test_leg(), false).to_host, 482u);
  EXPECT_EQ(load_of(control::test_leg(), false).to_board, 128u);
  EXPECT_EQ(choose_baud(control::test_leg(), false, choices), 921'600u);
  EXPECT_EQ(choose_baud(control::test_leg(), true, choices), 921'600u);
  EXPECT_EQ(load_of(largest(), false).to_host, 1147u);
  EXPECT_EQ(load_of(largest(), false).to_board, 258u);
  EXPECT_EQ(choose_baud(largest(), false, choices), 2'000'000u);
  EXPECT_EQ(choose_baud(largest(), true, choices), 0u);
}

TEST(Baud, ALineThatIsTooSlowIsRefused) {
  constexpr std::uint32_t slow[] = {9600, 115'200};
  EXPECT_EQ(choose_baud(largest(), false, slow), 0u);
  EXPECT_EQ(choose_baud(largest(), false, {}), 0u);
}

}  // namespace
}  // namespace sinew::link::baud_test
