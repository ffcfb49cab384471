#include "sinew/identify/joint/torque.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/fit/least_squares.h"

namespace sinew::identify {

JointTorque::JointTorque(const Measured& data, const JointSetup& setup)
    : setup_(setup), angle_(data["angle"]) {
  sign_ = setup.flexion_raises ? 1 : -1;
  if (data.has("flexor_pressure")) flexor_ = data["flexor_pressure"];
  if (data.has("extensor_pressure")) extensor_ = data["extensor_pressure"];
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const double lever = (data.has("load") ? data["load"][i] : setup.load) * setup.lever +
                         setup.limb * setup.limb_lever;
    torque_.push_back(data.has("torque")
                          ? data["torque"][i]
                          : -setup.gravity * lever * std::sin(angle_[i] - setup.down));
  }
}

double JointTorque::highest_gauge() const {
  return std::max(largest(flexor_), largest(extensor_)) - setup_.atmosphere;
}

Hinge JointTorque::hinge(const JointLaw& law, const JointValues& v) {
  return law.hinge ? Hinge::points(v.moment_arm, v.origin_ratio, v.origin_angle)
                   : Hinge::round(v.moment_arm);
}

actuator::Effectiveness JointTorque::effectiveness(const JointValues& v) const {
  if (setup_.keep_force) return setup_.actuator.effectiveness;
  actuator::Effectiveness out{.c0 = v.c0, .c1 = v.c1};
  out.valid_to = std::max(highest_gauge(), 1.0);
  return out;
}

double JointTorque::force(const actuator::Actuator& a, const Hinge& cord, double mount, double q,
                          double pressure) const {
  const double f = actuator::tension(a, mount - cord.shortening(q), 0, pressure - setup_.atmosphere,
                                     setup_.atmosphere);
  return std::max(f, 0.0);
}

void JointTorque::residuals(const JointLaw& law, const JointValues& v, std::span<double> r) const {
  const Hinge cord = hinge(law, v);
  actuator::Actuator a = setup_.actuator;
  a.effectiveness = effectiveness(v);
  a.long_end.stiffness = 0;  // threads that stretch have a scale of their own, not these torques'
  for (std::size_t i = 0; i < rows(); ++i) {
    const double q = sign_ * (angle_[i] - setup_.rest_angle);
    double pull = 0;
    if (has_flexor()) pull += cord.arm(q) * force(a, cord, v.flexor_length, q, flexor_[i]);
    if (has_extensor()) pull -= cord.arm(-q) * force(a, cord, v.extensor_length, -q, extensor_[i]);
    r[i] = torque_[i] + sign_ * setup_.count * pull;
  }
}

void JointTorque::warn_of_ends(const JointLaw& law, const JointValues& v,
                               std::vector<std::string>& warnings) const {
  const Hinge cord = hinge(law, v);
  double most = 0, least = unbounded;
  for (const double angle : angle_) {
    const double q = sign_ * (angle - setup_.rest_angle);
    for (const bool flexor : {true, false}) {
      if (flexor ? !has_flexor() : !has_extensor()) continue;
      const double length =
          (flexor ? v.flexor_length : v.extensor_length) - cord.shortening(flexor ? q : -q);
      most = std::max(most, length);
      least = std::min(least, length);
    }
  }
  const actuator::Actuator& a = setup_.actuator;
  if (most > a.long_end.length || least < actuator::shortest_length(a.braid))
    warnings.push_back(fmt::format(
        "lengths from {:.4g} to {:.4g} m: beyond the ends at {:.4g} and {:.4g} m the law of the "
        "braid does not hold",
        least, most, actuator::shortest_length(a.braid), a.long_end.length));
}

}  // namespace sinew::identify
