// Conservation laws of a machine of any shape, and agreement of all worlds that can represent it.
#include "sinew/world/machine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sinew/mechanism/planar/test_setups.h"

namespace sinew::plant::body_world_test {
namespace {

// Links attached to the leg's, each a little smaller, with joints without muscles.
Setup chain_setup(std::size_t links) {
  plant::Setup s = leg_without_muscles(0.6, -0.9);
  const robot::Link femur = s.robot.links[0];
  s.robot.links.clear();
  s.robot.joints.clear();
  s.start.joint_angle.clear();
  s.start.blocked.clear();
  for (std::size_t i = 0; i < links; ++i) {
    robot::Link link = femur;
    link.name = "link" + std::to_string(i);
    link.length *= 1.0 - 0.15 * static_cast<double>(i);
    link.mass *= 1.0 - 0.2 * static_cast<double>(i);
    s.robot.links.push_back(link);
    robot::Joint joint;
    joint.name = "joint" + std::to_string(i);
    joint.kind = robot::Joint::Kind::passive;
    s.robot.joints.push_back(joint);
    s.start.joint_angle.push_back(i % 2 == 0 ? 0.6 : -0.9);
    s.start.blocked.push_back(false);
  }
  return s;
}

// The body is carried by a spring of air alone: a cylinder whose valves stay shut.
air::Cylinder thesis_cylinder() {
  air::Cylinder c;
  c.bore = 0.627 * inch;
  c.rod_diameter = 0.1875 * inch;
  c.stroke = 2 * inch;
  c.dead_volume = {5e-7, 5e-7};
  return c;
}

void give_cylinder(Setup& s, robot::Cylinder::Mode mode) {
  s.cylinder = thesis_cylinder();
  s.robot.cylinder = {.present = true,
                      .mode = mode,
                      .bore = s.cylinder->bore,
                      .rod_diameter = s.cylinder->rod_diameter,
                      .stroke = s.cylinder->stroke,
                      .body_mass = 3 * pound,
                      .stop_stiffness = 2e4,
                      .stop_damping = 100};
}

double swinging_energy(const BodyConstants<8>& k) {
  double e = 0;
  for (std::size_t i = 0; i < k.links(); ++i) e += k.gravity * k.first_moment[i];
  return e;
}

class Chains : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Chains, KeepEnergyAndMomentum) {
  BodyWorld world(chain_setup(GetParam()));
  const double before = energy(world.constants(), world.motion());
  world.advance(4.0);
  const double scale = swinging_energy(world.constants());
  EXPECT_LE(std::abs(energy(world.constants(), world.motion()) - before) / scale, 2e-6);
  const double unit = world.constants().sliding_mass;  // times 1 m/s
  EXPECT_LE(std::abs(momentum(world.constants(), world.motion())[0]) / unit, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(OneToFour, Chains, ::testing::Values(1u, 2u, 3u, 4u));

// Two derivations of the same equations: eliminated trolley, and dense with a held lift.
TEST(BodyWorld, BodyAgreesWithTheFastChain) {
  const plant::Setup s = leg_without_muscles(0.6, -0.9);
  const BodyConstants<8> whole = body_of<8>(s.robot);
  const ChainConstants<2> fast = chain_of<2>(s.robot);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-3, 3);
  for (int trial = 0; trial < 200; ++trial) {
    GeneralizedState<2> chain{
        any(random), any(random), {any(random), any(random)}, {any(random), any(random)}};
    const BodyState<8> motion{{chain.x, 0, chain.angle[0], chain.angle[1]},
                              {chain.x_rate, 0, chain.rate[0], chain.rate[1]}};
    const GeneralizedVector<2> force{any(random), {any(random), any(random)}};
    const GeneralizedVector<2> a = Chain<2>(fast, chain).accelerations(force);
    const Coordinates<8> b =
        Body(whole, motion).accelerations({force.x, any(random), force.angle[0], force.angle[1]});
    const double scale = 1 + std::abs(a.x) + std::abs(a.angle[0]) + std::abs(a.angle[1]);
    EXPECT_NEAR(a.x, b[along_track], 1e-11 * scale);
    EXPECT_NEAR(a.angle[0], b[first_link], 1e-11 * scale);
    EXPECT_NEAR(a.angle[1], b[first_link + 1], 1e-11 * scale);
    EXPECT_EQ(b[up], 0.0);
  }
}

// A leg with muscles that walks on its ground with friction everywhere, valves opened at random:
// every mechanism with every air has the same motion, to growing rounding errors.
template <class World>
class Alike : public ::testing::Test {};
using Others = ::testing::Types<BodyWorld>;
TYPED_TEST_SUITE(Alike, Others);

TYPED_TEST(Alike, MovesAsTheChainWithItsBank) {
  plant::Setup s = leg_with_muscles(4.95, 5.40);
  s.robot.ground.present = true;
  s.robot.trolley.drag = 4;
  for (robot::Joint& j : s.robot.joints) {
    j.dry_friction = 0.1;
    j.damping = 0.05;
    j.spring = 0.3;
    j.spring_angle = 5;
  }
  ChainWorld<2> fast(s);
  TypeParam other(s);
  std::mt19937 random(11);
  bool touched = false;
  for (signals::Tick t = 100; t <= 20000; t += 100) {
    const signals::Edge edge{t, {static_cast<std::uint8_t>(random() % 8)}, random() % 3 == 0};
    fast.drive(edge);
    other.drive(edge);
    const Truth a = fast.truth(t * 1e-4), b = other.truth(t * 1e-4);
    touched = touched || a.foot[0].force_y > 0;
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(a.angle[j], b.angle[j], 2e-6) << t;
    EXPECT_NEAR(a.x, b.x, 1e-6) << t;
    EXPECT_NEAR(a.foot[0].force_y, b.foot[0].force_y, 0.1) << t;
    for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(a.tension[m], b.tension[m], 2e-2) << t;
  }
  EXPECT_TRUE(touched);
}

// Behind a regulator the air pushes the body down with p A, whatever its travel: the load that the
// leg lifts is known.
TEST(BodyWorld, RegulatorPushesWithAKnownForce) {
  plant::Setup s = leg_without_muscles(1.5 * std::numbers::pi, 0);
  give_cylinder(s, robot::Cylinder::Mode::regulator);
  s.cylinder->mode = air::Cylinder::Mode::regulator;
  s.cylinder->pressure = s.air.atmosphere + 1e5;
  s.start.lift = 2 * inch;
  BodyWorld world(s);
  world.advance(0.05);
  const double mass = robot::leg_mass(s.robot) + s.robot.cylinder.body_mass;
  const double push = 1e5 * air::area(*s.cylinder, air::down);
  EXPECT_GT(push, mass * 1.0);
  EXPECT_NEAR(world.motion().at[up] - 2 * inch, -0.5 * (9.80665 + push / mass) * 0.05 * 0.05, 1e-9);
}

// Two sealed chambers are a spring k = n (P_u A_u^2/V_u + P_d A_d^2/V_d); the body oscillates on
// it.
TEST(BodyWorld, SealedCylinderIsAGasSpring) {
  plant::Setup s = leg_without_muscles(1.5 * std::numbers::pi, 0);
  give_cylinder(s, robot::Cylinder::Mode::valves);
  s.cylinder->mode = air::Cylinder::Mode::valves;
  s.air.polytropic_exponent = 1.4;
  const double mass = robot::leg_mass(s.robot) + s.robot.cylinder.body_mass;
  const double area_up = air::area(*s.cylinder, air::up);
  const double lifting = s.air.atmosphere + mass * 9.80665 / area_up;
  s.cylinder->initial_pressure = {lifting, s.air.atmosphere};
  s.start.lift = 1 * inch;
  const double stiffness =
      1.4 * (lifting * area_up * area_up / air::volume(*s.cylinder, air::up, s.start.lift) +
             s.air.atmosphere * std::pow(air::area(*s.cylinder, air::down), 2) /
                 air::volume(*s.cylinder, air::down, s.start.lift));
  const double omega = std::sqrt(stiffness / mass), rate = 0.005;

  BodyWorld world(s);
  world.set_rates({}, 0, rate);
  const double quarter = 0.5 * std::numbers::pi / omega;
  world.advance(quarter);
  const double t = world.time();
  EXPECT_NEAR(world.motion().at[up] - s.start.lift, rate / omega * std::sin(omega * t),
              0.01 * rate / omega);
}

// For any stops and valves of a cylinder the machine's state stays finite: the air that the piston
// traps against its stop grows stiff as its room vanishes, which limits the steps. The stops are
// such that the fastest piston would be halted within its dead volume.
TEST(BodyWorld, AThousandCylindersStayFinite) {
  std::mt19937 random(39);
  std::uniform_real_distribution<double> share(0, 1);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, share(random));
  };
  double deepest = 0;
  for (int k = 0; k < 1000; ++k) {
    plant::Setup s = leg_without_muscles(4.8 + share(random), 5 + share(random));
    give_cylinder(s, robot::Cylinder::Mode::valves);
    air::Cylinder& c = *s.cylinder;
    c.mode = air::Cylinder::Mode::valves;
    c.bore = s.robot.cylinder.bore = between(0.01, 0.03);
    c.rod_diameter = s.robot.cylinder.rod_diameter = c.bore * (0.1 + 0.3 * share(random));
    const double gap = between(1e-3, 1e-2);  // of the stroke beyond its ends [m]
    for (const air::Side side : {air::up, air::down}) {
      c.dead_volume[side] = gap * air::area(c, side);
      c.initial_pressure[side] = s.air.atmosphere * between(1, 8);
      c.inlet[side] = c.exhaust[side] = test_valve(between(1e-7, 2e-6));
    }
    const double mass = robot::leg_mass(s.robot) + s.robot.cylinder.body_mass, fastest = 2;
    s.robot.cylinder.stop_stiffness = mass * std::pow(fastest / gap, 2) * between(1.02, 5);
    s.robot.cylinder.stop_damping = between(0.1, 30);
    s.start.lift = c.stroke * share(random);

    BodyWorld world(s);
    world.set_rates({}, 0, fastest * (2 * share(random) - 1));
    for (signals::Tick t = 0; t < 400; t += 100) {
      world.drive({t, {static_cast<std::uint8_t>(random() % 4)}, random() % 2 == 0});
      world.advance(1e-4 * static_cast<double>(t + 100));
      deepest = std::max(deepest, -world.motion().at[up] / gap);
    }
    ASSERT_FALSE(world.failure()) << "machine " << k << " at " << world.failure().time << " s";
    ASSERT_TRUE(std::isfinite(world.motion().at[up] + world.motion().rate[up]));
  }
  EXPECT_GT(deepest, 0.6);  // some come close to the end of the dead volume
}

