// robot/check.cpp - contradictions within a robot, beyond the ranges of its single values.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sinew/robot/boards.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"

namespace sinew::robot {

namespace {

// --- a part of contradictions(robot): the tree of links, and the legs ---

using List = std::vector<Contradiction>;

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

template <class Names>
std::string listed(const Names& names) {
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + std::string(name);
  return all.empty() ? "none" : all;
}

bool belongs(const std::string& leg, const std::string& name) {
  return name_in_leg(leg, name) != name;
}

bool in_a_leg(const Robot& robot, int link) { return leg_of_joint(robot, link) >= 0; }

// Checks that a leg's joints exist, have names that begin with the leg's, and form a path from the
// body, or from a link of no leg, outwards.
void check_path(const Robot& robot, const Leg& leg, List& out) {
  const std::string key = "leg." + leg.name + ".joints";
  if (leg.joints.empty())
    out.push_back({key, "no joints", "its joints from the body outwards",
                   "joints = [" + quoted(leg.name + "_hip") + "]"});
  int before = -1;
  for (const std::string& name : leg.joints) {
    const int j = find_joint(robot, name);
    if (j < 0) {
      out.push_back({key, quoted(name), "a joint", "a table [joint." + name + "]"});
      return;
    }
    if (!belongs(leg.name, name))
      out.push_back({key, quoted(name), "a name that begins with " + quoted(leg.name + "_"),
                     quoted(leg.name + "_" + name)});
    const auto at = static_cast<std::size_t>(j);
    const int parent = at < robot.links.size() ? parent_of(robot, at) : before;
    const bool hangs = before >= 0 ? parent == before : parent < 0 || !in_a_leg(robot, parent);
    if (!hangs)
      out.push_back({"link." + robot.links[at].name + ".parent",
                     robot.links[at].parent.empty() ? "none" : quoted(robot.links[at].parent),
                     before < 0
                         ? "body, or a link of no leg: its joint is leg " + leg.name + "'s first"
                         : "the link before it in leg " + leg.name,
                     before < 0 ? "parent = \"body\"" : ""});
    before = j;
  }
}

void check_membership(const Robot& robot, List& out) {
  for (const Joint& joint : robot.joints) {
    std::vector<std::string> of;
    for (const Leg& leg : robot.legs)
      for (const std::string& name : leg.joints)
        if (name == joint.name) of.push_back(leg.name);
    if (of.size() == 1 || (of.empty() && joint.kind == Joint::Kind::passive)) continue;
    out.push_back({"joint." + joint.name, of.empty() ? "in no leg" : "in legs " + listed(of),
                   "one leg that it belongs to", "its name in the joints of a [leg.<name>]"});
  }
  for (std::size_t m = 0; m < robot.muscles.size(); ++m) {
    const Muscle& muscle = robot.muscles[m];
    const int joint = find_joint(robot, muscle.joint);
    if (joint < 0) continue;  // reported already
    const int leg = leg_of_joint(robot, joint);
    if (leg < 0) continue;
    const std::string& name = robot.legs[static_cast<std::size_t>(leg)].name;
    if (!belongs(name, muscle.name))
      out.push_back({"muscle." + muscle.name, quoted(muscle.name),
                     "a name that begins with " + quoted(name + "_"),
                     "[muscle." + name + "_" + muscle.name + "]"});
    const int second = find_joint(robot, muscle.second.joint);
    if (second >= 0 && leg_of_joint(robot, second) != leg)
      out.push_back({"muscle." + muscle.name + ".second.joint", quoted(muscle.second.joint),
                     "a joint of the same leg", ""});
  }
}

bool equal(const Gains& a, const Gains& b) {
  return a.angle == b.angle && a.stiffness == b.stiffness && a.velocity == b.velocity;
}

// Checks that all legs have the same part names, since one plan uses these names for all legs.
void check_likeness(const Robot& robot, List& out) {
  const Robot first = only_leg(robot, 0);
  const auto names = [](const Robot& r) {
    std::vector<std::string> all;
    for (const Joint& j : r.joints) all.push_back(j.name);
    return all;
  };
  for (std::size_t l = 1; l < robot.legs.size(); ++l) {
    const Robot other = only_leg(robot, l);
    const std::string& name = robot.legs[l].name;
    if (names(other) != names(first)) {
      out.push_back({"leg." + name + ".joints", listed(names(other)) + " within the leg",
                     listed(names(first)) + ", as leg " + robot.legs[0].name + " has them",
                     "the same names in the same order of [joint.…]"});
      continue;
    }
    for (std::size_t j = 0; j < first.joints.size(); ++j) {
      const Joint &a = first.joints[j], &b = other.joints[j];
      if (a.kind != b.kind || a.enabled != b.enabled || !equal(a.gains, b.gains))
        out.push_back({"joint." + name + "_" + b.name, "another kind, switch or gain",
                       "those of " + robot.legs[0].name + "_" + a.name,
                       "the plan's [control.gains], which hold for both"});
    }
  }
}

void check_discs(const Robot& robot, List& out) {
  const int discs = discs_of(robot);
  if (discs > max_discs)
    out.push_back({"foot.point", std::to_string(discs) + " discs on all feet",
                   "at most " + std::to_string(max_discs), "fewer points per foot"});
}

// Returns the advice for a leg that is too large: a tree can be several legs, a single chain
// cannot.
const char* advice_for_large_leg(const Robot& robot) {
  std::set<int> parents;
  for (std::size_t i = 0; i < robot.links.size(); ++i) parents.insert(parent_of(robot, i));
  const bool branches = parents.size() < robot.links.size();
  return robot.legs.empty() && branches ? "several legs, [leg.<name>] with joints = [...]"
                                        : "fewer of them: links that hardly move as one link";
}

// Checks the size of each leg, since one gait controller drives a whole leg.
void check_leg_sizes(const Robot& robot, List& out) {
  for (const LegParts& leg : legs_of(robot)) {
    const std::string of = leg.name.empty() ? " in one leg" : " in leg " + leg.name;
    const std::string key = leg.name.empty() ? "leg" : "leg." + leg.name + ".joints";
    if (leg.joints.size() > static_cast<std::size_t>(max_leg_joints))
      out.push_back({key, std::to_string(leg.joints.size()) + " joints" + of,
                     "at most " + std::to_string(max_leg_joints) + " joints in a leg",
                     advice_for_large_leg(robot)});
    if (leg.muscles.size() > static_cast<std::size_t>(max_leg_muscles))
      out.push_back({key, std::to_string(leg.muscles.size()) + " muscles" + of,
                     "at most " + std::to_string(max_leg_muscles) + " muscles in a leg",
                     advice_for_large_leg(robot)});
  }
}

// Reports parents that do not exist or come later than their children.
void check_tree(const Robot& robot, List& out) {
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    const int parent = parent_of(robot, i);
    if (parent >= -1 && parent < static_cast<int>(i)) continue;
    std::vector<std::string_view> known{body_name};
    for (std::size_t k = 0; k < i; ++k) known.push_back(robot.links[k].name);
    out.push_back({"link." + link.name + ".parent", quoted(link.parent),
                   "a link that stands before it in the file, or body", "one of " + listed(known)});
  }
}

// Reports legs that are not paths from the body outwards, that share a joint or leave one out,
// or that have different parts; and too many discs.
void check_legs(const Robot& robot, List& out) {
  check_discs(robot, out);
  check_leg_sizes(robot, out);
  if (robot.legs.empty()) return;
  if (robot.legs.size() > static_cast<std::size_t>(max_legs))
    out.push_back({"leg", std::to_string(robot.legs.size()) + " legs",
                   "at most " + std::to_string(max_legs), "a smaller robot"});
  const std::size_t before = out.size();
  for (const Leg& leg : robot.legs) check_path(robot, leg, out);
  if (out.size() > before) return;
  check_membership(robot, out);
  if (out.size() == before) check_likeness(robot, out);
}

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
  if (robot.muscles.size() > static_cast<std::size_t>(max_muscles))
    out.push_back({"muscle", std::to_string(robot.muscles.size()) + " muscles",
                   "at most " + std::to_string(max_muscles),
                   "actuators in parallel are one muscle with a larger count"});
  check_names(robot.links, "link", out);
  check_names(robot.joints, "joint", out);
  check_names(robot.muscles, "muscle", out);
  check_names(robot.sensors, "sensor", out);
}

