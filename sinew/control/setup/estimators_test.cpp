// Tests the estimators' constants: the joint's motion, the Riccati equation, and the speed of
// simulated joints.
#include "sinew/control/setup/estimators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

namespace sinew::control::estimators_test {
namespace {

constexpr double period = 0.01;

// Integrates J theta'' = 1 - D theta', from rest or from speed 1, in many small steps.
struct Small {
  double angle = 0, speed = 0;
  Small(double inertia, double damping, double push, double start) : speed(start) {
    constexpr int n = 200'000;
    const double h = period / n;
    for (int i = 0; i < n; ++i) {
      const double a = (push - damping * speed) / inertia;
      angle += h * (speed + 0.5 * h * a);
      speed += h * a * (1 - 0.5 * h * damping / inertia);
    }
  }
};

TEST(JointMotion, IsTheEquationOfMotionOverAPeriod) {
  for (const double damping : {0.0, 1e-6, 0.2, 3.0}) {
    constexpr double inertia = 0.02;
    const JointMotion m = joint_motion(inertia, damping, period);
    const Small coasting(inertia, damping, 0, 1), pushed(inertia, damping, 1, 0);
    EXPECT_NEAR(coasting.speed, m.decay, 1e-8);
    EXPECT_NEAR(coasting.angle, m.travel, 1e-10);
    EXPECT_NEAR(pushed.speed, m.travel / inertia, 1e-6);
    EXPECT_NEAR(pushed.angle, m.travel_gain / inertia, 1e-8);
  }
}

// One more period of the Riccati equation changes nothing, and the covariance is valid.
TEST(Kalman, SharesAreThoseOfTheSteadyState) {
  for (const double damping : {0.0, 0.1, 1.0})
    for (const double acceleration : {1e2, 1e4, 1e6}) {
      const JointMotion m = joint_motion(0.02, damping, period);
      const double r = 0.6 * 0.6, q = acceleration * acceleration;
      const SteadyState s = steady_state(m, acceleration, 0.6);
      const auto [p11, p12, p22] = s.covariance;
      const double a11 =
          p11 + 2 * m.travel * p12 + m.travel * m.travel * p22 + m.travel_gain * m.travel_gain * q;
      const double a12 = m.decay * (p12 + m.travel * p22) + m.travel_gain * m.travel * q;
      const double a22 = m.decay * m.decay * p22 + m.travel * m.travel * q;
      EXPECT_NEAR(s.angle_share, a11 / (a11 + r), 1e-9);
      EXPECT_NEAR(s.speed_share, a12 / (a11 + r), 1e-9 * s.speed_share);
      EXPECT_NEAR(p22, a22 - s.speed_share * a12, 1e-9 * p22);
      EXPECT_GT(p11 * p22 - p12 * p12, 0);
      EXPECT_LT(p11, r);
    }
}

// A joint with a constant known torque and a random one that changes every period, read in counts.
struct Simulated {
  double mean = 0, variance = 0;  // of estimated minus true speed
  double difference_variance = 0;
};

Simulated simulate(double damping, double unknown, int periods) {
  constexpr double inertia = 0.02, counts_per_rad = 767, torque_per_count = 0.002;
  const JointMotion m = joint_motion(inertia, damping, period);
  const double gain = torque_per_count * counts_per_rad / inertia;
  const SteadyState s = steady_state(m, unknown, std::sqrt(0.25 + 1.0 / 12));
  VelocityConfig config{.estimator = Estimator::kalman,
                        .decay = static_cast<float>(m.decay),
                        .speed_gain = static_cast<float>(m.travel * gain),
                        .travel = static_cast<float>(m.travel),
                        .travel_gain = static_cast<float>(m.travel_gain * gain),
                        .angle_share = static_cast<float>(s.angle_share),
                        .speed_share = static_cast<float>(s.speed_share)};
  std::mt19937 random(7);
  std::normal_distribution<double> unit(0, 1);
  VelocityState kalman, difference;
  Simulated out;
  double angle = 0, speed = 0, squares = 0, difference_squares = 0;
  constexpr int settle = 500;
  for (int i = 0; i < periods; ++i) {
    const double push = 30 * std::sin(0.02 * i), next_push = 30 * std::sin(0.02 * (i + 1));
    const double a = 0.5 * (push + next_push) * gain + unknown * unit(random);
    angle += m.travel * speed + m.travel_gain * a;
    speed = m.decay * speed + m.travel * a;
    const auto counts = static_cast<std::int32_t>(std::lround(angle + 0.5 * unit(random)));
    const Motion now{.angle = counts, .push = static_cast<float>(next_push), .rate = 100};
    const double e = static_cast<double>(estimate(config, kalman, now)) - speed;
    const double d = static_cast<double>(estimate({}, difference, now)) - speed;
    if (i < settle) continue;
    out.mean += e, squares += e * e, difference_squares += d * d;
  }
  const double n = periods - settle;
  out.mean /= n;
  out.variance = squares / n;
  out.difference_variance = difference_squares / n;
  return out;
}

TEST(Kalman, FindsTheSpeedOfASimulatedJointAsTheRiccatiEquationPredicts) {
  for (const double unknown : {2e3, 2e4}) {
    const double damping = 0.4;  // keeps the angle within the resolution of a float
    const Simulated s = simulate(damping, unknown, 200'000);
    const double expected =
        steady_state(joint_motion(0.02, damping, period), unknown, std::sqrt(0.25 + 1.0 / 12))
            .covariance[2];
    EXPECT_NEAR(s.variance, expected, 0.04 * expected) << unknown;
    EXPECT_LT(std::abs(s.mean), 0.02 * std::sqrt(expected));
    EXPECT_LT(s.variance, s.difference_variance);
  }
}

}  // namespace
}  // namespace sinew::control::estimators_test