// Without trolley and ground the whole leg falls with its body as one mass.
TEST(BodyWorld, LiftedMassFallsFreely) {
  plant::Setup s = leg_without_muscles(1.5 * std::numbers::pi, 0.4);
  give_cylinder(s, robot::Cylinder::Mode::regulator);
  s.cylinder->mode = air::Cylinder::Mode::regulator;
  s.cylinder->pressure = s.air.atmosphere;
  s.start.lift = 2 * inch;
  BodyWorld world(s);
  world.advance(0.08);
  EXPECT_NEAR(world.motion().at[up] - 2 * inch, -0.5 * 9.80665 * 0.08 * 0.08, 1e-9);
}

// A body on its ankle, on a shoe with heel and toe: each carries its share by the levers.
TEST(BodyWorld, ShoeStandsOnHeelAndToe) {
  plant::Setup s = chain_setup(1);
  give_cylinder(s, robot::Cylinder::Mode::regulator);
  s.cylinder->mode = air::Cylinder::Mode::regulator;
  s.cylinder->pressure = s.air.atmosphere + 2e5;
  s.robot.trolley.present = false;
  s.start.joint_angle = {0};
  s.start.lift = 1 * inch;
  s.robot.ground = {
      .present = true, .height = 0.5 * inch, .normal_stiffness = 5e4, .normal_damping = 300};
  s.robot.foot = {.present = true, .mass = 0, .radius = 0, .friction = 0};
  const double heel = 0.03, toe = 0.09;
  s.robot.foot.points = {{"heel", -heel, -0.01, 0.004}, {"toe", toe, -0.01, 0.004}};
  BodyWorld world(s);
  const Truth truth = world.truth(4.0);

  const robot::Link& link = s.robot.links[0];
  const double weight =
      (link.mass + s.robot.cylinder.body_mass) * 9.80665 + 2e5 * air::area(*s.cylinder, air::down);
  EXPECT_NEAR(truth.foot[0].force_y, weight, 1e-6 * weight);
  EXPECT_NEAR(truth.disc_force[0] + truth.disc_force[1], weight, 1e-6 * weight);
  const double balance = truth.disc_force[1] * toe - truth.disc_force[0] * heel;
  // Tolerance: the tilt by which heel and toe sink.
  EXPECT_NEAR(balance, link.mass * 9.80665 * link.center_of_mass, 1e-3 * weight * heel);
}