// Laws and controller divide by the radius at rest, so it must not be 0.
void check_cam(const Robot& robot, const std::string& joint, const Cam& cam, const std::string& key,
               List& out) {
  if (!cam.angle.empty() && std::isfinite(cam.radius))
    out.push_back({key + ".moment_arm", "a round cam and a table", "one of both", "cam alone"});
  if (cam.angle.size() != cam.radii.size())
    out.push_back({key + ".cam",
                   std::to_string(cam.angle.size()) + " angles and " +
                       std::to_string(cam.radii.size()) + " radii",
                   "as many of both", "one radius per angle"});
  if (std::adjacent_find(cam.angle.begin(), cam.angle.end(), std::greater_equal<>()) !=
      cam.angle.end())
    out.push_back({key + ".cam.angle", "angles that do not ascend", "each above the one before",
                   "the joint's angle, counter-clockwise"});
  const int j = find_joint(robot, joint);
  if (j < 0 || cam.angle.empty() || cam.angle.size() != cam.radii.size()) return;
  const Joint& at = robot.joints[static_cast<std::size_t>(j)];
  if (!(cam_radius(cam, at, at.rest_angle) > 0))
    out.push_back({key + ".cam.radius", "0 at the joint's rest angle", "above 0 there",
                   "angles about the joint's rest_angle"});
}

