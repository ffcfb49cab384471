#include "sinew/control/setup/estimators.h"

#include <cmath>

#include "sinew/units/math.h"

namespace sinew::control {
namespace {

using Asked = robot::Velocity::Estimator;

Estimator estimator(Asked from) {
  switch (from) {
    case Asked::weighted_average:
      return Estimator::weighted_average;
    case Asked::bounded_observer:
      return Estimator::bounded_observer;
    case Asked::kalman:
      return Estimator::kalman;
    case Asked::sensor:
      return Estimator::sensor;
    case Asked::difference:
      break;
  }
  return Estimator::difference;
}

void set_weights(const robot::Velocity& from, double rate, VelocityConfig& out) {
  out.samples = static_cast<std::uint8_t>(from.samples);
  out.weight = line_weights(out.samples, static_cast<float>(rate));
  for (std::size_t i = 0; i < from.weights.size() && i < out.weight.size(); ++i)
    out.weight[i] = static_cast<float>(from.weights[i]);
}

// Sets the model in counts: of the angle per radian, and per count of tension.
void set_model(const robot::Velocity& from, double counts_per_rad, double torque_per_count,
               double rate, VelocityConfig& out) {
  const JointMotion motion = joint_motion(from.inertia, from.damping, 1.0 / rate);
  out.decay = static_cast<float>(motion.decay);
  out.travel = static_cast<float>(motion.travel);
  if (from.tensions) {
    const double acceleration = torque_per_count * counts_per_rad / from.inertia;
    out.speed_gain = static_cast<float>(motion.travel * acceleration);
    out.travel_gain = static_cast<float>(motion.travel_gain * acceleration);
  }
  out.margin = static_cast<float>(from.acceleration * motion.travel * counts_per_rad);
  if (from.speed_limit > 0) out.limit = static_cast<float>(from.speed_limit * counts_per_rad);

  if (from.estimator != Asked::kalman) return;
  const SteadyState steady = steady_state(motion, from.acceleration * counts_per_rad,
                                          std::sqrt(from.noise * from.noise + 1.0 / 12.0));
  out.angle_share = static_cast<float>(steady.angle_share);
  out.speed_share = static_cast<float>(steady.speed_share);
}

}  // namespace

JointMotion joint_motion(double inertia, double damping, double period) {
  const double k = inertia > 0 ? damping / inertia : 0.0;
  const double x = k * period;
  if (x < 1e-4)  // series, since the differences below lose digits
    return {1 - x * (1 - 0.5 * x), period * (1 - 0.5 * x), period * period * (0.5 - x / 6)};
  const double decay = units::exp(-x), travel = (1 - decay) / k;
  return {decay, travel, (period - travel) / k};
}

SteadyState steady_state(const JointMotion& m, double acceleration, double noise) {
  const double q = acceleration * acceleration, r = noise * noise;
  const double q11 = m.travel_gain * m.travel_gain * q, q12 = m.travel_gain * m.travel * q,
               q22 = m.travel * m.travel * q;
  SteadyState s;
  double p11 = r, p12 = 0, p22 = 2 * r / (m.travel * m.travel);
  for (int i = 0; i < 1'000'000; ++i) {
    const double a11 = p11 + 2 * m.travel * p12 + m.travel * m.travel * p22 + q11;
    const double a12 = m.decay * (p12 + m.travel * p22) + q12;
    const double a22 = m.decay * m.decay * p22 + q22;
    const double k1 = a11 / (a11 + r), k2 = a12 / (a11 + r);
    const double next = a22 - k2 * a12;
    const bool steady = std::abs(next - p22) <= 1e-13 * next;
    p11 = (1 - k1) * a11, p12 = (1 - k1) * a12, p22 = next;
    s = {k1, k2, {p11, p12, p22}};
    if (steady && i > 10) break;
  }
  return s;
}

VelocityConfig velocity_config(const robot::Robot& robot, int joint, double torque_per_count,
                               double rate) {
  const robot::Velocity& from = robot.joints[static_cast<std::size_t>(joint)].velocity;
  const auto sensor = [&](int index) -> const robot::Sensor& {
    return robot.sensors[static_cast<std::size_t>(index)];
  };
  const double counts_per_rad = sensor(robot::angle_sensor_of(robot, joint)).assumed_scale;

  VelocityConfig out;
  out.estimator = estimator(from.estimator);
  if (from.estimator == Asked::weighted_average) set_weights(from, rate, out);
  if (from.estimator == Asked::bounded_observer || from.estimator == Asked::kalman)
    set_model(from, counts_per_rad, torque_per_count, rate, out);
  if (from.estimator == Asked::sensor) {
    const int index = robot::velocity_sensor_of(robot, joint);
    const robot::Sensor& s = sensor(index);
    out.channel = {static_cast<std::uint8_t>(index)};
    out.at_rest = static_cast<std::int32_t>(std::lround(s.assumed_at_rest));
    out.scale =
        static_cast<float>(counts_per_rad / (robot.converter.counts_per_volt() * s.assumed_scale));
  }
  return out;
}

}  // namespace sinew::control
