// Conservation laws of trees of links: of several legs, and of links attached anywhere on others.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <span>

#include "sinew/mechanism/planar/test_setups.h"
#include "sinew/robot/kinematics.h"
#include "sinew/world/machine.h"

namespace sinew::plant::tree_test {
namespace {

// The setup's leg twice on one trolley, the second one at `apart` ahead of the first.
Setup twice(const Setup& one, double apart = 0) {
  plant::Setup s = one;
  s.robot.links.clear(), s.robot.joints.clear(), s.robot.muscles.clear();
  s.muscles.clear(), s.start.joint_angle.clear(), s.start.blocked.clear();
  for (const std::string leg : {"left", "right"}) {
    s.robot.legs.push_back({.name = leg, .joints = {}, .foot = {}, .plan = {}});
    for (robot::Link link : one.robot.links) {
      const bool first = link.name == one.robot.links[0].name;
      if (first) link.parent = robot::body_name;
      if (first && leg == "right") link.at = apart;
      link.name = leg + "_" + link.name;
      s.robot.links.push_back(link);
    }
    for (robot::Joint joint : one.robot.joints) {
      joint.name = leg + "_" + joint.name;
      s.robot.legs.back().joints.push_back(joint.name);
      s.robot.joints.push_back(joint);
    }
    for (robot::Muscle muscle : one.robot.muscles) {
      muscle.name = leg + "_" + muscle.name;
      muscle.joint = leg + "_" + muscle.joint;
      s.robot.muscles.push_back(muscle);
    }
    for (const air::Muscle& muscle : one.muscles) s.muscles.push_back(muscle);
    for (const double angle : one.start.joint_angle) s.start.joint_angle.push_back(angle);
    for (const bool blocked : one.start.blocked) s.start.blocked.push_back(blocked);
  }
  return s;
}

double swinging_energy(const BodyConstants<8>& k) {
  double e = 0;
  for (std::size_t i = 0; i < k.links(); ++i) e += k.gravity * std::abs(k.first_moment[i]);
  return e;
}

TEST(Trees, KeepEnergyAndMomentum) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 12; ++trial) {
    BodyWorld world(random_tree(random, 3 + trial % 6));
    const double before = energy(world.constants(), world.motion());
    world.advance(2.0);
    const double scale = swinging_energy(world.constants());
    EXPECT_LE(std::abs(energy(world.constants(), world.motion()) - before) / scale, 1e-5);
    EXPECT_LE(
        std::abs(momentum(world.constants(), world.motion())[0]) / world.constants().sliding_mass,
        1e-6);
  }
}

// Returns the positions of a tree's masses, by its kinematics alone: each link's centre, each foot,
// the body.
double kinetic_energy(const Setup& s, const std::vector<double>& angle,
                      const std::vector<double>& rate, double slide) {
  constexpr double h = 1e-5;
  std::vector<double> ahead = angle, behind = angle;
  for (std::size_t j = 0; j < angle.size(); ++j) ahead[j] += h * rate[j], behind[j] -= h * rate[j];
  const auto a = robot::places(s.robot, ahead), b = robot::places(s.robot, behind);
  double sum = 0.5 * robot::trolley_own_mass(s.robot) * slide * slide;
  for (std::size_t i = 0; i < s.robot.links.size(); ++i) {
    const robot::Link& link = s.robot.links[i];
    const auto add = [&](double mass, double along) {
      const auto x = [&](const robot::LinkPlace& p) {
        return p.joint.x + along * std::cos(p.heading);
      };
      const auto y = [&](const robot::LinkPlace& p) {
        return p.joint.y + along * std::sin(p.heading);
      };
      const double vx = slide + (x(a[i]) - x(b[i])) / (2 * h), vy = (y(a[i]) - y(b[i])) / (2 * h);
      sum += 0.5 * mass * (vx * vx + vy * vy);
    };
    add(link.mass, link.center_of_mass);
    if (i + 1 == s.robot.links.size()) add(s.robot.foot.mass, link.length);
    const double turn = (a[i].heading - b[i].heading) / (2 * h);
    sum += 0.5 * link.inertia * turn * turn;
  }
  return sum;
}