void check_second(const Robot& robot, const Muscle& muscle, List& out) {
  const std::string key = "muscle." + muscle.name;
  check_cam(robot, muscle.joint, muscle.cam, key, out);
  const Muscle::Second& second = muscle.second;
  if (second.joint.empty()) return;
  check_cam(robot, second.joint, second.cam, key + ".second", out);
  const int other = find_joint(robot, second.joint);
  if (other < 0 || second.joint == muscle.joint)
    out.push_back({key + ".second.joint", "\"" + second.joint + "\"",
                   "a joint other than its first, \"" + muscle.joint + "\"",
                   "one of " + names(robot.joints)});
}

void check_passive(const Robot& robot, const Joint& joint, List& out) {
  for (const Muscle& m : robot.muscles)
    if (m.joint == joint.name || m.second.joint == joint.name)
      out.push_back({"joint." + joint.name + ".kind", "passive, and muscle \"" + m.name + "\"",
                     "no muscle at a passive joint", "kind = \"driven\""});
}

// Each direction has at most one muscle, at least one has one; the other may be a spring's or
// gravity's.
void check_driven(const Robot& robot, const Joint& joint, List& out) {
  int muscles = 0;
  for (const auto role : {Muscle::Role::flexor, Muscle::Role::extensor}) {
    const auto count = std::ranges::count_if(robot.muscles, [&](const Muscle& m) {
      return (m.joint == joint.name && m.role == role) ||
             (m.second.joint == joint.name && m.second.role == role);
    });
    const std::string word = role == Muscle::Role::flexor ? "flexor" : "extensor";
    if (count > 1)
      out.push_back({"joint." + joint.name, std::to_string(count) + " muscles as " + word,
                     "at most one", "actuators in parallel are one muscle with a larger count"});
    muscles += static_cast<int>(count);
  }
  if (muscles == 0)
    out.push_back({"joint." + joint.name, "no muscle", "a flexor, an extensor or both",
                   "kind = \"passive\""});
}

// Checks that each driven joint has its muscles, and each muscle a joint and an inlet.
void check_pairs(const Robot& robot, List& out) {
  for (const Muscle& muscle : robot.muscles) {
    const std::string key = "muscle." + muscle.name;
    if (find_joint(robot, muscle.joint) < 0)
      out.push_back(
          {key + ".joint", "\"" + muscle.joint + "\"", "a joint", "one of " + names(robot.joints)});
    if (muscle.inlet.empty())
      out.push_back({key + ".inlet", "no valve", "the name of a valve", "inlet = { valve = … }"});
    check_second(robot, muscle, out);
  }
  for (const Joint& joint : robot.joints) {
    if (joint.kind == Joint::Kind::passive) {
      check_passive(robot, joint, out);
      continue;
    }
    check_driven(robot, joint, out);
  }
}

