// robot/legs.h - the legs of a robot, each as a robot of its own: a leg's gait controller and the
// readers of its log handle a single leg, with part names as if it were the only one.
//
// The parts of a leg `left` are named left_hip, left_hip_flexor; within the leg, in the plan and in
// the log they are hip and hip_flexor. A leg's topic begins with /leg/<name>, after /true or
// /desired if it has one:
//
//   /joint/hip/angle        /leg/left/joint/hip/angle
//   /true/foot/force        /true/leg/left/foot/force
//
// A robot without [leg.*] has one leg without a name, which is the whole robot: nothing changes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/robot/robot.h"

namespace sinew::robot {

inline constexpr int max_legs = 8;

// One leg's joints and muscles, as indices in the robot's lists.
struct LegParts {
  std::string name;  // empty: the robot's only one
  std::vector<int> joints, muscles;
  double offset = 0;  // lead of its sequence, as a share of a step [-]
  std::string plan;   // the sequence that it follows; empty: the experiment's
};

// Returns the robot's legs in the order of its file. contradictions(robot) must be empty.
std::vector<LegParts> legs_of(const Robot&);

// Return the leg of a joint, and of a muscle by its first joint; 0 for a robot without [leg.*], -1
// for a passive joint between legs and body, which belongs to no leg.
int leg_of_joint(const Robot&, int joint);
int leg_of_muscle(const Robot&, int muscle);

// Returns the foot of a leg: its own, or the robot's.
const Foot& foot_of(const Robot&, std::size_t leg);

// Returns the number of discs of all feet; a foot without points has one.
int discs_of(const Robot&);

// Returns the link that carries a leg's foot, its last; -1 if the robot has no links.
int foot_link(const Robot&, std::size_t leg);

// Returns a robot that has only this leg, with part names as within the leg, and its foot as the
// robot's. Body, ground and other parts stay; sensors keep their names, and those of other legs are
// removed.
Robot only_leg(const Robot&, std::size_t leg);

// Returns the name of a leg's part within the leg: "left_hip" of "left" is "hip".
std::string name_in_leg(std::string_view leg, std::string_view name);

// Returns a topic of a leg as in the log; the topic itself if the leg has no name.
std::string topic_of_leg(std::string_view leg, std::string_view topic);

// Returns the inverse: a leg's topic as within the leg; empty for another leg's topic; any other
// topic unchanged.
std::string topic_in_leg(std::string_view leg, std::string_view topic);

// Returns a topic with the robot's name of a joint, a muscle or its valves,
// "/true/joint/left_hip/angle", as in the log; any other topic unchanged.
std::string logged_topic(const Robot&, std::string_view topic);

// Return the prefix of a joint's and a muscle's topics, after /true or /desired: "/joint/hip",
// "/leg/left/muscle/hip_flexor"; and of a muscle's valves: "/leg/left/valve/hip_flexor".
std::string topic_of_joint(const Robot&, std::size_t joint);
std::string topic_of_muscle(const Robot&, std::size_t muscle);
std::string topic_of_valves(const Robot&, std::size_t muscle);

}  // namespace sinew::robot
