// robot/legs.h - a robot's several legs, each as a robot of its own: what drives a leg, and what
// reads its log, knows one leg and calls its parts as if there were no other.
//
// The parts of a leg `left` are named left_hip, left_hip_flexor; within the leg, in the plan and in
// the log they are hip and hip_flexor. A topic of a leg has /leg/<name> before it, behind /true or
// /desired where it begins so:
//
//   /joint/hip/angle        /leg/left/joint/hip/angle
//   /true/foot/force        /true/leg/left/foot/force
//
// A robot without [leg.*] has one leg, which has no name and is all of it: nothing changes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/robot/robot.h"

namespace sinew::robot {

inline constexpr int max_legs = 8;

// One leg's joints and muscles, by their positions in the robot's lists.
struct LegParts {
  std::string name;  // empty: the robot's only one
  std::vector<int> joints, muscles;
  double offset = 0;  // of its sequence, as a share of a step [-]
  std::string plan;   // the sequence that it follows; empty: the experiment's
};

// The robot's legs in the order of its file. contradictions(robot) must be empty.
std::vector<LegParts> legs_of(const Robot&);

// The leg that a joint belongs to, and a muscle by its first joint; 0 of a robot without [leg.*],
// -1 of a passive joint between legs and body, which is no leg's.
int leg_of_joint(const Robot&, int joint);
int leg_of_muscle(const Robot&, int muscle);

// The foot of a leg: its own, or the robot's.
const Foot& foot_of(const Robot&, std::size_t leg);

// Discs of all feet together, one of a foot without points.
int discs_of(const Robot&);

// The link that carries a leg's foot, its last; -1 where the robot has no links.
int foot_link(const Robot&, std::size_t leg);

// A robot that has this leg alone, its parts named as within the leg, its foot as the robot's. The
// body, the ground and the rest stay; sensors keep their names, those of other legs are left out.
Robot only_leg(const Robot&, std::size_t leg);

// The name of a leg's part within the leg: "left_hip" of "left" is "hip".
std::string name_in_leg(std::string_view leg, std::string_view name);

// A topic of a leg as the log has it; the topic itself where the leg has no name.
std::string topic_of_leg(std::string_view leg, std::string_view topic);

// The opposite: what a leg's topic is called within the leg; empty for another leg's, and any other
// topic as it is.
std::string topic_in_leg(std::string_view leg, std::string_view topic);

// A topic that names a joint, a muscle or its valves as the robot does,
// "/true/joint/left_hip/angle", as the log has it; any other as it is.
std::string logged_topic(const Robot&, std::string_view topic);

// A joint's and a muscle's topics begin so, behind /true or /desired: "/joint/hip",
// "/leg/left/muscle/hip_flexor"; a muscle's valves': "/leg/left/valve/hip_flexor".
std::string topic_of_joint(const Robot&, std::size_t joint);
std::string topic_of_muscle(const Robot&, std::size_t muscle);
std::string topic_of_valves(const Robot&, std::size_t muscle);

}  // namespace sinew::robot
