// identify/task/joint_task.h - `sinew identify joint`: force law and moment arm of a joint's
// muscles, without a length rig.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "sinew/identify/joint/joint.h"
#include "sinew/identify/joint/joint_file.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them. Of empty quantities a column has the values, or they
// are fitted.
struct JointSettings {
  std::string actuator, name;
  int count = 1;
  JointNames names{.flexor = "", .extensor = ""};
  std::string rest_angle = "0 rad", load, lever = "0 m", down = "270 deg";
  std::string limb = "0 kg", limb_lever = "0 m";
  std::string moment_arm, flexor_length, extensor_length;
  bool keep_force = false, torque_bias = false, torque_gain = false, moving = false;
  HeldOut hold_out;
  std::string model, base;
  WishTexts wishes;
  host::Tally* tried = nullptr;  // counts models that have been tried; null: nothing
};

// What hangs on the joint, and where.
template <class Visitor>
void load_fields(Visitor& v, JointSettings& s) {
  constexpr double turns = 4 * std::numbers::pi;
  constexpr config::Range angle{-turns, turns, "two turns; a joint makes less than one"};
  constexpr config::Range mass = config::from_zero(1e6, "of what hangs on a joint");
  constexpr config::Range lever = config::from_zero(1000, "from the joint's axis");
  v.quantity({.name = "rest_angle",
              .unit = "rad",
              .range = angle,
              .doc = "of the joint, at which the muscles' lengths are given"},
             s.rest_angle);
  v.quantity({.name = "load",
              .unit = "kg",
              .range = mass,
              .doc = "mass at the lever, where no column torque or load has it"},
             s.load);
  v.quantity({.name = "lever", .unit = "m", .range = lever, .doc = "from the joint to the load"},
             s.lever);
  v.quantity({.name = "down",
              .unit = "rad",
              .range = angle,
              .doc = "angle at which the lever points straight down"},
             s.down);
  v.quantity({.name = "limb", .unit = "kg", .range = mass, .doc = "mass of the limb itself"},
             s.limb);
  v.quantity({.name = "limb_lever",
              .unit = "m",
              .range = lever,
              .doc = "from the joint to the limb's center of mass"},
             s.limb_lever);
}

// What is known of the muscles, and what of the torque is to be found.
template <class Visitor>
void known_fields(Visitor& v, JointSettings& s) {
  constexpr config::Range size = config::above_zero(1000, "of a robot");
  const std::string_view known = "is known, at the rest angle";
  v.quantity({.name = "moment_arm", .unit = "m", .range = size, .doc = known}, s.moment_arm);
  v.quantity({.name = "flexor_length", .unit = "m", .range = size, .doc = known}, s.flexor_length);
  v.quantity({.name = "extensor_length", .unit = "m", .range = size, .doc = known},
             s.extensor_length);
  v.flag({.name = "keep_force", .doc = "the effectiveness of the actuator's file is right"},
         s.keep_force);
  v.flag({.name = "torque_bias",
          .doc = "the torque of each file has a zero of its own, which is to be found"},
         s.torque_bias);
  v.flag({.name = "torque_gain",
          .doc = "and a gain in that of the first file; where the force is kept the first has one, "
                 "too"},
         s.torque_gain);
  v.flag({.name = "moving",
          .doc = "the joint moves, over a column time: its dry friction and damping, and how far "
                 "the torque comes behind"},
         s.moving);
}

template <class Visitor>
void fields(Visitor& v, JointSettings& s) {
  v.method({.name = "joint",
            .doc = "force law and moment arm from joint angle, pressures and a known load",
            .laws = joint_models().size()});
  v.file({.name = "actuator", .doc = "file with the braid; a start", .required = true}, s.actuator);
  v.text({.name = "name", .doc = "which actuator, where the file has several"}, s.name);
  v.integer({.name = "count",
             .range = {1, 100, "actuators in parallel"},
             .doc = "actuators in parallel in a muscle"},
            s.count);
  v.choice({.name = "flexion",
            .doc = "what a shorter flexor does to the angle",
            .words = {"raises angle", "lowers angle"}},
           s.names.flexion);
  load_fields(v, s);
  known_fields(v, s);
  v.hold_out({.name = "hold_out",
              .doc = "a file that scores the models and is not fitted; absent: every third row"},
             s.hold_out);
  v.choice({.name = "model", .doc = "only this one", .words = joint_models()}, s.model);
  v.text({.name = "joint", .doc = "its name in the robot's file", .keyword = "joint_name"},
         s.names.joint);
  v.text({.name = "flexor", .doc = "the muscle's name; absent: <joint>_flexor"}, s.names.flexor);
  v.text({.name = "extensor", .doc = "the muscle's name; absent: <joint>_extensor"},
         s.names.extensor);
  v.file({.name = "base",
          .doc = "robot whose joint it is, named in the file that is written",
          .of_file = true},
         s.base);
  fields(v, s.wishes);
}

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

// Throws config::Error and Refusal.
JointFound find_joint(const std::vector<Source>& sources, const JointSettings& settings);

// Returns the report with moment arm, lengths and what the data determine, as `--json` prints it.
Json to_json(const JointFound& found);

}  // namespace sinew::identify
