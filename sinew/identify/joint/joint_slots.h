// identify/joint/joint_slots.h - which values of a joint are parameters under a model, and from
// where they start.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sinew/identify/fit/least_squares.h"
#include "sinew/identify/joint/joint.h"
#include "sinew/identify/joint/torque.h"

namespace sinew::identify {

// Returns the value that a parameter is.
using JointPlace = std::function<double&(JointValues&)>;

// A parameter that is searched, and where its value belongs.
struct JointSlot {
  Parameter parameter;
  JointPlace place;
};

// Returns the parameters of the model; what the setup knows is none.
std::vector<JointSlot> joint_slots(const JointLaw& law, const JointTorque& joint,
                                   const JointSetup& setup);

// Returns what the setup knows, and the values with these parameters.
JointValues joint_known(const JointTorque& joint, const JointSetup& setup);
JointValues joint_with(JointValues v, const std::vector<JointSlot>& slots,
                       std::span<const double> p);

// Returns starts of the parameters: short and long arms, short and long muscles.
std::vector<std::vector<double>> joint_starts(const std::vector<JointSlot>& slots,
                                              const JointTorque& joint, const JointSetup& setup);

}  // namespace sinew::identify
