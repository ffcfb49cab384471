// identify/joint/joint_file.h - what a joint's data tell as parameter files, and for programs.
#pragma once

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/config/node.h"
#include "sinew/config/origin.h"
#include "sinew/identify/joint/joint.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Names of the joint and its muscles in the robot's file.
struct JointNames {
  std::string joint = "joint", flexor = "joint_flexor", extensor = "joint_extensor";
  std::string flexion = "raises angle";  // or "lowers angle": what a shorter flexor does
};

// Returns the text of a robot's file: `robot`, the beginning of one (robot_over.h), with the tables
// of the joint and its muscles. `source` says where they come from.
std::string joint_file(const JointResult& found, const JointSetup& setup, const JointNames& names,
                       const std::string& source, config::Node robot);

// Returns the text of the actuator's file with the effectiveness that was found, unless
// `keep_force`. `start` are the origins of the actuator's values in `start_file`.
std::string effectiveness_file(const config::Origins& start, const std::string& start_file,
                               actuator::Actuator actuator, const JointResult& found,
                               bool keep_force, const std::string& source);

// Returns moment arm, lengths and what the data tell apart; SI, with the unit in the key.
Json describe(const JointResult& found);

}  // namespace sinew::identify
