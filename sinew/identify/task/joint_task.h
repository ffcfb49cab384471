// identify/task/joint_task.h - `sinew identify joint`: force law and moment arm of a joint's
// muscles, without a length rig.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "sinew/identify/joint/joint.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Names of the joint and its muscles in the robot's file.
struct JointNames {
  std::string joint = "joint", flexor = "joint_flexor", extensor = "joint_extensor";
  std::string flexion = "raises angle";  // or "lowers angle": what a shorter flexor does
};

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
  v.quantity({"rest_angle", "of the joint, at which the muscles' lengths are given", "rad", angle},
             s.rest_angle);
  v.quantity({"load", "mass at the lever, where no column torque or load has it", "kg", mass},
             s.load);
  v.quantity({"lever", "from the joint to the load", "m", lever}, s.lever);
  v.quantity({"down", "angle at which the lever points straight down", "rad", angle}, s.down);
  v.quantity({"limb", "mass of the limb itself", "kg", mass}, s.limb);
  v.quantity({"limb_lever", "from the joint to the limb's center of mass", "m", lever},
             s.limb_lever);
}

// What is known of the muscles, and what of the torque is to be found.
template <class Visitor>
void known_fields(Visitor& v, JointSettings& s) {
  constexpr config::Range size = config::above_zero(1000, "of a robot");
  const std::string_view known = "is known, at the rest angle";
  v.quantity({"moment_arm", known, "m", size}, s.moment_arm);
  v.quantity({"flexor_length", known, "m", size}, s.flexor_length);
  v.quantity({"extensor_length", known, "m", size}, s.extensor_length);
  v.flag({"keep_force", "the effectiveness of the actuator's file is right"}, s.keep_force);
  v.flag({"torque_bias", "the torque of each file has a zero of its own, which is to be found"},
         s.torque_bias);
  v.flag({"torque_gain",
          "and a gain in that of the first file; where the force is kept the first has one, too"},
         s.torque_gain);
  v.flag({"moving",
          "the joint moves, over a column time: its dry friction and damping, and how far the "
          "torque comes behind"},
         s.moving);
}

template <class Visitor>
void fields(Visitor& v, JointSettings& s) {
  v.method({"joint", "force law and moment arm from joint angle, pressures and a known load",
            Tables::needed, joint_models().size()});
  v.file(Setting{"actuator", "file with the braid; a start"}.required(), s.actuator);
  v.text({"name", "which actuator, where the file has several"}, s.name);
  v.integer({"count", "actuators in parallel in a muscle", "", {1, 100, "actuators in parallel"}},
            s.count);
  v.choice({"flexion", "what a shorter flexor does to the angle"}, s.names.flexion,
           {"raises angle", "lowers angle"});
  load_fields(v, s);
  known_fields(v, s);
  v.hold_out(
      {"hold_out", "a file that scores the models and is not fitted; absent: every third row"},
      s.hold_out);
  v.choice({"model", "only this one"}, s.model, joint_models());
  v.text(Setting{"joint", "its name in the robot's file"}.in_python("joint_name"), s.names.joint);
  v.text({"flexor", "the muscle's name; absent: <joint>_flexor"}, s.names.flexor);
  v.text({"extensor", "the muscle's name; absent: <joint>_extensor"}, s.names.extensor);
  v.file(Setting{"base", "robot whose joint it is, named in the file that is written"}.of_file(),
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
