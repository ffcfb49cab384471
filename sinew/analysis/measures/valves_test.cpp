#include "sinew/analysis/measures/valves.h"

#include <gtest/gtest.h>

#include <random>

namespace sinew::analysis::valves_test {
namespace {

constexpr double opening = 0.4e-3, closing = 1.1e-3;

Edges pulse(double from, double length) { return {{from, true}, {from + length, false}}; }

TEST(Valves, EdgesAreChanges) {
  const std::vector<std::int64_t> t = {0, 10, 20, 30, 40};
  const std::vector<double> open = {0, 1, 1, 0, 0};
  const Edges edges = edges_of(t, open);
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_TRUE(edges[0].open);
  EXPECT_DOUBLE_EQ(edges[0].time, 10e-9);
  EXPECT_DOUBLE_EQ(edges[1].time, 30e-9);
}

TEST(Valves, AStandingPulseDeliversItsLengthAndTheDifferenceOfTheDelays) {
  for (const double length : {0.5e-3, 1e-3, 3e-3}) {
    const Edges out = delivered(pulse(0.1, length), opening, closing);
    EXPECT_NEAR(open_time(out, 0, 1), length - opening + closing, 1e-15);
  }
}

TEST(Valves, AShortPulseDeliversNothing) {
  for (const double length : {0.1e-3, 0.4e-3})
    EXPECT_TRUE(delivered(pulse(0.1, length), opening, closing).empty());
}

TEST(Valves, AShortGapKeepsItOpen) {
  Edges edges = pulse(0.1, 2e-3);
  for (const Edge& e : pulse(0.103, 2e-3)) edges.push_back(e);  // after 1 ms
  const Edges out = delivered(edges, opening, closing);
  EXPECT_EQ(openings(out, 0, 1), 1);
  EXPECT_NEAR(open_time(out, 0, 1), 5e-3 - opening + closing, 1e-15);
}

TEST(Valves, OpenTimeIsCutAtTheWindow) {
  const Edges edges = {{1.0, true}, {2.0, false}, {3.0, true}};
  EXPECT_DOUBLE_EQ(open_time(edges, 0, 10), 8);
  EXPECT_DOUBLE_EQ(open_time(edges, 1.5, 3.5), 1);
  EXPECT_DOUBLE_EQ(open_time(edges, 2.0, 3.0), 0);
  EXPECT_EQ(openings(edges, 1.0, 3.0), 1);
  EXPECT_EQ(openings({}, 0, 1), 0);
}

// Without a boost the energy is power times time; with one, every pulse adds a boost.
TEST(Valves, CoilEnergyIsPowerByTimeAndTheBoostOfEveryPulse) {
  Edges edges;
  for (const double length : {0.5e-3, 2e-3, 6e-3})
    for (const Edge& e : pulse(edges.empty() ? 0.1 : edges.back().time + 1e-3, length))
      edges.push_back(e);
  EXPECT_NEAR(coil_energy(edges, {.power = 3}, 0, 1), 3 * 8.5e-3, 1e-15);
  const gas::Coil boosted{.power = 1, .boost_power = 9, .boost_time = 1e-3};
  EXPECT_NEAR(coil_energy(edges, boosted, 0, 1), 8.5e-3 + 8 * (0.5e-3 + 1e-3 + 1e-3), 1e-15);
}

// The energies of two parts of a run add up to that of the run, also if it is cut within a boost.
TEST(Valves, CoilEnergyOfPartsAddsUp) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> length(1e-4, 8e-3), anywhere(0.0, 1.0);
  Edges edges;
  for (int i = 0; i < 100; ++i)
    for (const Edge& e : pulse(0.01 * i, length(random))) edges.push_back(e);
  const gas::Coil coil{.power = 1.5, .boost_power = 12, .boost_time = 2e-3};
  const double all = coil_energy(edges, coil, 0, 1);
  for (int i = 0; i < 100; ++i) {
    const double cut = anywhere(random);
    EXPECT_NEAR(coil_energy(edges, coil, 0, cut) + coil_energy(edges, coil, cut, 1), all, 1e-12);
  }
}

// Pulses of 6 ms in 10 ms, with delays of 4 ms and 1 ms, have a delivered duty of 30 %, 3.4.
TEST(Valves, DutyThroughTheDelaysOfChapter3) {
  Edges edges;
  for (int i = 0; i < 100; ++i)
    for (const Edge& e : pulse(0.01 * i, 6e-3)) edges.push_back(e);
  EXPECT_NEAR(open_time(delivered(edges, 4e-3, 1e-3), 0, 1), 0.3, 1e-12);
}

}  // namespace
}  // namespace sinew::analysis::valves_test
