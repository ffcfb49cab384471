// tests/six_legs.h - the largest machine: six legs of four joints on one trolley, 24 joints, 48
// muscles and 96 valves on three boards, each with the same channels, ticks and bits. It has never
// been built: hip and knee are the thesis's, ankle and toe are like the knee, weaker and lighter.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace sinew::test {

inline constexpr const char* six_legs_names[] = {"a", "b", "c", "d", "e", "f"};

struct SixLegsJoint {
  const char *name, *link;
  double rest_deg, arm_in, length_in, mass_lb, friction_lbf_in, damping, gain;
  int count;  // number of actuators in a muscle
  bool raises;
};
inline constexpr SixLegsJoint six_legs_joints[] = {
    {"hip", "femur", 278, 1, 8.875, 1.579, 1.53, 2.07, 0.035, 2, true},
    {"knee", "tibia", 314, 1, 6.25, 0.469, 1.53, 2.07, 0.12, 2, false},
    {"ankle", "foot", 90, 0.4, 1.5, 0.15, 0.3, 0.1, 0.1, 1, true},
    {"toe", "tip", 20, 0.4, 1, 0.1, 0.3, 0.1, 0.1, 1, true},
};

// `leg` of 0 to 5: two of them share a board, the second one behind the first.
inline std::string six_legs_leg(int leg) {
  std::string out;
  const std::string name = six_legs_names[leg];
  const int place = leg % 2;
  out += fmt::format(
      "[leg.{0}]\njoints = [\"{0}_hip\", \"{0}_knee\", \"{0}_ankle\", \"{0}_toe\"]\n"
      "offset = \"{1} %\"\n",
      name, leg % 2 == 0 ? 0 : 50);
  for (int j = 0; j < 4; ++j) {
    const SixLegsJoint& joint = six_legs_joints[j];
    const std::string at =
        j == 0 ? fmt::format("parent = \"body\"\nat = \"{} in\"\n", 4 * leg) : "";
    out += fmt::format(
        "[link.{0}_{1}]\n{2}length = \"{3} in\"\nmass = \"{4} lb\"\ncenter_of_mass = \"{5} in\"\n"
        "inertia = \"{6} lb in2\"\n",
        name, joint.link, at, joint.length_in, joint.mass_lb, joint.length_in / 2,
        joint.mass_lb * joint.length_in * joint.length_in / 12);
    out += fmt::format(
        "[joint.{0}_{1}]\nrest_angle = \"{2} deg\"\nflexion = \"{3} angle\"\nmoment_arm = \"{4} "
        "in\"\ndry_friction = \"{5} lbf in\"\ndamping = \"{6} lbf in s/rad\"\nangle_gain = \"{7} "
        "%/count\"\nstiffness_gain = \"5 %/(lbf in/rad)\"\nvelocity_gain = \"0 % s/count\"\n",
        name, joint.name, joint.rest_deg, joint.raises ? "raises" : "lowers", joint.arm_in,
        joint.friction_lbf_in, joint.damping, joint.gain);
    const int sensor = 12 * place + 3 * j, muscle = 8 * place + 2 * j;
    const auto noise = [](const char* counts) {
      return fmt::format("noise = \"{} count\"", counts);
    };
    out += fmt::format(
        "[sensor.{0}_{1}_angle]\nkind = \"angle\"\nof = \"{0}_{1}\"\nchannel = {2}\ntick = {3}\n"
        "real = {{ scale = \"1.147 rad/V\", at_rest = \"1800 count\", {4} }}\n"
        "assumed = {{ scale = \"767 count/rad\", at_rest = \"1800 count\" }}\n",
        name, joint.name, sensor, 2 * sensor + 1, noise("0.5"));
    for (int side = 0; side < 2; ++side) {
      const char* role = side == 0 ? "flexor" : "extensor";
      out += fmt::format(
          "[muscle.{0}_{1}_{2}]\njoint = \"{0}_{1}\"\nrole = \"{2}\"\nactuator = \"bpa\"\ncount = "
          "{3}\nmount_length = \"3.15 in\"\nexternal_volume = \"0.166 in3\"\nbladder_stiffness = "
          "\"1.9 lbf/in\"\nbladder_rest_length = \"3.15 in\"\ninlet = {{ valve = \"inlet\", bit = "
          "{4} }}\nexhaust = {{ valve = \"exhaust\", bit = {5} }}\n",
          name, joint.name, role, joint.count, muscle + side, 16 + muscle + side);
      out += fmt::format(
          "[sensor.{0}_{1}_{2}_tension]\nkind = \"tension\"\nof = \"{0}_{1}_{2}\"\nchannel = "
          "{3}\ntick = {4}\nreal = {{ scale = \"0.17 V/lbf\", at_rest = \"0 count\", {5} }}\n"
          "assumed = {{ scale = \"0.17 V/lbf\", at_rest = \"0 count\" }}\n",
          name, joint.name, role, sensor + 1 + side, 2 * (sensor + 1 + side) + 1, noise("1"));
    }
  }
  return out;
}

