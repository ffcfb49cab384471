// design/settings.fields.h - settings of every design calculation: a struct of texts as users write
// them, and its rows (config/setting_rows.h). An empty quantity is not given.
#pragma once

#include <numbers>
#include <string>

#include "sinew/config/setting_rows.h"

namespace sinew::design {

using config::Setting;

constexpr config::Range part_length = config::above_zero(10, "of a part of a robot");

// --- joint ---

// Muscles, moment arm and mount length of a joint with an antagonistic pair.
struct JointSettings {
  std::string actuator, name, rest_length;
  std::string torque, load, lever, time;
  std::string angles, motion;
  std::string pressure, arm = "cam", moment_arm;
  int most = 4;
  std::string external_volume = "0 m3";
  std::string base, joint;
};

template <class Visitor>
void fields(Visitor& v, JointSettings& s) {
  constexpr config::Range turn =
      config::above_zero(2 * std::numbers::pi, "a joint turns less than once");
  v.method({"joint", "Choose number, length and moment arm of the muscles of a joint",
            config::Tables::none});
  v.file(Setting{"actuator", "actuator file of the muscle"}.required(), s.actuator);
  v.text({"name", "name of the actuator, where the file has several"}, s.name);
  v.text({"rest_length",
          "QUANTITY: rest length, or from:to:step of a family: the file's muscle is scaled; "
          "default: the file's own"},
         s.rest_length);
  v.quantity({"torque", "torque in both directions, at each of the angles", "N m",
              config::above_zero(1e5, "of a joint")},
             s.torque);
  v.quantity({"load", "mass at the lever, in place of the torque: its weight at a horizontal lever",
              "kg", config::above_zero(1e4, "on a joint")},
             s.load);
  v.quantity({"lever", "distance from the joint to the load", "m", part_length}, s.lever);
  v.quantity({"time",
              "time of a stroke over the angles: adds the torque that speeds up the load and "
              "slows it down",
              "s", config::above_zero(3600, "of a stroke")},
             s.time);
  v.quantity(
      Setting{"angles", "range of angles over which the torque is needed", "rad", turn}.required(),
      s.angles);
  v.quantity({"motion", "range of motion without a load; default: the angles", "rad", turn},
             s.motion);
  v.quantity(Setting{"pressure", "highest pressure in a muscle", "Pa gauge",
                     config::above_zero(config::greatest_pressure, config::air_pressure.why)}
                 .required(),
             s.pressure);
  v.choice({"arm", "moment arm: a round cam, or a lever that a straight muscle pulls"}, s.arm,
           {"cam", "lever"});
  v.text({"moment_arm",
          "QUANTITY: radius of the cam or length of the lever, or from:to:step; default: twelve "
          "that allow the motion"},
         s.moment_arm);
  v.integer({"most", "largest number of muscles side by side", "", {1, 100, "side by side"}},
            s.most);
  v.quantity(
      {"external_volume", "volume of hose and fittings of one muscle", "m3", config::air_volume},
      s.external_volume);
  v.file({"base", "robot file with this joint, base of the robot file that is written"}, s.base);
  v.text(Setting{"joint", "name of the joint in that file"}.in_python("joint_name"), s.joint);
}

}  // namespace sinew::design