// A foot link at a held ankle equals the leg's fixed foot, on its ground and with its friction, to
// the effect of the shorter steps of the light link.
TEST(BodyWorld, HeldAnkleIsAFixedFoot) {
  plant::Setup fixed = leg_with_muscles(4.95, 5.40);
  fixed.robot.ground.present = true;
  fixed.robot.trolley.drag = 4;
  for (robot::Joint& j : fixed.robot.joints) j.dry_friction = 0.1;
  plant::Setup ankle = fixed;
  ankle.robot.links.push_back({"foot", 0.05, fixed.robot.foot.mass, 0, 1e-6});
  robot::Joint joint;
  joint.name = "ankle";
  joint.kind = robot::Joint::Kind::passive;
  ankle.robot.joints.push_back(joint);
  ankle.start.joint_angle.push_back(1.5);
  ankle.start.blocked.push_back(true);
  ankle.robot.foot.mass = 0;
  ankle.robot.foot.points = {{"sole", 0, 0, fixed.robot.foot.radius}};

  BodyWorld a(fixed), b(ankle);
  bool touched = false;
  for (signals::Tick t = 100; t <= 6000; t += 100) {
    const auto valve = static_cast<std::uint8_t>((t / 100 * 5) % 8);
    a.drive({t, {valve}, t % 300 == 0});
    b.drive({t, {valve}, t % 300 == 0});
    const Truth p = a.truth(t * 1e-4), q = b.truth(t * 1e-4);
    touched = touched || p.foot[0].force_y > 0;
    EXPECT_NEAR(p.angle[0], q.angle[0], 1e-3) << t;
    EXPECT_NEAR(p.angle[1], q.angle[1], 1e-3) << t;
    EXPECT_NEAR(p.x, q.x, 1e-4) << t;
  }
  EXPECT_TRUE(touched);
}

