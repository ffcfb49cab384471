// Machines in a batch have the same bits as alone: in any lane, with any others, and however far
// each is advanced at a time.
#include "sinew/world/chain_lanes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include "sinew/mechanism/planar/test_setups.h"
#include "sinew/world/batch.h"

namespace sinew::plant::machines_in_lanes_test {
namespace {

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// A leg that stands, hangs or is held, with random parameters and its own step.
Setup random_leg(std::mt19937& random) {
  Setup s = leg_with_muscles(between(random, 4.7, 5.1), between(random, 5.2, 5.6));
  for (robot::Link& link : s.robot.links) link.mass *= between(random, 0.8, 1.2);
  for (std::size_t j = 0; j < 2; ++j) {
    s.robot.joints[j].dry_friction = random() % 3 == 0 ? 0.0 : between(random, 0.0, 0.3);
    s.robot.joints[j].damping = between(random, 0.0, 0.05);
    s.start.blocked[j] = random() % 10 == 0;
  }
  s.robot.trolley.present = random() % 6 != 0;
  s.robot.trolley.drag = between(random, 0, 4);
  s.robot.trolley.track_length = random() % 3 == 0 ? 0.01 : 10.0;
  s.robot.ground.present = random() % 4 != 0;
  s.steps.body = std::array{1e-3, 0.7e-3, 2e-3}[random() % 3];
  s.air.polytropic_exponent = between(random, 1.0, 1.4);
  s.supply.pressure = between(random, 5e5, 8e5);
  for (air::Muscle& m : s.muscles) {
    m.actuator.loss.stick = random() % 5 != 0;
    m.exhaust.flow.area = 1e-6;  // narrow for the longest step
  }
  return s;
}

void expect_same(const Truth& a, const Truth& b) {
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << a.x << " and " << b.x;
}

template <int W>
void expect_batch_alone(std::mt19937& random, double& stood, std::int64_t& nodes) {
  std::vector<Setup> setups;
  for (int k = 0; k < W; ++k) setups.push_back(random_leg(random));
  ChainLanes<2, W> batch{std::span<const Setup, static_cast<std::size_t>(W)>(setups)};
  std::vector<std::unique_ptr<ChainWorld<2>>> alone;
  for (const Setup& s : setups) alone.push_back(std::make_unique<ChainWorld<2>>(s));

  std::array<signals::Tick, W> now{};
  for (int turn = 0; turn < 60; ++turn) {
    typename ChainLanes<2, W>::Instants until{};
    for (std::size_t k = 0; k < W; ++k) {
      now[k] += static_cast<signals::Tick>(random() % 120);
      until[k] = static_cast<double>(now[k]) * signals::tick_seconds;
    }
    batch.advance(until);
    for (std::size_t k = 0; k < W; ++k) {
      const int lane = static_cast<int>(k);
      // Some are read, some driven, some neither.
      if (random() % 3 == 0) {
        const Truth one = alone[k]->truth(until[k]);
        ASSERT_NO_FATAL_FAILURE(expect_same(batch.world(lane).truth(until[k]), one));
        stood += one.foot[0].force_y > 1;
      }
      if (random() % 2 == 0) {
        const signals::Edge edge{now[k] + static_cast<signals::Tick>(random() % 30),
                                 {static_cast<std::uint8_t>(random() % 8)},
                                 random() % 2 == 0};
        ASSERT_EQ(random() % 2 ? batch.drive(lane, edge) : batch.world(lane).drive(edge),
                  alone[k]->drive(edge));
        now[k] = edge.at;
      }
      if (random() % 40 == 0) {  // Back to an earlier state: saved in one, restored in the other.
        const typename ChainWorld<2>::State saved = batch.world(lane).state();
        alone[k]->advance(until[k] + 0.05);
        batch.restore(lane, alone[k]->state());
        alone[k]->advance(until[k] + 0.06);
        ASSERT_NO_FATAL_FAILURE(expect_same(batch.world(lane).truth(until[k] + 0.06),
                                            alone[k]->truth(until[k] + 0.06)));
        alone[k]->restore(saved);
        batch.restore(lane, saved);
      }
    }
  }
  for (std::size_t k = 0; k < W; ++k) {
    const double end = static_cast<double>(now[k]) * signals::tick_seconds;
    expect_same(batch.world(static_cast<int>(k)).truth(end), alone[k]->truth(end));
    EXPECT_EQ(batch.world(static_cast<int>(k)).nodes(), alone[k]->nodes());
    nodes += alone[k]->nodes();
  }
}

template <int W>
void expect_batches_alone() {
  std::mt19937 random(W);
  double stood = 0;
  std::int64_t nodes = 0;
  for (int trial = 0; trial < 20; ++trial)
    ASSERT_NO_FATAL_FAILURE(expect_batch_alone<W>(random, stood, nodes));
  EXPECT_GT(stood, 20 * W);
  EXPECT_GT(nodes, 5000 * W);
}

TEST(ChainLanes, MachinesOfABatchAreThoseAlone) {
  expect_batches_alone<2>();
  if (Batch::widest() >= 4) expect_batches_alone<4>();
  if (Batch::widest() >= 8) expect_batches_alone<8>();
}

// A machine whose air diverges is reported as alone, and the others continue.
TEST(ChainLanes, AFailureIsOneMachinesOwn) {
  std::vector<plant::Setup> setups(2, leg_with_muscles(4.95, 5.40));
  setups[1].robot.links[1].inertia = 1e-12, setups[1].robot.links[1].mass = 1e-9;
  setups[1].robot.foot.mass = 0;
  setups[1].start.pressure = 5e5;
  for (air::Muscle& m : setups[1].muscles) m.actuator.loss.viscous = 0;  // else steps are short
  ChainLanes<2, 2> batch{std::span<const plant::Setup, 2>(setups)};
  ChainWorld<2> well(setups[0]), ill(setups[1]);
  batch.advance({0.5, 0.5});
  well.advance(0.5), ill.advance(0.5);
  ASSERT_TRUE(ill.failure());
  const air::Failure& told = batch.world(1).failure();
  EXPECT_EQ(told.of, ill.failure().of);
  EXPECT_EQ(told.time, ill.failure().time);
  EXPECT_FALSE(batch.world(0).failure());
  expect_same(batch.world(0).truth(0.5), well.truth(0.5));
}

TEST(ChainLanes, OnlyPlainMachinesWithLikeRoutesStandSideBySide) {
  std::vector<plant::Setup> setups(2, leg_with_muscles(4.95, 5.40));
  const std::span<const plant::Setup, 2> both(setups);
  EXPECT_NO_THROW((ChainLanes<2, 2>(both)));
  std::swap(setups[1].robot.muscles[1], setups[1].robot.muscles[2]);
  EXPECT_THROW((ChainLanes<2, 2>(both)), std::invalid_argument);
  setups[1] = setups[0];
  setups[1].muscles[0].leak.area = 1e-8;
  EXPECT_FALSE((ChainLanes<2, 2>::fits(setups[1])));
  EXPECT_THROW((ChainLanes<2, 2>(both)), std::invalid_argument);
}

}  // namespace
}  // namespace sinew::plant::machines_in_lanes_test
