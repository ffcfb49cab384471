// robot/check.cpp - what cannot be in a robot, whatever the ranges of its single values say.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sinew/robot/robot.h"

namespace sinew::robot {
namespace {

using List = std::vector<Contradiction>;

template <class Items>
std::string names(const Items& items) {
  std::string all;
  for (const auto& item : items) all += (all.empty() ? "" : ", ") + item.name;
  return all.empty() ? "none" : all;
}

template <class Items>
void check_names(const Items& items, const std::string& table, List& out) {
  std::set<std::string> seen;
  for (const auto& item : items)
    if (item.name.empty() || !seen.insert(item.name).second)
      out.push_back({table + "." + item.name, "the name \"" + item.name + "\" twice, or none",
                     "a name of its own", "another name"});
}

void check_sizes(const Robot& robot, List& out) {
  const auto links = robot.links.size(), joints = robot.joints.size();
  if (links != joints)
    out.push_back({"joint",
                   std::to_string(joints) + " joints and " + std::to_string(links) + " links",
                   "one joint per link", "link k hangs at joint k, in the order of the file"});
  if (joints == 0 || joints > static_cast<std::size_t>(max_joints))
    out.push_back({"joint", std::to_string(joints) + " joints",
                   "1 to " + std::to_string(max_joints), "a smaller robot"});
  check_names(robot.links, "link", out);
  check_names(robot.joints, "joint", out);
  check_names(robot.muscles, "muscle", out);
  check_names(robot.sensors, "sensor", out);
}

// Each joint has its pair, each muscle a joint and an inlet.
void check_pairs(const Robot& robot, List& out) {
  for (const Muscle& muscle : robot.muscles) {
    const std::string key = "muscle." + muscle.name;
    if (find_joint(robot, muscle.joint) < 0)
      out.push_back(
          {key + ".joint", "\"" + muscle.joint + "\"", "a joint", "one of " + names(robot.joints)});
    if (muscle.inlet.empty())
      out.push_back({key + ".inlet", "no valve", "the name of a valve", "inlet = { valve = … }"});
  }
  for (const Joint& joint : robot.joints)
    for (const auto role : {Muscle::Role::flexor, Muscle::Role::extensor}) {
      const auto count =
          std::count_if(robot.muscles.begin(), robot.muscles.end(),
                        [&](const Muscle& m) { return m.joint == joint.name && m.role == role; });
      const std::string word = role == Muscle::Role::flexor ? "flexor" : "extensor";
      if (count != 1)
        out.push_back({"joint." + joint.name, std::to_string(count) + " muscles as " + word, "one",
                       "actuators in parallel are one muscle with a larger count"});
    }
}

void check_bits(const Robot& robot, List& out) {
  std::map<int, std::string> used;
  const auto take = [&](int bit, const std::string& key) {
    const auto [at, fresh] = used.emplace(bit, key);
    if (!fresh)
      out.push_back({key, "bit " + std::to_string(bit), "a bit of its own",
                     "another one; " + at->second + " has it"});
  };
  for (const Muscle& muscle : robot.muscles) {
    take(muscle.inlet_bit, "muscle." + muscle.name + ".inlet.bit");
    if (!muscle.exhaust.empty()) take(muscle.exhaust_bit, "muscle." + muscle.name + ".exhaust.bit");
  }
}

void check_sensor(const Robot& robot, const Sensor& sensor, List& out) {
  const std::string key = "sensor." + sensor.name;
  const bool angle = sensor.kind == Sensor::Kind::angle;
  const bool tension = sensor.kind == Sensor::Kind::tension;

  if (angle && find_joint(robot, sensor.of) < 0)
    out.push_back(
        {key + ".of", "\"" + sensor.of + "\"", "a joint", "one of " + names(robot.joints)});
  if (tension && find_muscle(robot, sensor.of) < 0)
    out.push_back(
        {key + ".of", "\"" + sensor.of + "\"", "a muscle", "one of " + names(robot.muscles)});
  if ((angle || tension) && (sensor.scale == 0 || sensor.assumed_scale == 0))
    out.push_back({key + (sensor.scale == 0 ? ".real.scale" : ".assumed.scale"), "0", "a scale",
                   "what the sensor gives for one radian or newton"});

  const double top = robot.converter.top();
  for (const auto& [word, rest] : {std::pair{".real.at_rest", sensor.at_rest},
                                   std::pair{".assumed.at_rest", sensor.assumed_at_rest}})
    if (rest > top)
      out.push_back({key + word, std::to_string(std::lround(rest)) + " count",
                     "at most " + std::to_string(robot.converter.top()), "a count it can give"});
}

// One converter reads one channel after the other: the result of one before the start of the next.
void check_scan(const Robot& robot, List& out) {
  int previous = 0;
  std::set<int> channels;
  for (const Sensor& sensor : robot.sensors) {
    const std::string key = "sensor." + sensor.name;
    if (sensor.tick <= previous || sensor.tick >= robot.low_level.pwm_ticks)
      out.push_back({key + ".tick", std::to_string(sensor.tick),
                     "more than the sensor before has (" + std::to_string(previous) +
                         "), less than pwm_ticks (" + std::to_string(robot.low_level.pwm_ticks) +
                         ")",
                     "sensors in ascending order of tick"});
    if (!channels.insert(sensor.channel).second)
      out.push_back({key + ".channel", std::to_string(sensor.channel), "a channel of its own",
                     "another one"});
    check_sensor(robot, sensor, out);
    previous = sensor.tick;
  }
}

void check_coverage(const Robot& robot, List& out) {
  const auto count = [&](Sensor::Kind kind, const std::string& of) {
    return std::count_if(robot.sensors.begin(), robot.sensors.end(),
                         [&](const Sensor& s) { return s.kind == kind && s.of == of; });
  };
  const auto need_one = [&](Sensor::Kind kind, const std::string& of, const std::string& key,
                            const std::string& word) {
    const auto n = count(kind, of);
    if (n == 1) return;
    out.push_back({key, std::to_string(n) + " sensors of its " + word, "one",
                   "[sensor.…] with kind = \"" + word + "\", of = \"" + of + "\""});
  };
  for (const Joint& joint : robot.joints)
    need_one(Sensor::Kind::angle, joint.name, "joint." + joint.name, "angle");
  for (const Muscle& muscle : robot.muscles)
    need_one(Sensor::Kind::tension, muscle.name, "muscle." + muscle.name, "tension");
}

void check_masses(const Robot& robot, List& out) {
  if (robot.trolley.present && trolley_own_mass(robot) <= 0)
    out.push_back({"trolley.total_mass", std::to_string(robot.trolley.total_mass) + " kg",
                   "more than links and foot together, " + std::to_string(leg_mass(robot)) + " kg",
                   "the mass of all that moves along the track"});
  if (robot.ground.present && !robot.foot.present)
    out.push_back({"ground.present", "true", "a foot to stand on it",
                   "[foot] with present = true, or ground.present = false"});
  for (const Link& link : robot.links)
    if (link.mass <= 0 || link.inertia <= 0)
      out.push_back({"link." + link.name, "no mass or no inertia", "both above 0",
                     "a uniform rod has m l^2/12"});
}

}  // namespace

std::vector<Contradiction> contradictions(const Robot& robot) {
  List out;
  check_sizes(robot, out);
  check_pairs(robot, out);
  check_bits(robot, out);
  check_scan(robot, out);
  check_coverage(robot, out);
  check_masses(robot, out);
  return out;
}

}  // namespace sinew::robot