// A damper far too strong for the body step: the decay is still exponential, v = v0 exp(-c t/I).
TEST(BodyWorld, StrongDamperIsStable) {
  plant::Setup s = chain_setup(1);
  s.robot.trolley.present = false;
  s.robot.foot.present = false;
  s.robot.gravity = 0;
  const robot::Link& link = s.robot.links[0];
  const double inertia = link.inertia + link.mass * link.center_of_mass * link.center_of_mass;
  s.robot.joints[0].damper = 8000 * inertia;  // decays in 0.125 ms
  BodyWorld world(s);
  world.set_rates({1.0}, 0, 0);
  world.advance(0.01);
  EXPECT_NEAR(world.motion().at[first_link] - 0.6, 1.0 / 8000, 1e-6);
}

// Virtual work: the tendon's tension times the change of its length per angle is the torque, for
// any cam and for muscles across two joints.
TEST(MuscleRouting, TorqueIsTheSlopeOfLength) {
  plant::Setup s = leg_with_muscles(4.95, 5.40);
  robot::Muscle& m = s.robot.muscles[1];
  m.cam.angle = {4.2, 4.8, 5.5};
  m.cam.radii = {0.02, 0.03, 0.015};
  m.second = {"knee", robot::Muscle::Role::flexor, {}};
  m.second.cam.radius = 0.018;
  const MuscleRouting routing(s.robot);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> hip(4.0, 5.8), knee(5.0, 6.0);
  for (int trial = 0; trial < 100; ++trial) {
    const double angle[2] = {hip(random), knee(random)}, still[2] = {0, 0};
    air::Lanes<most_muscles> length, rate, ahead, behind;
    MuscleRouting::MomentArms<most_muscles> pulls, other;
    routing.at(angle, still, length, rate, pulls);
    const double h = 1e-6;
    for (int k = 0; k < 2; ++k) {
      double a[2] = {angle[0], angle[1]}, b[2] = {angle[0], angle[1]};
      a[k] += h;
      b[k] -= h;
      routing.at(a, still, ahead, rate, other);
      routing.at(b, still, behind, rate, other);
      EXPECT_NEAR(-(ahead[1] - behind[1]) / (2 * h), pulls[1][static_cast<std::size_t>(k)], 1e-7);
    }
  }
  EXPECT_EQ(routing.joint(1, 1), 1);
  EXPECT_EQ(routing.joint(0, 1), -1);
}

