#include "sinew/robot/check_legs.h"

#include <algorithm>
#include <set>
#include <string>

#include "sinew/robot/legs.h"

namespace sinew::robot {
namespace {

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

// Its joints are there, named after it, and hang one on the other from the body on, or from a link
// that is no leg's.
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
    if (joint < 0) continue;  // said already
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

// One plan speaks to all legs by the names within them, so these stand for the same everywhere.
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

// Links of which two hang on one can be several legs; a single chain cannot.
const char* advice_for_large_leg(const Robot& robot) {
  std::set<int> parents;
  for (std::size_t i = 0; i < robot.links.size(); ++i) parents.insert(parent_of(robot, i));
  const bool branches = parents.size() < robot.links.size();
  return robot.legs.empty() && branches ? "several legs, [leg.<name>] with joints = [...]"
                                        : "fewer of them: links that hardly move as one link";
}

// One gait controller drives a leg.
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

}  // namespace

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

}  // namespace sinew::robot
