#include "sinew/identify/joint/torque.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"

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
  put_recordings(data);
}

double JointTorque::torque_per_load(std::size_t row) const {
  return -setup_.gravity * setup_.lever * std::sin(angle_[row] - setup_.down);
}

void JointTorque::put_recordings(const Measured& data) {
  recording_.assign(rows(), 0.0);
  if (data.has("recording")) recording_ = data["recording"];
  recordings_ = std::max<std::size_t>(
      {setup_.recordings.size(), static_cast<std::size_t>(largest(recording_)) + 1, 1});
  if (!setup_.moving || !data.has("time")) return;
  constexpr double window = 0.04;
  time_ = data["time"];
  for (std::size_t from = 0; from < rows();) {
    std::size_t to = from;
    while (to < rows() && recording_[to] == recording_[from]) ++to;
    const std::span<const double> t(time_), q(angle_);
    const Rates rates = rates_of(t.subspan(from, to - from), q.subspan(from, to - from), window);
    rate_.insert(rate_.end(), rates.first.begin(), rates.first.end());
    from = to;
  }
}

double JointTorque::largest_torque() const {
  return std::max({largest(torque_), -smallest(torque_), 1e-9});
}

double JointTorque::fastest() const { return std::max({largest(rate_), -smallest(rate_), 1e-9}); }

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

double JointTorque::force(const actuator::Actuator& a, const Hinge& tendon, double mount, double q,
                          double pressure) const {
  const double f = actuator::clamped_tension(a, mount - tendon.shortening(q), 0,
                                             pressure - setup_.atmosphere, setup_.atmosphere);
  return std::max(f, 0.0);
}

void JointTorque::residuals(const JointLaw& law, const JointValues& v, std::span<double> r) const {
  const Hinge tendon = hinge(law, v);
  actuator::Actuator a = setup_.actuator;
  a.effectiveness = effectiveness(v);
  a.long_end.stiffness = 0;            // threads that stretch would add a scale
  std::vector<double> needed(rows());  // load torque that balances the muscles
  for (std::size_t i = 0; i < rows(); ++i) {
    const double q = sign_ * (angle_[i] - setup_.rest_angle);
    double pull = 0;
    if (has_flexor()) pull += tendon.arm(q) * force(a, tendon, v.flexor_length, q, flexor_[i]);
    if (has_extensor())
      pull -= tendon.arm(-q) * force(a, tendon, v.extensor_length, -q, extensor_[i]);
    needed[i] = -sign_ * setup_.count * pull;
    if (rate_.empty()) continue;
    const double way = rate_[i] > 0 ? 1 : rate_[i] < 0 ? -1 : 0;
    needed[i] += v.friction * way + v.damping * rate_[i];
  }
  for (std::size_t from = 0; from < rows();) {
    std::size_t to = from;
    while (to < rows() && recording_[to] == recording_[from]) ++to;
    const std::span<double> part = std::span(needed).subspan(from, to - from);
    if (v.delay != 0 && !time_.empty()) {
      const std::vector<double> before(part.begin(), part.end());
      delayed(std::span(time_).subspan(from, part.size()), before, v.delay, part);
    }
    const auto k = static_cast<std::size_t>(recording_[from]);
    const double gain = k < v.gain.size() ? v.gain[k] : 1;
    for (double& x : part) x *= gain;
    const double bias = bias_of(v, from, to, k, needed);
    for (std::size_t i = from; i < to; ++i) r[i] = torque_[i] - bias - needed[i];
    from = to;
  }
}

// Returns the bias; that of a recording that was not fitted is the mean of its residuals.
double JointTorque::bias_of(const JointValues& v, std::size_t from, std::size_t to,
                            std::size_t recording, std::span<const double> needed) const {
  if (recording < v.bias.size()) return v.bias[recording];
  if (!setup_.torque_bias) return 0;
  double sum = 0;
  for (std::size_t i = from; i < to; ++i) sum += torque_[i] - needed[i];
  return sum / static_cast<double>(to - from);
}

void JointTorque::warn_of_ends(const JointLaw& law, const JointValues& v,
                               std::vector<std::string>& warnings) const {
  const Hinge tendon = hinge(law, v);
  double most = 0, least = unbounded;
  for (const double angle : angle_) {
    const double q = sign_ * (angle - setup_.rest_angle);
    for (const bool flexor : {true, false}) {
      if (flexor ? !has_flexor() : !has_extensor()) continue;
      const double length =
          (flexor ? v.flexor_length : v.extensor_length) - tendon.shortening(flexor ? q : -q);
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
