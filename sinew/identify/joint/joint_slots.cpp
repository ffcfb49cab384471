#include "sinew/identify/joint/joint_slots.h"

#include <algorithm>
#include <cmath>

#include "sinew/actuator/braid.h"

namespace sinew::identify {

namespace {

// What moves and what the torque's sensors add: of the first recording no gain, unless the force is
// known.
void add_sensors(const JointTorque& joint, const JointSetup& setup, std::vector<JointSlot>& out) {
  const double most = joint.largest_torque();
  const auto add = [&](std::string name, const char* unit, double low, double high, double scale,
                       JointPlace place) {
    out.push_back(
        {{.name = std::move(name), .unit = unit, .low = low, .high = high, .scale = scale},
         std::move(place)});
  };
  if (setup.moving) {
    add("friction", "N m", 0, 10 * most, 0.1 * most, &JointValues::friction);
    add("damping", "N m s/rad", 0, 1e3 * most / joint.fastest(), 0.1 * most / joint.fastest(),
        &JointValues::damping);
    add("delay", "s", -0.2, 0.2, 0.05, &JointValues::delay);
  }
  for (std::size_t k = 0; k < joint.recordings(); ++k) {
    const std::string of =
        k < setup.recordings.size() && joint.recordings() > 1 ? " of " + setup.recordings[k] : "";
    if (setup.torque_bias)
      add("torque_bias" + of, "N m", -most, most, 0.1 * most,
          [k](JointValues& v) -> double& { return v.bias[k]; });
    if (setup.torque_gain && (k > 0 || setup.keep_force))
      add("torque_gain" + of, "1", 0.1, 10, 0.1,
          [k](JointValues& v) -> double& { return v.gain[k]; });
  }
}

}  // namespace

std::vector<JointSlot> joint_slots(const JointLaw& law, const JointTorque& joint,
                                   const JointSetup& setup) {
  const double longest = setup.actuator.braid.thread_length;
  const double shortest = actuator::shortest_length(setup.actuator.braid);
  std::vector<JointSlot> out;
  const auto add = [&](bool wanted, const char* name, const char* unit, double low, double high,
                       double scale, JointPlace place) {
    if (wanted)
      out.push_back(
          {{.name = name, .unit = unit, .low = low, .high = high, .scale = scale}, place});
  };
  const auto unknown = [](double known) { return !std::isfinite(known); };
  add(unknown(setup.moment_arm), "moment_arm", "m", 1e-4, 2 * longest, 0.1 * longest,
      &JointValues::moment_arm);
  add(law.hinge, "origin_ratio", "1", 1.02, 100, 1, &JointValues::origin_ratio);
  add(law.hinge, "origin_angle", "rad", 0.05, 3.1, 1, &JointValues::origin_angle);
  add(joint.has_flexor() && unknown(setup.flexor_length), "flexor_length", "m", 0.5 * shortest,
      1.5 * longest, 0.1 * longest, &JointValues::flexor_length);
  add(joint.has_extensor() && unknown(setup.extensor_length), "extensor_length", "m",
      0.5 * shortest, 1.5 * longest, 0.1 * longest, &JointValues::extensor_length);
  add(!setup.keep_force, "c0", "1", 0.01, 10, 0.5, &JointValues::c0);
  add(!setup.keep_force && law.pressure, "c1", "1/Pa", -1e-5, 1e-5,
      0.5 / std::max(joint.highest_gauge(), 1e4), &JointValues::c1);
  add_sensors(joint, setup, out);
  return out;
}

JointValues joint_known(const JointTorque& joint, const JointSetup& setup) {
  JointValues v;
  v.bias.assign(joint.recordings(), 0.0);
  v.gain.assign(joint.recordings(), 1.0);
  if (std::isfinite(setup.moment_arm)) v.moment_arm = setup.moment_arm;
  if (std::isfinite(setup.flexor_length)) v.flexor_length = setup.flexor_length;
  if (std::isfinite(setup.extensor_length)) v.extensor_length = setup.extensor_length;
  return v;
}

JointValues joint_with(JointValues v, const std::vector<JointSlot>& slots,
                       std::span<const double> p) {
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i].place(v) = p[i];
  return v;
}

// Short and long arms, short and long muscles.
std::vector<std::vector<double>> joint_starts(const std::vector<JointSlot>& slots,
                                              const JointTorque& joint, const JointSetup& setup) {
  const double longest = setup.actuator.long_end.length > 0 ? setup.actuator.long_end.length
                                                            : setup.actuator.braid.thread_length;
  std::vector<std::vector<double>> out;
  for (const double arm : {0.1, 0.25, 0.6})
    for (const double mount : {0.8, 0.95}) {
      JointValues v{.moment_arm = arm * longest,
                    .origin_ratio = 4,
                    .origin_angle = 1.5,
                    .flexor_length = mount * longest,
                    .extensor_length = mount * longest,
                    .c0 = 0.9};
      v.friction = 0.05 * joint.largest_torque();
      v.bias.assign(joint.recordings(), 0.0);
      v.gain.assign(joint.recordings(), 1.0);
      std::vector<double> p;
      for (const JointSlot& s : slots) p.push_back(s.place(v));
      out.push_back(std::move(p));
    }
  return out;
}

}  // namespace sinew::identify
