#include "sinew/robot/legs.h"

#include <algorithm>

namespace sinew::robot {
namespace {

constexpr std::string_view heads[] = {"/true", "/desired"};

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

// Returns the length of the head after which a leg's name is inserted.
std::size_t head_of(std::string_view topic) {
  for (const std::string_view head : heads)
    if (topic.starts_with(head) && topic.substr(head.size()).starts_with("/")) return head.size();
  return 0;
}

std::string topic_of(const Robot& robot, int leg, std::string_view kind, const std::string& name) {
  const bool none = robot.legs.empty() || leg < 0;
  const std::string_view of =
      none ? std::string_view{} : robot.legs[static_cast<std::size_t>(leg)].name;
  return topic_of_leg(of, std::string(kind) + name_in_leg(of, name));
}

void rename(const std::string& leg, Robot& out) {
  const auto within = [&](std::string& name) { name = name_in_leg(leg, name); };
  for (Link& l : out.links) within(l.name), within(l.parent);
  for (Joint& j : out.joints) within(j.name);
  for (Muscle& m : out.muscles) within(m.name), within(m.joint), within(m.second.joint);
  for (Sensor& s : out.sensors) within(s.of);
}

}  // namespace

int leg_of_joint(const Robot& robot, int joint) {
  if (robot.legs.empty()) return 0;
  if (joint < 0) return -1;
  const std::string& name = robot.joints[static_cast<std::size_t>(joint)].name;
  for (std::size_t l = 0; l < robot.legs.size(); ++l)
    if (has(robot.legs[l].joints, name)) return static_cast<int>(l);
  return -1;
}

int leg_of_muscle(const Robot& robot, int muscle) {
  return leg_of_joint(robot,
                      find_joint(robot, robot.muscles[static_cast<std::size_t>(muscle)].joint));
}

std::vector<LegParts> legs_of(const Robot& robot) {
  std::vector<LegParts> out(std::max<std::size_t>(1, robot.legs.size()));
  for (std::size_t l = 0; l < robot.legs.size(); ++l) {
    out[l].name = robot.legs[l].name;
    out[l].offset = robot.legs[l].offset;
    out[l].plan = robot.legs[l].plan;
  }
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j)
    if (const int l = leg_of_joint(robot, j); l >= 0)
      out[static_cast<std::size_t>(l)].joints.push_back(j);
  for (int m = 0; m < static_cast<int>(robot.muscles.size()); ++m)
    if (const int l = leg_of_muscle(robot, m); l >= 0)
      out[static_cast<std::size_t>(l)].muscles.push_back(m);
  return out;
}

const Foot& foot_of(const Robot& robot, std::size_t leg) {
  const bool own = leg < robot.legs.size() && robot.legs[leg].foot.present;
  return own ? robot.legs[leg].foot : robot.foot;
}

int discs_of(const Robot& robot) {
  std::size_t discs = 0;
  for (std::size_t l = 0; l < std::max<std::size_t>(1, robot.legs.size()); ++l) {
    const Foot& foot = foot_of(robot, l);
    if (foot.present) discs += std::max<std::size_t>(1, foot.points.size());
  }
  return static_cast<int>(discs);
}

int foot_link(const Robot& robot, std::size_t leg) {
  if (leg < robot.legs.size() && !robot.legs[leg].joints.empty())
    return find_joint(robot, robot.legs[leg].joints.back());
  return static_cast<int>(robot.links.size()) - 1;
}

Robot only_leg(const Robot& robot, std::size_t leg) {
  if (robot.legs.empty()) return robot;
  const Leg& it = robot.legs[leg];
  Robot out = robot;
  out.legs.clear();
  out.foot = foot_of(robot, leg);
  out.links.clear();
  out.joints.clear();
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    if (!has(it.joints, robot.joints[j].name)) continue;
    out.links.push_back(robot.links[j]);
    out.joints.push_back(robot.joints[j]);
  }
  std::erase_if(out.muscles, [&](const Muscle& m) { return !has(it.joints, m.joint); });
  std::erase_if(out.sensors, [&](const Sensor& s) {
    const bool of_leg = has(it.joints, s.of) || find_muscle(out, s.of) >= 0;
    return !s.of.empty() && !of_leg;
  });
  if (!out.links.empty()) {
    out.links.front().parent = std::string(body_name);
    out.links.front().at = not_set;  // its kinematics begin at its first joint
  }
  rename(it.name, out);
  return out;
}

std::string name_in_leg(std::string_view leg, std::string_view name) {
  const std::string head = std::string(leg) + "_";
  if (!leg.empty() && name.starts_with(head)) name.remove_prefix(head.size());
  return std::string(name);
}

std::string topic_of_leg(std::string_view leg, std::string_view topic) {
  std::string out(topic);
  if (!leg.empty()) out.insert(head_of(topic), "/leg/" + std::string(leg));
  return out;
}

std::string topic_in_leg(std::string_view leg, std::string_view topic) {
  const std::size_t head = head_of(topic);
  std::string_view rest = topic.substr(head);
  if (leg.empty() || !rest.starts_with("/leg/")) return std::string(topic);
  const std::string mine = "/leg/" + std::string(leg);
  rest.remove_prefix(std::min(mine.size(), rest.size()));
  const bool is_mine = topic.substr(head).starts_with(mine) && rest.starts_with("/");
  return is_mine ? std::string(topic.substr(0, head)) + std::string(rest) : std::string();
}

std::string logged_topic(const Robot& robot, std::string_view topic) {
  if (robot.legs.empty()) return std::string(topic);
  const std::size_t head = head_of(topic);
  const std::string_view rest = topic.substr(head);
  for (const std::string_view kind : {"/joint/", "/muscle/", "/valve/"}) {
    if (!rest.starts_with(kind)) continue;
    const std::size_t end = std::min(rest.find('/', kind.size()), rest.size());
    const std::string_view name = rest.substr(kind.size(), end - kind.size());
    const int joint = find_joint(robot, name), muscle = find_muscle(robot, name);
    std::string of;
    if (kind == "/joint/" && joint >= 0)
      of = topic_of_joint(robot, static_cast<std::size_t>(joint));
    const auto m = static_cast<std::size_t>(std::max(muscle, 0));
    if (kind == "/muscle/" && muscle >= 0) of = topic_of_muscle(robot, m);
    if (kind == "/valve/" && muscle >= 0) of = topic_of_valves(robot, m);
    if (of.empty()) break;
    return std::string(topic.substr(0, head)) + of + std::string(rest.substr(end));
  }
  return std::string(topic);
}

std::string topic_of_joint(const Robot& robot, std::size_t joint) {
  return topic_of(robot, leg_of_joint(robot, static_cast<int>(joint)), "/joint/",
                  robot.joints[joint].name);
}

std::string topic_of_muscle(const Robot& robot, std::size_t muscle) {
  return topic_of(robot, leg_of_muscle(robot, static_cast<int>(muscle)), "/muscle/",
                  robot.muscles[muscle].name);
}

std::string topic_of_valves(const Robot& robot, std::size_t muscle) {
  return topic_of(robot, leg_of_muscle(robot, static_cast<int>(muscle)), "/valve/",
                  robot.muscles[muscle].name);
}

}  // namespace sinew::robot
