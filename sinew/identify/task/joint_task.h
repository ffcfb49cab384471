// identify/task/joint_task.h - `sinew identify joint`: force law and moment arm of a joint's
// muscles, without a length rig.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/joint/joint.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Names of the joint and its muscles in the robot's file.
struct JointNames {
  std::string joint = "joint", flexor = "joint_flexor", extensor = "joint_extensor";
  std::string flexion = "raises angle";  // or "lowers angle": what a shorter flexor does
};

// Empty quantities are not known: a column has them, or they are fitted.
struct JointSettings {
  std::string actuator;                            // file with the braid: a start
  std::string name;                                // which actuator, where the file has several
  int count = 1;                                   // actuators in parallel in a muscle
  JointNames names{.flexor = "", .extensor = ""};  // empty: <joint>_flexor, <joint>_extensor
  std::string rest_angle = "0 rad";                // at which the muscles' lengths are told
  std::string load, lever = "0 m";                 // a mass, and how far from the joint it hangs
  std::string down = "270 deg";                    // angle at which the lever points straight down
  std::string limb = "0 kg", limb_lever = "0 m";   // the limb's own mass and where it is
  std::string moment_arm, flexor_length, extensor_length;  // known, at the rest angle
  bool torque_bias = false;  // each table's torque has a zero of its own, to be found
  bool torque_gain = false;  // and a gain, of the first table's where the force is kept only
  bool moving = false;       // over time: dry friction, damping and the torque's delay as well
  bool keep_force = false;   // the effectiveness of the actuator's file is right
  std::optional<Source> held_out;  // scores the models; else every third row
  std::string model;               // this one alone; empty: all
  WishTexts wishes;                // frozen, tied, prior
  std::string base;                // the robot's file whose joint it is; empty: none
  host::Tally* tried = nullptr;    // counts models that have been tried; null: nothing
};

// Holds what was found, with the files of robot and actuator.
struct JointFound {
  JointResult result;
  JointSetup setup;
  JointNames names;
  std::string base, source;
  std::string actuator_file;  // with the effectiveness

  // The robot's file, as it would stand at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// Throws config::Error and Refusal; std::invalid_argument for a model that there is not.
JointFound find_joint(const std::vector<Source>& sources, const JointSettings& settings);

// Returns the report with moment arm, lengths and what the data tell apart, as `--json` prints it.
Json to_json(const JointFound& found);

}  // namespace sinew::identify
