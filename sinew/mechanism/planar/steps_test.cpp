// The body step: it suits a machine's fastest rate in every pose.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "sinew/mechanism/planar/friction_contacts.h"
#include "sinew/mechanism/planar/test_setups.h"
#include "sinew/world/machine.h"

namespace sinew::plant::steps_test {
namespace {

// Adds a light shoe whose heel and toe are from very near to a hand's breadth from the ankle.
Setup on_a_shoe(Setup s, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  robot::Link shoe{"shoe", 0.03, 0.02 + 0.1 * share(random), 0.01, 0};
  shoe.inertia = shoe.mass * 1e-4 * (1 + 3 * share(random));
  s.robot.links.push_back(shoe);
  robot::Joint ankle;
  ankle.name = "ankle";
  ankle.kind = robot::Joint::Kind::passive;
  s.robot.joints.push_back(ankle);
  s.start.joint_angle.push_back(6.2 * share(random));
  s.start.blocked.push_back(false);
  s.robot.foot.mass = 0;
  s.robot.foot.points = {{"heel", -0.05 * share(random), -0.01, 0.005},
                         {"toe", 0.05 * share(random), -0.01, 0.005}};
  return s;
}

Setup leg_on_a_shoe(std::mt19937& random) {
  Setup s = leg_without_muscles(4.95, 5.40);
  s.robot.ground.present = true;
  return on_a_shoe(std::move(s), random);
}

TEST(Steps, SuitEveryPose) {
  using Contacts = FrictionContacts<3, 2>;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  int divided = 0, relaxed = 0;
  for (int machine = 0; machine < 40; ++machine) {
    const plant::Setup s = leg_on_a_shoe(random);
    const BodyMechanism<3, 2, 4> mechanism(s);
    const Contacts contacts(mechanism.constants(), s.robot);
    const double step = mechanism.node_step(s);
    FastestRates fastest;
    BodyState<3> m = mechanism.start();
    for (int pose = 0; pose < 2000; ++pose) {
      const Body<3> body(mechanism.constants(), m);
      fastest.include(contacts.fastest_rates(body, m, s.robot, muscle_damping(s)));
      for (std::size_t j = 0; j < 3; ++j) m.at[first_link + j] = turn(random);
    }
    EXPECT_LT(step * fastest.ground_damper, Contacts::stable_explicit) << machine;
    const double longest = step * static_cast<double>(mechanism.most_steps_on_ground());
    EXPECT_LT(longest * fastest.joints, Contacts::stable_explicit) << machine;
    EXPECT_LT(longest * fastest.ground_spring, Contacts::stable_explicit) << machine;
    EXPECT_LT(longest * fastest.ground_damper, Contacts::stable_relaxed) << machine;
    divided += step < s.steps.body;
    relaxed += longest > step;
  }
  EXPECT_GT(divided, 10);
  EXPECT_GT(relaxed, 5);
}

// A leg falls against the viscous loss of its muscles, which act only while they lengthen. For the
// last two values RK4 in undivided steps is unstable.
TEST(Steps, SuitTheLossesOfMuscles) {
  std::mt19937 random(5);
  for (const bool shoe : {false, true}) {
    for (const double viscous : {10.0, 1e3, 3e3, 1e4, 1e5}) {
      plant::Setup s = leg_with_muscles(5.6, 4.9);
      if (shoe) s = on_a_shoe(s, random);
      for (air::Muscle& m : s.muscles)
        m.actuator.loss.viscous = viscous, m.actuator.loss.coulomb_length = 0;
      plant::Setup fine = s;
      fine.steps.body = 5e-6;
      const Truth a = Machine(s).truth(0.2), b = Machine(fine).truth(0.2);
      for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(a.angle[j], b.angle[j], 1e-3) << viscous;
    }
  }
}

// A plank hinged at one end, with the disc at its other end pressed into the ground; RK4 with the
// ground's damper relaxed or not. The acceleration is that of BodyMechanism without the absent
// parts.
class Plank {
 public:
  explicit Plank(double damping) {
    robot::Robot r;
    r.links = {{"plank", 0.2, 0.1, 0.1, 4e-4}};
    robot::Joint hinge;
    hinge.name = "hinge";
    r.joints = {hinge};
    r.foot = {.present = true, .radius = 0.01};
    r.ground = {.present = true,
                .height = -0.001,
                .normal_stiffness = stiffness,
                .normal_damping = damping};
    body_ = body_of<1>(r);
    contacts_.emplace(body_, r);
    rate_ = contacts_->fastest_rates(Body<1>(body_, start()), start(), r, std::array{0.0})
                .ground_damper;
  }

  void relax() { contacts_->relax_beyond(0); }
  double damper_rate() const { return rate_; }  // [1/s]

  // It moves down through the angle at which the spring carries it, so the disc is always pressed.
  static BodyState<1> start() {
    BodyState<1> m;
    m.at[first_link] = -0.0099;
    m.rate[first_link] = -0.01;
    return m;
  }

  BodyState<1> after(double time, int steps) {
    BodyState<1> m = start();
    const double h = time / steps;
    for (int k = 0; k < steps; ++k) m = step(m, h);
    return m;
  }

 private:
  static constexpr double stiffness = 500;  // [N/m]
  using Contacts = FrictionContacts<1, 1>;

  Coordinates<1> acceleration(const BodyState<1>& m, Contacts::Pose& pose, double& push) const {
    contacts_->place(m, pose);
    push = contacts_->push(pose.depth[0], pose.contact[0], m);
    Coordinates<1> force{};
    for (std::size_t c = 0; c < force.size(); ++c) force[c] = push * pose.contact[0].rise[c];
    return pose.accelerations(force);
  }

