// Machines side by side: the body of each has the same bits as alone.

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <random>

#include "sinew/mechanism/planar/chain_body.h"
#include "sinew/mechanism/planar/test_setups.h"

namespace sinew::plant::chain_lanes_test {
namespace {

using units::Pack;

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Returns whether all doubles of a lane equal the struct's, to the bit.
template <class One, class Packed>
bool same_bits(const Packed& packed, int lane, const One& one) {
  const One of_lane = units::lane_of<One>(packed, lane);
  return std::memcmp(&of_lane, &one, sizeof one) == 0;
}

// A problem as machines have them: coupled contacts, some without a bound, some that cannot move
// independently, and a history that may be wrong.
template <int C>
FrictionProblem<C> random_problem(std::mt19937& random) {
  FrictionProblem<C> p{};
  const int freedoms = 1 + static_cast<int>(random() % C);
  double a[C][C];
  for (auto& row : a)
    for (double& v : row) v = between(random, -1.5, 1.5);
  for (int i = 0; i < C; ++i) {
    p.slip[i] = between(random, -1.5, 1.5);
    p.bound[i] = random() % 4 == 0 ? 0.0 : between(random, 0.05, 2.0);
    for (int j = 0; j < C; ++j)
      for (int k = 0; k < freedoms; ++k) p.response[i][j] += a[i][k] * a[j][k];
  }
  return p;
}

template <int C, int W>
void expect_frictions_alone() {
  std::mt19937 random(C * 10 + W);
  int stuck = 0, slid = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    std::array<FrictionProblem<C>, W> each;
    std::array<std::array<double, C>, W> last;
    for (auto& p : each) p = random_problem<C>(random);
    for (auto& forces : last)
      for (double& f : forces) f = random() % 3 == 0 ? 0.0 : between(random, -2, 2);
    const auto packed = solve_friction<C>(
        units::side_by_side<FrictionProblem<C, Pack<W>>>(each),
        units::side_by_side<std::array<Pack<W>, static_cast<std::size_t>(C)>>(last));
    for (int k = 0; k < W; ++k) {
      const auto l = static_cast<std::size_t>(k);
      const std::array<double, C> alone = solve_friction<C>(each[l], last[l]);
      ASSERT_TRUE(same_bits(packed, k, alone)) << "trial " << trial << ", lane " << k;
      for (int c = 0; c < C; ++c) (std::abs(alone[c]) < each[l].bound[c] ? stuck : slid) += 1;
    }
  }
  EXPECT_GT(stuck, 1000 * W);
  EXPECT_GT(slid, 1000 * W);
}

TEST(ChainLanes, FrictionsOfManyAreThoseOfEach) {
  expect_frictions_alone<3, 2>();
  expect_frictions_alone<4, 2>();
  expect_frictions_alone<4, 4>();
  expect_frictions_alone<6, 2>();  // some of them change sides more than eight times
}

// A leg with random parameters: on the ground or in the air, with or without trolley, at the
// ends of its joints' ranges or of the track, or with a held joint.
Setup random_leg(std::mt19937& random) {
  Setup s = leg_with_muscles(between(random, 4.6, 5.2), between(random, 5.0, 5.8));
  const auto vary = [&](double& number) { number *= between(random, 0.8, 1.2); };
  for (robot::Link& link : s.robot.links)
    vary(link.length), vary(link.mass), vary(link.inertia), vary(link.center_of_mass);
  for (std::size_t j = 0; j < 2; ++j) {
    robot::Joint& joint = s.robot.joints[j];
    vary(joint.moment_arm);
    joint.dry_friction = random() % 3 == 0 ? 0.0 : between(random, 0.0, 0.5);
    joint.damping = between(random, 0.0, 0.1);
    joint.spring = random() % 2 == 0 ? 0.0 : between(random, 0.0, 2.0);
    joint.spring_angle = 0.4;
    s.start.blocked[j] = random() % 8 == 0;
    if (random() % 2 == 0) continue;
    const double low = between(random, -0.3, 0.1);
    joint.stop = {.stiffness = 200, .damping = 0.5};
    joint.stop.range = {s.start.joint_angle[j] + low, s.start.joint_angle[j] + low + 0.3};
  }
  s.robot.trolley.present = random() % 6 != 0;
  s.robot.trolley.drag = random() % 4 == 0 ? 0.0 : between(random, 0, 6);
  s.robot.trolley.breakaway = random() % 2 == 0 ? 0.0 : 5.0;
  s.robot.trolley.track_length = random() % 4 == 0 ? 0.0 : 10.0;
  s.robot.ground.present = random() % 4 != 0;
  s.robot.ground.height = between(random, -14.0, -12.5) * inch;
  for (robot::Muscle& m : s.robot.muscles) vary(m.mount_length);
  return s;
}

// The muscles' tensions and friction bounds, in place of an air [N].
template <class S>
struct Pulls {
  std::array<S, chain_muscles> tension, friction_bound;
};

// All functions of a body that a step calls.
template <int N, class S>
struct NodeResult {
  std::array<S, chain_muscles> length, rate;
  typename ChainBody<N, S>::Load load;
  typename ChainBody<N, S>::Acceleration free, under, staged;
  typename ChainBody<N, S>::Forces held;
  S trolley_bound, sum;
  GeneralizedState<N, S> now, stage, glided;
};

template <int N, class S>
NodeResult<N, S> step(ChainBody<N, S>& body, const GeneralizedState<N, S>& now,
                      const Pulls<S>& pulls, const std::array<S, N + 2>& last, const S& last_bound,
                      const S& h) {
  NodeResult<N, S> out{.now = now};
  typename ChainBody<N, S>::Arms arms;
  typename ChainBody<N, S>::Ends ends{};
  body.route(0, now, ends, arms);
  for (int i = 0; i < body.muscles(); ++i)
    out.length[i] = ends.length[i], out.rate[i] = ends.rate[i];

  const auto chain = body.pose(0, now);
  body.load(chain, now, arms, pulls, out.load);
  out.trolley_bound = body.trolley_bound(last, last_bound);
  air::Lanes<chain_muscles, S> friction_bound{};
  for (int i = 0; i < chain_muscles; ++i) friction_bound[i] = pulls.friction_bound[i];
  out.free = body.prepare(chain, now, arms, friction_bound, out.trolley_bound, out.load);
  out.held = body.hold(h, last);
  out.under = body.accelerate(out.free, out.held);

  body.move(out.stage, now, 0.5 * h, now, out.under);
  const auto later = body.pose(0, out.stage);
  typename ChainBody<N, S>::Load load;
  body.load(later, out.stage, arms, pulls, load);
  out.staged = body.accelerate(later, out.stage, load, out.held);
  out.glided = now;
  body.extrapolate(out.glided, h, out.under);
  const typename ChainBody<N, S>::Acceleration a[4] = {out.under, out.staged, out.staged,
                                                       out.staged};
  body.finish(out.now, h, {&now, &out.stage, &out.stage, &out.glided}, a);
  out.sum = body.sum(out.now);
  return out;
}

// Moves W machines by a number of steps side by side, each with its own length, and each alone.
template <int N, int W>
void expect_bodies_alone(std::mt19937& random, int& standing, int& sticking, int& mixed) {
  std::vector<ChainMechanism<N>> alone;
  std::array<const ChainBody<N>*, W> each;
  std::array<GeneralizedState<N>, W> now;
  alone.reserve(W);
  for (std::size_t k = 0; k < W; ++k) {
    Setup s = random_leg(random);
    if (N == 1) {
      s.robot.muscles.resize(2);
      s.robot.ground.height = between(random, -9.5, -8.0) * inch;
    }
    each[k] = &alone.emplace_back(s);
    now[k] = alone[k].start();
    now[k].x_rate = s.robot.trolley.present ? between(random, -0.2, 0.2) : 0.0;
    for (double& rate : now[k].rate) rate = between(random, -3, 3);
  }
  auto body = side_by_side(each);
  std::array<std::array<double, N + 2>, W> held{};
  std::array<double, W> bound{};
  for (int trial = 0; trial < 30; ++trial) {
    std::array<Pulls<double>, W> pulls{};
    std::array<double, W> h;
    for (std::size_t k = 0; k < W; ++k) {
      h[k] = random() % 4 == 0 ? between(random, 1e-7, 1e-3) : 1e-3;
      for (double& f : pulls[k].tension) f = random() % 3 == 0 ? 0.0 : between(random, 0, 300);
      for (double& f : pulls[k].friction_bound) f = random() % 3 == 0 ? 0.0 : between(random, 0, 9);
    }
    const auto packed =
        step<N, Pack<W>>(body, units::side_by_side<GeneralizedState<N, Pack<W>>>(now),
                         units::side_by_side<Pulls<Pack<W>>>(pulls),
                         units::side_by_side<std::array<Pack<W>, N + 2>>(held),
                         units::side_by_side<Pack<W>>(bound), units::side_by_side<Pack<W>>(h));
    int stand = 0;
    for (std::size_t k = 0; k < W; ++k) {
      const auto one = step<N, double>(alone[k], now[k], pulls[k], held[k], bound[k], h[k]);
      ASSERT_TRUE(same_bits(packed, static_cast<int>(k), one)) << "step " << trial << " of " << k;
      now[k] = one.now;
      held[k] = one.held;
      bound[k] = one.trolley_bound;
      stand += one.load.normal > 0;
      sticking += std::abs(one.held[0]) < alone[k].bound(0);
    }
    standing += stand;
    mixed += stand > 0 && stand < W;
  }
}

template <int N, int W>
void expect_all_bodies_alone() {
  std::mt19937 random(7 * N + W);
  int standing = 0, sticking = 0, mixed = 0;
  for (int machine = 0; machine < 200; ++machine)
    ASSERT_NO_FATAL_FAILURE((expect_bodies_alone<N, W>(random, standing, sticking, mixed)));
  EXPECT_GT(standing, 200 * W);
  EXPECT_GT(sticking, 200 * W);
  EXPECT_GT(mixed, 200);
}

TEST(ChainLanes, BodiesOfManyAreThoseOfEach) {
  expect_all_bodies_alone<2, 2>();
  expect_all_bodies_alone<2, 4>();
}

TEST(ChainLanes, OneLinkToo) { expect_all_bodies_alone<1, 2>(); }

TEST(ChainLanes, OnlyAlikeRoutesStandSideBySide) {
  const ChainRouting four = chain_routing_of(leg_with_muscles(4.9, 5.4).robot);
  plant::Setup s = leg_with_muscles(4.9, 5.4);
  std::swap(s.robot.muscles[1], s.robot.muscles[2]);
  const ChainRouting swapped = chain_routing_of(s.robot);
  s.robot.muscles.pop_back();
  EXPECT_TRUE(alike(four, four));
  EXPECT_FALSE(alike(four, swapped));
  EXPECT_FALSE(alike(swapped, chain_routing_of(s.robot)));
}

}  // namespace
}  // namespace sinew::plant::chain_lanes_test