// Checks bits of the cylinder's valves, whether they are in a loop or only listed.
template <class Take>
void check_cylinder_bits(const Robot& robot, const Take& take) {
  if (!robot.cylinder.present) return;
  for (const auto& [word, chamber] :
       {std::pair{"up", &robot.cylinder.up}, std::pair{"down", &robot.cylinder.down}}) {
    const std::string key = std::string("cylinder.") + word;
    if (!chamber->inlet.empty()) take(chamber->inlet_bit, key + ".inlet.bit");
    if (!chamber->exhaust.empty()) take(chamber->exhaust_bit, key + ".exhaust.bit");
  }
}

void check_bits(const Robot& robot, List& out) {
  std::map<int, std::string> used;  // bits of one board
  std::string on;
  const auto take = [&](int bit, const std::string& key) {
    const auto [at, fresh] = used.emplace(bit, key);
    if (!fresh)
      out.push_back({key, "bit " + std::to_string(bit) + on, "a bit of its own",
                     "another one; " + at->second + " has it"});
  };
  const std::vector<Board> boards = boards_of(robot);
  for (std::size_t b = 0; b < boards.size(); ++b) {
    const Board& board = boards[b];
    if (boards.size() > 1) on = " on board " + std::to_string(b + 1);
    used.clear();
    for (const int m : board.muscles) {
      const Muscle& muscle = robot.muscles[static_cast<std::size_t>(m)];
      take(muscle.inlet_bit, "muscle." + muscle.name + ".inlet.bit");
      if (!muscle.exhaust.empty())
        take(muscle.exhaust_bit, "muscle." + muscle.name + ".exhaust.bit");
    }
    if (board.cylinder || boards.size() == 1) check_cylinder_bits(robot, take);
  }
}

void check_sensor(const Robot& robot, const Sensor& sensor, List& out) {
  const std::string key = "sensor." + sensor.name;
  using Kind = Sensor::Kind;
  const bool angle = sensor.kind == Kind::angle || sensor.kind == Kind::velocity;
  const bool tension = sensor.kind == Kind::tension || sensor.kind == Kind::pressure;
  if (sensor.kind == Kind::cylinder && !robot.cylinder.present)
    out.push_back({key + ".kind", "\"cylinder\"", "a robot with a [cylinder]",
                   "kind = \"fixed\" for one that does not move"});

  if (angle && find_joint(robot, sensor.of) < 0)
    out.push_back(
        {key + ".of", "\"" + sensor.of + "\"", "a joint", "one of " + names(robot.joints)});
  if (tension && find_muscle(robot, sensor.of) < 0)
    out.push_back(
        {key + ".of", "\"" + sensor.of + "\"", "a muscle", "one of " + names(robot.muscles)});
  if (sensor.kind != Kind::fixed && (sensor.scale == 0 || sensor.assumed_scale == 0))
    out.push_back({key + (sensor.scale == 0 ? ".real.scale" : ".assumed.scale"), "0", "a scale",
                   "what the sensor gives for one unit of what it measures"});

  const double top = robot.converter.top();
  for (const auto& [word, rest] : {std::pair{".real.at_rest", sensor.at_rest},
                                   std::pair{".assumed.at_rest", sensor.assumed_at_rest}})
    if (rest > top)
      out.push_back({key + word, std::to_string(std::lround(rest)) + " count",
                     "at most " + std::to_string(robot.converter.top()), "a count it can give"});
}

// The count at rest must be plausible.
void check_plausible(const Robot& robot, const Sensor& sensor, List& out) {
  const std::vector<double>& range = sensor.plausible;
  if (range.empty()) return;
  const std::string key = "sensor." + sensor.name + ".plausible";
  const auto text = [](double counts) { return std::to_string(std::lround(counts)); };
  if (range.size() == 2 && range[0] >= range[1]) {
    const bool equal = range[0] == range[1];
    out.push_back({key, text(range[0]) + " to " + text(range[1]) + " count",
                   "the lowest count first, then the highest",
                   equal ? "two that differ"
                         : "plausible = [\"" + text(range[1]) + " count\", \"" + text(range[0]) +
                               " count\"]"});
    return;
  }
  if (range.size() != 2 || range[1] > robot.converter.top()) {
    out.push_back({key, std::to_string(range.size()) + " numbers",
                   "two, the lowest and the highest count, up to " + text(robot.converter.top()),
                   "plausible = [\"400 count\", \"3000 count\"]"});
    return;
  }
  for (const double rest : std::set{sensor.at_rest, sensor.assumed_at_rest})
    if (rest < range[0] || rest > range[1])
      out.push_back({key, text(range[0]) + " to " + text(range[1]) + " count",
                     "a range with its count at rest in it, " + text(rest), "a wider one"});
}

