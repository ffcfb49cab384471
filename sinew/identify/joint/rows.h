// identify/joint/rows.h - the poses of a joint, for a picture of what the models say of them.
#pragma once

#include <optional>
#include <vector>

#include "sinew/identify/data/measured.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/joint/torque.h"

namespace sinew::identify {

// What the muscles hold less the load's torque, from the sum of both as they turn the joint.
inline std::vector<double> told_from(std::vector<double> sums) {
  for (double& sum : sums) sum = -sum;
  return sums;
}

// The load's torque at every pose; what `others` has was not fitted, if it is a file of its own.
inline Rows rows_of(const Measured& data, const JointTorque& joint,
                    const std::optional<Measured>& held_out, const JointTorque& others) {
  Rows out;
  out.x = "angle";
  out.x_unit = "rad";
  out.at = data["angle"];
  out.measured = joint.torque();
  out.scattered = true;  // so are pressures
  if (!held_out) return out;
  const std::vector<double>& angle = (*held_out)["angle"];
  out.held_out.assign(out.size(), false);
  out.at.insert(out.at.end(), angle.begin(), angle.end());
  out.measured.insert(out.measured.end(), others.torque().begin(), others.torque().end());
  out.held_out.resize(out.size(), true);
  return out;
}

}  // namespace sinew::identify