  BodyState<1> step(const BodyState<1>& from, double h) {
    BodyState<1> stage = from;
    std::array<BodyState<1>, 4> at{};
    std::array<Coordinates<1>, 4> a{};
    for (std::size_t s = 0; s < 4; ++s) {
      Contacts::Pose pose(body_, stage);
      double push = 0;
      a[s] = acceleration(stage, pose, push);
      EXPECT_GT(push, 0);
      if (s == 0)
        contacts_->prepare(pose, stage, a[0], {}, {push});
      else
        contacts_->relax(h, 0.2, {push}, a[s - 1], a[s]);
      at[s] = stage;
      const double part = s == 2 ? h : 0.5 * h;
      for (std::size_t c = 0; c < 3; ++c) {
        stage.at[c] = from.at[c] + part * at[s].rate[c];
        stage.rate[c] = from.rate[c] + part * a[s][c];
      }
    }
    BodyState<1> out = from;
    for (std::size_t c = 0; c < 3; ++c) {
      out.at[c] += h / 6 * (at[0].rate[c] + 2 * at[1].rate[c] + 2 * at[2].rate[c] + at[3].rate[c]);
      out.rate[c] += h / 6 * (a[0][c] + 2 * a[1][c] + 2 * a[2][c] + a[3][c]);
    }
    return out;
  }

  BodyConstants<1> body_;
  std::optional<Contacts> contacts_;
  double rate_ = 0;
};

TEST(Steps, WithTheGroundsDamperRelaxedAreOfSecondOrderAndOtherwiseOfFourth) {
  const auto order = [](bool relaxed) {
    Plank plank(40);
    if (relaxed) plank.relax();
    const double time = 0.008;
    const double limit = plank.after(time, 4096).rate[first_link];
    const auto error = [&](int steps) {
      return std::abs(plank.after(time, steps).rate[first_link] - limit);
    };
    return std::log2(error(32) / error(64));
  };
  EXPECT_NEAR(order(true), 2, 0.3);
  EXPECT_NEAR(order(false), 4, 0.3);
}

// The damper's rate times the step goes from the limit of RK4 to that of the relaxed rule.
TEST(Steps, WithTheGroundsDamperRelaxedAreStable) {
  for (const double product : {2.0, 3.0, 4.0, 4.5, 7.0}) {
    Plank plank(40);
    plank.relax();
    const double h = product / plank.damper_rate();
    const double first = std::abs(plank.start().rate[first_link]);
    const double of_spring = 0.05 * first;  // it slowly returns the plank
    const auto rate = [&](int steps) {
      return std::abs(plank.after(steps * h, steps).rate[first_link]);
    };
    EXPECT_LT(rate(1), (product <= 4.5 ? 0.1 : 0.8) * first + of_spring) << product;
    EXPECT_LT(rate(20), 0.01 * first + of_spring) << product;
  }
}

// Nodes are left out only if no disc touches or leaves the ground before the next one: all
// coordinates continue at their rates.
TEST(Steps, AreLongWhereNoContactChanges) {
  using Contacts = FrictionContacts<3, 2>;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi), size(-1, 1);
  int in_air = 0, near = 0, pressed = 0, short_on_ground = 0;
  for (int machine = 0; machine < 20; ++machine) {
    plant::Setup s = leg_on_a_shoe(random);
    const BodyMechanism<3, 2, 4> mechanism(s);
    const Contacts contacts(mechanism.constants(), s.robot);
    const auto depths = [&](const BodyState<3>& m) {
      std::vector<double> out;
      for (int i = 0; i < contacts.discs(); ++i)
        out.push_back(contacts.depth(Body<3>(mechanism.constants(), m), m, i));
      return out;
    };
    const double step = mechanism.node_step(s);
    for (int pose = 0; pose < 500; ++pose) {
      BodyState<3> m = mechanism.start();
      const double fast = pose % 2 == 0 ? 1 : 0.01;
      for (std::size_t j = 0; j < 3; ++j) {
        m.at[first_link + j] = turn(random);
        m.rate[first_link + j] = 12 * fast * size(random);
      }
      m.rate[up] = fast * size(random);
      const std::int64_t next = mechanism.next_multiple(2, step, mechanism.pose(0, m), m);
      ASSERT_GE(next, 3);
      const std::vector<double> now = depths(m);
      const double deepest = *std::max_element(now.begin(), now.end());
      if (next == 3) {
        short_on_ground += deepest > 0;
        continue;
      }
      EXPECT_LE(static_cast<double>(next - 2) * step, s.steps.body * (1 + 1e-9));
      in_air += deepest < 0;
      near += deepest < 0 && deepest > -0.01;
      pressed += deepest > 0;
      for (int part = 1; part <= 10; ++part) {
        BodyState<3> later = m;
        for (std::size_t c = 0; c < 5; ++c)
          later.at[c] += 0.1 * part * static_cast<double>(next - 2) * step * m.rate[c];
        const std::vector<double> then = depths(later);
        for (std::size_t i = 0; i < now.size(); ++i) EXPECT_EQ(then[i] > 0, now[i] > 0) << machine;
      }
    }
  }
  EXPECT_GT(in_air, 500);
  EXPECT_GT(near, 5);
  EXPECT_GT(pressed, 200);
  EXPECT_GT(short_on_ground, 50);
}

}  // namespace
}  // namespace sinew::plant::steps_test