// Each converter converts one channel after the other: a result is read before the next conversion
// starts.
void check_scan(const Robot& robot, const Board& board, List& out) {
  int previous = 0;
  std::set<int> channels;
  for (const int s : board.sensors) {
    const Sensor& sensor = robot.sensors[static_cast<std::size_t>(s)];
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
    check_plausible(robot, sensor, out);
    previous = sensor.tick;
  }
}

// Every quantity that a law needs has one sensor, and no quantity has two.
void check_coverage(const Robot& robot, List& out) {
  const auto check = [&](Sensor::Kind kind, const std::string& of, const std::string& key,
                         const std::string& word, bool needed) {
    const auto n = std::count_if(robot.sensors.begin(), robot.sensors.end(),
                                 [&](const Sensor& s) { return s.kind == kind && s.of == of; });
    if (n == 1 || (n == 0 && !needed)) return;
    out.push_back({key, std::to_string(n) + " sensors of its " + word, "one",
                   "[sensor.…] with kind = \"" + word + "\", of = \"" + of + "\""});
  };
  for (const Joint& joint : robot.joints) {
    const std::string key = "joint." + joint.name;
    const bool driven = joint.kind == Joint::Kind::driven;
    const bool spindle = joint.velocity.estimator == Velocity::Estimator::sensor;
    check(Sensor::Kind::angle, joint.name, key, "angle", driven);
    check(Sensor::Kind::velocity, joint.name, key, "velocity", driven && spindle);
  }
  for (int m = 0; m < static_cast<int>(robot.muscles.size()); ++m) {
    const Muscle& muscle = robot.muscles[static_cast<std::size_t>(m)];
    const std::string key = "muscle." + muscle.name;
    check(Sensor::Kind::tension, muscle.name, key, "tension", needs_tension(robot, m));
    const int j = find_joint(robot, muscle.joint);
    check(Sensor::Kind::pressure, muscle.name, key, "pressure",
          j >= 0 && robot.joints[static_cast<std::size_t>(j)].stiffness_source ==
                        StiffnessSource::pressures);
  }
}

// Checks the settings of the joints' own controllers.
void check_controllers(const Robot& robot, List& out) {
  for (const Joint& joint : robot.joints) {
    const std::string key = "joint." + joint.name + ".velocity.weights";
    const std::vector<double>& weights = joint.velocity.weights;
    if (weights.empty()) continue;
    double sum = 0, size = 0;
    for (const double w : weights) sum += w, size += std::abs(w);
    if (weights.size() != static_cast<std::size_t>(joint.velocity.samples))
      out.push_back({key, std::to_string(weights.size()) + " weights",
                     "one per sample, " + std::to_string(joint.velocity.samples),
                     "samples = " + std::to_string(weights.size())});
    if (std::abs(sum) > 1e-9 * size)
      out.push_back({key, "a sum of " + std::to_string(sum) + " 1/s",
                     "0: a joint at rest has no speed", "the first weight as what is left to 0"});
  }
  const double percents = 100 * robot.low_level.dead_band;
  if (std::abs(percents - std::round(percents)) > 1e-9)
    out.push_back({"low_level.dead_band", std::to_string(percents) + " %", "whole percents",
                   "duties have no parts of one"});
}

