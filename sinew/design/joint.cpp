#include "sinew/design/joint.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/actuator/prediction.h"
#include "sinew/actuator/tension.h"

namespace sinew::design {

namespace {

constexpr double not_possible = std::numeric_limits<double>::quiet_NaN();

actuator::OperatingPoint point(const JointDesign& joint, double length, double gauge,
                               double atmosphere) {
  return actuator::operating_point(joint.actuator, length, gauge,
                                   {atmosphere, 1, 0});  // sealed stiffness: only for the friction
}

// The tension of the muscle that pulls is reduced by its friction, that of the opposing one is
// increased.
struct Pull {
  double tension = 0, half = 0;  // half of the 95 % interval; NaN: not_possible [N]
};
Pull pull_of(const JointDesign& joint, double length, double gauge, double atmosphere,
             double sign_of_friction) {
  const actuator::OperatingPoint p = point(joint, length, gauge, atmosphere);
  const double tension = p.tension + sign_of_friction * p.coulomb_bound;
  return {std::max(tension, 0.0), p.half_95};
}

}  // namespace

double length_at(const JointDesign& joint, Arm arm, double angle) {
  const double turned = arm == Arm::cam ? angle : std::sin(angle);
  return joint.mount_length - joint.moment_arm * turned;
}

double arm_at(const JointDesign& joint, Arm arm, double angle) {
  return arm == Arm::cam ? joint.moment_arm : joint.moment_arm * std::cos(angle);
}

Torque torque_at(const JointDesign& joint, const JointTask& task, double angle, double p,
                 double opposed, double atmosphere) {
  const double arm = joint.count * arm_at(joint, task.arm, angle);
  const Pull pulls = pull_of(joint, length_at(joint, task.arm, angle), p, atmosphere, -1);
  const Pull against = pull_of(joint, length_at(joint, task.arm, -angle), opposed, atmosphere, 1);
  // A vented muscle without tension has no interval of its own.
  const double half = against.tension > 0 && std::isfinite(against.half)
                          ? std::hypot(pulls.half, against.half)
                          : pulls.half;
  const double value = arm * (pulls.tension - against.tension);
  return {value, value - arm * half, value + arm * half};
}

Weakest weakest_torque(const JointDesign& joint, const JointTask& task, double opposed,
                       double atmosphere) {
  constexpr int steps = 8;  // the torque falls or rises over the angles, with one minimum at most
  Weakest out;
  double low = std::numeric_limits<double>::infinity();
  out.torque.value = low;
  for (int i = 0; i <= steps; ++i) {
    const double angle = task.angles * (static_cast<double>(i) / steps - 0.5);
    const Torque torque = torque_at(joint, task, angle, task.pressure, opposed, atmosphere);
    // The interval that holds at every angle: unknown where it is unknown at one of them.
    low = std::isnan(torque.low) || std::isnan(low) ? torque.low + low : std::min(low, torque.low);
    if (torque.value < out.torque.value) out = {torque, angle};
  }
  out.torque.low = low;
  if (std::isnan(low)) out.torque.high = low;
  return out;
}

Stroke stroke_of(const actuator::Actuator& a, double pressure, double atmosphere) {
  double low = actuator::shortest_length(a), high = a.long_end.length;
  if (!a.prediction.lengths.empty()) high = std::min(high, a.prediction.lengths.back());
  const double longest = high;
  const auto pulls = [&](double length) {
    return actuator::clamped_tension(a, length, 0, pressure, atmosphere) > 0;
  };
  if (pulls(low) || !pulls(high)) return {low, longest};
  for (int i = 0; i < 60; ++i) (pulls(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return {high, longest};
}

double motion_of(const JointDesign& joint, Arm arm, const Stroke& stroke) {
  const double s =
      std::min(joint.mount_length - stroke.shortest, stroke.longest - joint.mount_length);
  if (!(s > 0)) return 0;
  const double share = s / joint.moment_arm;
  return arm == Arm::cam ? 2 * share : 2 * std::asin(std::min(share, 1.0));
}

double stiffness_at_middle(const JointDesign& joint, double pressure, double atmosphere) {
  const actuator::OperatingPoint p = point(joint, joint.mount_length, pressure, atmosphere);
  const double one = p.stiffness_at_constant_pressure + p.passive_stiffness;
  return 2 * joint.count * joint.moment_arm * joint.moment_arm * one;
}

double air_of_stroke(const JointDesign& joint, const JointTask& task, const gas::Air& air) {
  const auto mass = [&](double gauge, double angle) {
    const double volume =
        joint.count * actuator::volume(joint.actuator, length_at(joint, task.arm, angle)) +
        task.external_volume;
    return (gauge + air.atmosphere) * volume / (air.gas_constant * air.temperature);
  };
  return mass(task.pressure, task.angles / 2) - mass(0, -task.angles / 2);
}

double co_contraction_left(const JointDesign& joint, const JointTask& task, double atmosphere) {
  const auto does = [&](double opposed) {
    return weakest_torque(joint, task, opposed, atmosphere).torque.value >= task.torque;
  };
  if (!does(0)) return not_possible;
  if (does(task.pressure)) return task.pressure;
  double low = 0, high = task.pressure;
  for (int i = 0; i < 40; ++i) (does(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

double best_mount_length(const JointDesign& joint, const JointTask& task, const Stroke& stroke,
                         double atmosphere) {
  const double half = std::max(task.motion, task.angles) / 2;
  const double way =
      joint.moment_arm * (task.arm == Arm::cam ? half : std::sin(std::min(half, 1.5)));
  const double from = stroke.shortest + way, to = stroke.longest - way;
  if (!(from <= to)) return not_possible;
  constexpr int steps = 16;
  JointDesign tried = joint;
  double best = not_possible, most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    tried.mount_length = from + (to - from) * i / steps;
    const double torque = weakest_torque(tried, task, 0, atmosphere).torque.value;
    if (torque > most) most = torque, best = tried.mount_length;
  }
  return best;
}

}  // namespace sinew::design