// The energy of the equations of motion is that of the masses that the kinematics move.
TEST(Trees, EnergyIsThatOfTheirMasses) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> any(-2, 2);
  for (int trial = 0; trial < 40; ++trial) {
    const plant::Setup s = random_tree(random);
    const std::vector<double> rate{any(random), any(random), any(random), any(random)};
    BodyWorld world(s);
    const double slide = any(random);
    world.set_rates({rate[0], rate[1], rate[2], rate[3]}, slide);
    BodyState<8> still = world.motion();
    still.rate = {};
    const double moving = energy(world.constants(), world.motion());
    const double kinetic = kinetic_energy(s, s.start.joint_angle, rate, slide);
    EXPECT_NEAR(moving - energy(world.constants(), still), kinetic, 1e-7 * (1 + kinetic));
  }
}

// The inverse mass matrix is symmetric and positive for any tree in any pose.
TEST(Trees, MassMatrixIsSymmetricAndPositive) {
  std::mt19937 random(9);
  std::normal_distribution<double> any;
  const auto dot = [](const Coordinates<8>& a, const Coordinates<8>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  for (int trial = 0; trial < 100; ++trial) {
    const plant::Setup s = random_tree(random);
    const BodyConstants<8> k = body_of<8>(s.robot);
    BodyWorld world(s);
    const Body body(k, world.motion());
    Coordinates<8> f{}, g{};
    for (std::size_t i = 0; i < k.coordinates(); ++i) f[i] = any(random), g[i] = any(random);
    const double fg = dot(f, body.response(g)), gf = dot(g, body.response(f));
    const double scale = std::sqrt(dot(f, body.response(f)) * dot(g, body.response(g)));
    EXPECT_NEAR(fg, gf, 1e-10 * scale);
    EXPECT_GT(dot(f, body.response(f)), 0);
  }
}

// Parents and attachments equal to the defaults change no bit.
TEST(Trees, AChainWrittenInFullIsTheChain) {
  const plant::Setup plain = leg_with_muscles(4.95, 5.40);
  plant::Setup said = plain;
  said.robot.links[0].parent = robot::body_name;
  said.robot.links[0].at = 0;
  said.robot.links[1].parent = "femur";
  said.robot.links[1].at = said.robot.links[0].length;
  said.robot.ground.present = true;
  plant::Setup same = plain;
  same.robot.ground.present = true;
  EXPECT_TRUE(robot::is_chain(said.robot));
  BodyWorld a(same), b(said);
  std::mt19937 random(4);
  for (signals::Tick t = 100; t <= 10000; t += 100) {
    const signals::Edge edge{t, {static_cast<std::uint8_t>(random() % 8)}, random() % 3 == 0};
    a.drive(edge);
    b.drive(edge);
    const Truth p = a.truth(t * 1e-4), q = b.truth(t * 1e-4);
    for (std::size_t j = 0; j < 2; ++j) ASSERT_EQ(p.angle[j], q.angle[j]) << t;
    ASSERT_EQ(p.x, q.x) << t;
    ASSERT_EQ(p.foot[0].force_y, q.foot[0].force_y) << t;
  }
}

// Two legs with the same motion, wherever they hang, equal one that carries half the trolley
// against half its drag, as long as nothing makes them differ.
TEST(Trees, TwoEqualLegsAreOneWithHalfTheTrolley) {
  plant::Setup one = leg_with_muscles(4.95, 5.40);
  one.robot.ground.present = true;
  one.robot.trolley.drag = 2;
  for (robot::Joint& j : one.robot.joints) j.dry_friction = 0.1, j.damping = 0.05;
  plant::Setup two = twice(one, 0.1);
  two.robot.trolley.total_mass *= 2;
  two.robot.trolley.drag *= 2;
  ASSERT_EQ(robot::trolley_own_mass(two.robot), 2 * robot::trolley_own_mass(one.robot));
  BodyWorld a(one), b(two);
  std::mt19937 random(11);
  bool touched = false;
  for (signals::Tick t = 100; t <= 15000; t += 100) {
    const auto valve = static_cast<std::uint8_t>(random() % 8);
    const bool open = random() % 3 == 0;
    a.drive({t, {valve}, open});
    b.drive({t, {valve}, open});
    b.drive({t, {static_cast<std::uint8_t>(valve + 8)}, open});
    const Truth p = a.truth(t * 1e-4), q = b.truth(t * 1e-4);
    touched = touched || p.foot[0].force_y > 0;
    EXPECT_NEAR(p.x, q.x, 1e-6) << t;
    for (std::size_t leg = 0; leg < 2; ++leg) {
      for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(p.angle[j], q.angle[2 * leg + j], 2e-6) << t;
      EXPECT_NEAR(p.foot[0].x, q.foot[leg].x, 1e-6) << t;
      EXPECT_NEAR(p.foot[0].force_y, q.foot[leg].force_y, 0.1) << t;
    }
  }
  EXPECT_TRUE(touched);
}

// Legs that mirror each other leave the trolley at rest and stay mirrored.
TEST(Trees, MirroredLegsKeepTheTrolleyAtRest) {
  plant::Setup s = twice(leg_without_muscles(4.4, 0.5), 0.2);
  s.start.joint_angle[2] = 3 * std::numbers::pi - 4.4;
  s.start.joint_angle[3] = -0.5;
  BodyWorld world(s);
  const double start = world.truth(0).foot[0].x;
  double moved = 0;
  for (int k = 1; k <= 20; ++k) {
    const Truth now = world.truth(0.1 * k);
    EXPECT_NEAR(now.x, 0, 1e-9) << k;
    EXPECT_NEAR(now.foot[0].x, -now.foot[1].x, 1e-7) << k;
    EXPECT_NEAR(now.foot[0].y, now.foot[1].y, 1e-7) << k;
    moved = std::max(moved, std::abs(now.foot[0].x - start));
  }
  EXPECT_GT(moved, 0.1);
}

// A body that is free in the plane: a trolley without drag, a slide without air, and a trunk that
// pitches at a passive joint, with both legs on it.
plant::Setup free_in_the_plane(double apart) {
  plant::Setup s = twice(leg_without_muscles(4.4, 0.5));
  robot::Link trunk = s.robot.links[0];
  trunk.name = "trunk";
  trunk.parent = robot::body_name;
  trunk.length = apart;
  trunk.center_of_mass = 0.5 * apart;
  s.robot.links.insert(s.robot.links.begin(), trunk);
  robot::Joint pitch;
  pitch.name = "trunk";
  pitch.kind = robot::Joint::Kind::passive;
  s.robot.joints.insert(s.robot.joints.begin(), pitch);
  s.start.joint_angle.insert(s.start.joint_angle.begin(), 0.1);
  s.start.blocked.insert(s.start.blocked.begin(), false);
  s.robot.links[1].parent = s.robot.links[3].parent = "trunk";
  s.robot.links[1].at = 0;
  s.robot.links[3].at = apart;
  s.robot.cylinder = {.present = true, .mode = robot::Cylinder::Mode::free, .stroke = 1};
  s.robot.trolley.total_mass = robot::leg_mass(s.robot);
  return s;
}

// Thrown, its centre of mass flies a parabola, its energy is constant, and without gravity so is
// its angular momentum.
TEST(Trees, FreeBodyFliesAParabola) {
  const plant::Setup s = free_in_the_plane(0.3);
  BodyWorld world(s);
  world.set_rates({2, -3, 4, 1, -2}, 0.7, 3);
  const BodyConstants<8>& k = world.constants();
  const double mass = k.sliding_mass, before = energy(k, world.motion());
  const std::array<double, 2> thrown = momentum(k, world.motion());
  world.advance(0.5);
  const std::array<double, 2> now = momentum(k, world.motion());
  EXPECT_NEAR(now[0], thrown[0], 1e-7 * mass);
  EXPECT_NEAR(now[1], thrown[1] - mass * k.gravity * world.time(), 1e-7 * mass);
  EXPECT_NEAR(energy(k, world.motion()), before, 1e-6 * std::abs(before));
  EXPECT_GT(std::abs(world.truth(0.5).angle[0] - 0.1), 0.1);
}

TEST(Trees, FreeBodyKeepsItsAngularMomentum) {
  plant::Setup s = free_in_the_plane(0.3);
  s.robot.gravity = 0;
  BodyWorld world(s);
  world.set_rates({2, -3, 4, 1, -2}, 0, 0);
  // About the origin, from the masses' positions by the kinematics, slightly before and after.
  const auto angular = [&](double t) {
    constexpr double h = 1e-3;
    const auto at = [&](double when) {
      const Truth truth = world.truth(when);
      auto places = robot::places(s.robot, std::span(truth.angle).first(5));
      for (robot::LinkPlace& p : places) p.joint.x += truth.x, p.joint.y += truth.lift;
      return places;
    };
    const auto a = at(t), b = at(t + h);
    double sum = 0;
    const auto add = [&](double mass, const robot::LinkPlace& p, const robot::LinkPlace& q,
                         double along) {
      const double x = p.joint.x + along * std::cos(p.heading),
                   y = p.joint.y + along * std::sin(p.heading),
                   u = q.joint.x + along * std::cos(q.heading),
                   v = q.joint.y + along * std::sin(q.heading);
      sum += mass * (0.5 * (x + u) * (v - y) - 0.5 * (y + v) * (u - x)) / h;
    };
    for (std::size_t i = 0; i < s.robot.links.size(); ++i) {
      const robot::Link& link = s.robot.links[i];
      add(link.mass, a[i], b[i], link.center_of_mass);
      if (i == 2 || i == 4) add(s.robot.foot.mass, a[i], b[i], link.length);
      sum += link.inertia * (b[i].heading - a[i].heading) / h;
    }
    return sum;
  };
  const double start = angular(0);
  EXPECT_GT(std::abs(start), 1e-3);
  for (const double t : {0.2, 0.5, 0.9})
    EXPECT_NEAR(angular(t), start, 1e-4 * std::abs(start)) << t;
}

// Without losses a stop returns the energy; with its damper the joint comes to rest within.
TEST(Stops, HoldAJointWithinItsRange) {
  for (const bool chain : {true, false}) {
    plant::Setup s = leg_without_muscles(4.9, 5.6);
    s.robot.trolley.present = false;
    s.robot.joints[0].stop = {.range = {4.0, 5.2}, .stiffness = 2000, .damping = 0};
    s.robot.joints[1].stop = {.range = {5.0, 6.0}, .stiffness = 2000, .damping = 0};
    const auto run = [&](auto& world, double seconds) {
      world.set_rates({6, -4}, 0);
      double beyond = 0;
      for (int i = 1; i <= 1000 * seconds; ++i) {
        const Truth now = world.truth(1e-3 * i);
        for (std::size_t j = 0; j < 2; ++j) {
          const auto& range = s.robot.joints[j].stop.range;
          beyond = std::max({beyond, now.angle[j] - range[1], range[0] - now.angle[j]});
        }
      }
      return beyond;
    };
    const auto made = [&](const plant::Setup& setup, double seconds) {
      if (chain) {
        ChainWorld<2> world(setup);
        return run(world, seconds);
      }
      BodyWorld world(setup);
      return run(world, seconds);
    };
    const double elastic = made(s, 2);
    EXPECT_GT(elastic, 0.005) << chain;  // it strikes
    EXPECT_LT(elastic, 0.1) << chain;
    for (robot::Joint& j : s.robot.joints) j.stop.damping = 5;
    EXPECT_LT(made(s, 2), elastic) << chain;
  }
}

TEST(Stops, AnElasticStopKeepsEnergy) {
  plant::Setup s = leg_without_muscles(4.9, 5.6);
  s.robot.joints[0].stop = {.range = {4.4, 5.1}, .stiffness = 500, .damping = 0};
  s.steps.body = 1e-4;
  BodyWorld world(s);
  world.set_rates({5, 0}, 0);
  const double before = energy(world.constants(), world.motion());
  bool struck = false;
  double apart = 0;
  for (int i = 1; i <= 300; ++i) {
    const Truth now = world.truth(0.01 * i);
    const double over = std::max({0.0, now.angle[0] - 5.1, 4.4 - now.angle[0]});
    struck = struck || over > 0.01;
    world.advance(0.01 * i);
    const double held = energy(world.constants(), world.motion());
    if (over == 0) apart = std::max(apart, std::abs(held - before));
  }
  EXPECT_TRUE(struck);
  EXPECT_LT(apart, 1e-4 * swinging_energy(world.constants()));
}

// At rest, legs that hang ahead of the origin load the front roller by their lever.
TEST(Trees, RollersCarryLegsWhereTheyHang) {
  const double apart = 0.3;
  plant::Setup s = twice(leg_without_muscles(1.5 * std::numbers::pi, 0), apart);
  for (auto&& blocked : s.start.blocked) blocked = true;
  s.robot.trolley.drag = 4;
  s.robot.rollers = {.present = true, .front = 0.5, .rear = -0.5};
  const Truth now = BodyWorld(s).truth(0);
  const double g = s.robot.gravity, leg = 0.5 * robot::leg_mass(s.robot);
  EXPECT_NEAR(now.roller_front + now.roller_rear, s.robot.trolley.total_mass * g, 1e-9);
  EXPECT_NEAR(0.5 * (now.roller_front - now.roller_rear), leg * g * apart, 1e-9);
}

}  // namespace
}  // namespace sinew::plant::tree_test