void check_cylinder(const Robot& robot, List& out) {
  const Cylinder& c = robot.cylinder;
  if (!c.present) return;
  const bool has_air = c.mode != Cylinder::Mode::free;
  if (has_air && !(c.bore > c.rod_diameter && c.stroke > 0))
    out.push_back({"cylinder", "a bore not above its rod, or no stroke",
                   "bore > rod_diameter and stroke > 0", "0.627 in and 2 in, 4.2"});
  if (!(c.body_mass > 0))
    out.push_back({"cylinder.body_mass", "0 kg", "above 0", "what moves with the rod"});
  if (c.mode == Cylinder::Mode::regulator && !(c.pressure > 0))
    out.push_back({"cylinder.pressure", "none", "a pressure, as the mode is \"regulator\"",
                   "pressure = \"20 psi gauge\""});
  if (c.mode != Cylinder::Mode::valves) return;
  for (const auto& [word, chamber] : {std::pair{"up", &c.up}, std::pair{"down", &c.down}})
    if (chamber->inlet.empty() || chamber->exhaust.empty())
      out.push_back({std::string("cylinder.") + word, "no inlet or no exhaust",
                     "both, as the mode is \"valves\"", "inlet = { valve = …, bit = … }"});
  if (cylinder_sensor(robot) < 0)
    out.push_back({"cylinder.mode", "\"valves\" without a sensor of its travel",
                   "[sensor.…] with kind = \"cylinder\"", "4.5, B.1: channel 24, tick 1"});
}

void check_rollers(const Robot& robot, List& out) {
  const Rollers& r = robot.rollers;
  if (!r.present) return;
  if (!robot.trolley.present || !(r.front > r.rear))
    out.push_back({"rollers", "no trolley, or a front roller that is not ahead of the rear one",
                   "[trolley] and front > rear", "positions from the first joint, forward > 0"});
  if (robot.trolley.present && r.counterweight > trolley_own_mass(robot))
    out.push_back({"rollers.counterweight", std::to_string(r.counterweight) + " kg",
                   "at most the trolley's own " + std::to_string(trolley_own_mass(robot)) + " kg",
                   "it is part of trolley.total_mass"});
}

// Checks the ends of a range, with the rest angle between them.
void check_stops(const Robot& robot, List& out) {
  for (const Joint& joint : robot.joints) {
    const Stop& stop = joint.stop;
    const std::string key = "joint." + joint.name + ".stop";
    if (stop.range.empty()) continue;
    if (!stop.present() || !(stop.range[0] < stop.range[1]))
      out.push_back({key + ".angles",
                     std::to_string(stop.range.size()) + " angles, or none that rise",
                     "two: the lowest and the highest", "angles = [\"240 deg\", \"330 deg\"]"});
    else if (joint.rest_angle < stop.range[0] || joint.rest_angle > stop.range[1])
      out.push_back({key + ".angles", "a range without the rest angle",
                     "angles about the joint's rest_angle, in the same turn",
                     "add or take 360 deg"});
    if (!(stop.stiffness > 0))
      out.push_back({key + ".stiffness", "0", "above 0: it holds the joint",
                     "so that the joint's largest torque bends it by a degree or two"});
  }
}

void check_masses(const Robot& robot, List& out) {
  check_names(robot.foot.points, "foot.point", out);
  // A body that is free in the plane may have no mass except its links'.
  const bool free = robot.cylinder.present && robot.cylinder.mode == Cylinder::Mode::free;
  const double own = trolley_own_mass(robot), least = free ? -1e-9 * robot.trolley.total_mass : 0;
  if (robot.trolley.present && (free ? own < least : own <= 0))
    out.push_back({"trolley.total_mass", std::to_string(robot.trolley.total_mass) + " kg",
                   "more than links and foot together, " + std::to_string(leg_mass(robot)) + " kg",
                   "the mass of all that moves along the track"});
  bool stands = false;
  for (std::size_t l = 0; l < std::max<std::size_t>(1, robot.legs.size()); ++l)
    stands = stands || foot_of(robot, l).present;
  if (robot.ground.present && !stands)
    out.push_back({"ground.present", "true", "a foot that touches it",
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
  check_tree(robot, out);
  if (out.empty()) check_legs(robot, out);
  check_pairs(robot, out);
  check_bits(robot, out);
  check_boards(robot, out);
  for (const Board& board : boards_of(robot)) check_scan(robot, board, out);
  check_coverage(robot, out);
  check_controllers(robot, out);
  check_masses(robot, out);
  check_stops(robot, out);
  check_cylinder(robot, out);
  check_rollers(robot, out);
  return out;
}

}  // namespace sinew::robot