inline std::string six_legs_robot(const std::string& source) {
  std::string out = fmt::format(
      R"(format = "sinew.robot/1"
name = "six-legs"
files = {{ actuator = "{0}/robots/leg/actuator.toml", valves = "{0}/robots/leg/valves.toml", valve_timing = "{0}/robots/leg/predict.dat" }}
[trolley]
present = true
total_mass = "40 lb"
drag = "1.03 lbf"
track_length = "5 ft"
stop_stiffness = "100 lbf/in"
stop_damping = "2 lbf s/in"
[foot]
present = true
mass = "0 lb"
radius = "0.5 in"
friction = 1
[foot.point.heel]
along = "-1.2 in"
across = "-0.25 in"
radius = "0.25 in"
[foot.point.toe]
along = "1 in"
across = "-0.25 in"
radius = "0.25 in"
[ground]
present = true
height = "-14 in"
normal_stiffness = "300 lbf/in"
normal_damping = "0.25 lbf s/in"
[air]
atmosphere = "14.7 psi abs"
temperature = "528 degR"
polytropic_exponent = 1.04
supply = {{ kind = "constant", pressure = "100 psi gauge" }}
[converter]
bits = 12
full_scale = "5 V"
[low_level]
pwm_ticks = 100
output_delay = 1
duty_rounding = "truncate each law"
stiffness_pole_clamp = "10 deg"
vent_time = "0.4 s"
)",
      source);
  for (int leg = 0; leg < 6; ++leg) out += six_legs_leg(leg);
  return out;
}

// Two steps by joint angles, the legs of a board in antiphase.
inline std::string six_legs_experiment() {
  std::string angles;
  for (const char* leg : six_legs_names)
    angles += fmt::format(
        "{1}{0}_hip = \"285 deg\", {0}_knee = \"300 deg\", {0}_ankle = \"90 deg\", {0}_toe = \"20 "
        "deg\"",
        leg, angles.empty() ? "" : ", ");
  return R"(format = "sinew.experiment/2"
title = "Six legs of four joints"
robot = "robot.toml"
seed = 1
[start]
pressure = "0 psi gauge"
settle = "0.6 s"
joint_angles = { )" +
         angles + R"( }
[control]
stiffness = { hip = "35 lbf in/rad", knee = "20 lbf in/rad", ankle = "3 lbf in/rad", toe = "3 lbf in/rad" }
[sequence]
phases = ["swing", "stance"]
repeat = 2
finish = "vent"
[phase.swing]
duration = "0.6 s"
joint_angles = { hip = ["270 deg", "305 deg"], knee = ["335 deg", "290 deg", "300 deg"], ankle = ["80 deg", "110 deg"], toe = ["15 deg", "40 deg"] }
[phase.stance]
duration = "0.6 s"
joint_angles = { hip = ["305 deg", "270 deg"], knee = ["300 deg", "335 deg"], ankle = ["110 deg", "80 deg"], toe = ["40 deg", "15 deg"] }
[plant_steps]
body = "1 ms"
[log]
enabled = true
channels = ["*"]
period = "10 ms"
)";
}

// Writes both files into a folder and returns the experiment's path.
inline std::string write_six_legs(const std::filesystem::path& folder, const std::string& source) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "robot.toml") << six_legs_robot(source);
  std::ofstream(folder / "experiment.toml") << six_legs_experiment();
  return (folder / "experiment.toml").string();
}

}  // namespace sinew::test