// A passive joint with a spring alone: the pendulum's period with k + m g r in place of m g r.
TEST(BodyWorld, SpringAtAJointIsAPendulumInNoGravity) {
  plant::Setup s = chain_setup(1);
  s.robot.trolley.present = false;
  s.robot.foot.present = false;
  s.robot.gravity = 0;
  s.robot.joints[0].spring = 2.0;
  s.robot.joints[0].spring_angle = 1.0;
  s.start.joint_angle = {1.1};
  const robot::Link& link = s.robot.links[0];
  const double inertia = link.inertia + link.mass * link.center_of_mass * link.center_of_mass;
  BodyWorld world(s);
  world.advance(0.5);
  EXPECT_NEAR(world.motion().at[first_link], 1.0 + 0.1 * std::cos(std::sqrt(2.0 / inertia) * 0.5),
              1e-5);
}

// A trolley that breaks away at 6 N and rolls on against 1: it rests while 6 N hold it, then moves
// like a world that starts there; both worlds agree.
TEST(BodyWorld, TrolleyBreaksAway) {
  plant::Setup s = leg_without_muscles(0, 0);  // straight, it swings down
  s.robot.trolley.drag = 1;
  s.robot.trolley.breakaway = 6;
  plant::Setup loose = s;
  loose.robot.trolley.breakaway = 0;
  ChainWorld<2> fast(s);
  BodyWorld whole(s), rolls(loose);
  double rested = 0, rolled = 0;
  for (int k = 1; k <= 900; ++k) {
    const Truth a = fast.truth(k * 1e-3), b = whole.truth(k * 1e-3), c = rolls.truth(k * 1e-3);
    EXPECT_NEAR(a.x, b.x, 1e-7) << k;
    if (std::abs(b.x) < 1e-5) rested = k * 1e-3;
    if (std::abs(c.x) < 1e-5) rolled = k * 1e-3;
  }
  EXPECT_GT(rested, rolled + 0.03);
  EXPECT_GT(std::abs(whole.motion().at[along_track]), 1e-3);
}

// At rest the rollers carry the weight, and the counterweight loads the roller above it.
TEST(BodyWorld, RollersCarryTheWeight) {
  plant::Setup s = leg_without_muscles(1.5 * std::numbers::pi, 0);
  for (auto&& blocked : s.start.blocked) blocked = true;
  s.robot.trolley.drag = 4;
  s.robot.rollers = {.present = true,
                     .front = 0.1,
                     .rear = -0.1,
                     .counterweight = 10 * pound,
                     .counterweight_at = 0.1};
  const Truth whole = BodyWorld(s).truth(0), fast = ChainWorld<2>(s).truth(0);
  const double weight = 23.8 * pound * 9.80665;
  EXPECT_NEAR(whole.roller_front + whole.roller_rear, weight, 1e-6);
  EXPECT_NEAR(whole.roller_front - whole.roller_rear, 10 * pound * 9.80665, 1e-6);
  EXPECT_NEAR(fast.roller_front, whole.roller_front, 1e-6);
}

// Muscles with creep: finally the leg hangs where stronger muscles would hold it, and the tendons
// have the same tension. A hysteresis of negligible width changes nothing.
TEST(BodyWorld, CreepEndsWhereStrongerMusclesHoldTheLeg) {
  const auto settled = [](double creep, double scale, double half_width) {
    plant::Setup s = leg_with_muscles(4.85, 5.48);
    s.start.pressure = 2e5;
    for (air::Muscle& m : s.muscles) {
      m.actuator.loss = {.viscous = 60};
      m.actuator.effectiveness.scale = scale;
      m.actuator.creep = {.share = {creep, 0}, .time = {0.2, 0}};
      m.actuator.hysteresis.half_width = half_width;
    }
    BodyWorld world(s);
    world.drive({0, {0}, true});
    world.drive({60, {0}, false});
    return world.truth(5);
  };
  const Truth late = settled(0.1, 1, 0), strong = settled(0, 1.1, 0), quick = settled(0, 1, 0),
              hair = settled(0, 1, 0.01), wide = settled(0, 1, 2e4);
  EXPECT_GT(std::abs(quick.angle[0] - strong.angle[0]), 1e-3);
  EXPECT_GT(std::abs(quick.angle[0] - wide.angle[0]), 1e-3);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(late.angle[j], strong.angle[j], 1e-5);
    EXPECT_NEAR(hair.angle[j], quick.angle[j], 1e-6);
  }
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(late.tension[i] / strong.tension[i], 1, 1e-4);
}

}  // namespace
}  // namespace sinew::plant::body_world_test
