// control/gait/plan.h - plan of the gait controller over time: phases, their order and number of
// repetitions.
//
//   [control]        values that are in effect until a phase changes them
//   [sequence]       phases of a step, repeated
//   [plan.<name>]    another order of them, for a leg that names it
//   [phase.<name>]   a foot path or joint angles, and other changes in that phase
//   [[change]]       values that override all these from a time on (change.h)
//
// Within a phase the progress s increases from 0 to 1. A value that may change over a phase is a
// *profile*, a list of values. Empty: unchanged. One value: in effect from this phase on. Several:
// reached at equal steps of s, with linear interpolation; the last value stays in effect.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/control/gait/change.h"
#include "sinew/robot/legs.h"
#include "sinew/robot/robot.h"

namespace sinew::gait {

using Profile = std::vector<double>;

// One coordinate of the foot path relative to the first joint [m].
struct Coordinate {
  // Variable of the polynomial: the share of the phase, or the foot's x.
  enum class Of { s, x };

  double from = robot::not_set, to = robot::not_set;  // linear in s, instead of a polynomial
  Profile polynomial;                                 // c0 + c1 u + c2 u^2 + ..., u = s or x
  Of of = Of::s;

  // Return whether the coordinate is linear between two values, and whether it is given.
  bool straight() const { return std::isfinite(from) || std::isfinite(to); }
  bool given() const { return straight() || !polynomial.empty(); }
};

// A polyline, traversed at constant speed: s is the share of its length.
struct Points {
  std::vector<double> x, y;  // [m]

  // Returns whether there are points.
  bool given() const { return !x.empty() || !y.empty(); }
};

struct GainProfiles {
  Profile angle;      // [1/count]
  Profile stiffness;  // [1/(N m/rad)]
  Profile velocity;   // [s/count]
};

// Open loop: duties that replace the joint's laws during the phase. Missing profiles are 0.
struct DutyProfiles {
  Profile flexor_inlet, flexor_exhaust, extensor_inlet, extensor_exhaust;  // [-] 0 .. 1

  // Returns whether any of the four is given.
  bool given() const {
    return !(flexor_inlet.empty() && flexor_exhaust.empty() && extensor_inlet.empty() &&
             extensor_exhaust.empty());
  }
};

// Values of one joint in one phase.
struct JointPhase {
  Profile angle;      // instead of the foot path's angle [rad]
  Profile stiffness;  // [N m/rad]
  GainProfiles gains;
  DutyProfiles feedforward;
};

// Values of the air cylinder that carries the body, B.1's joint 0: its desired travel, upwards from
// the extended stop. Without a position it keeps the last one; initially it is at the stop.
// Alternatively duties (open loop): the chamber `up` is the flexor, and inlet and exhaust of a
// chamber may be open together.
struct CylinderPhase {
  // Variable of the polynomial: the share of the phase, or the foot's height.
  enum class Of { s, foot_y };

  Profile position;    // over the phase [m]
  Profile polynomial;  // instead of position: c0 + c1 u + ..., u = s or the foot path's height [m]
  Of of = Of::s;
  DutyProfiles feedforward;

  // Return whether there is a desired position, and whether anything is given.
  bool placed() const { return !position.empty() || !polynomial.empty(); }
  bool given() const { return placed() || feedforward.given(); }
};

// Height of a foot path by the normal force of [75], 6.3: the path is lowered where the foot
// carries less than `desired`, and raised where it carries more.
//
//   y = y_path + clamp(gain (F_y - desired), -limit, +limit)
struct GroundForce {
  double desired = 0;  // [N]
  double gain = 0;     // [m/N]; 0: no correction
  double limit = 0;    // largest correction in either direction [m]

  // Returns whether the force is controlled.
  bool given() const { return gain != 0; }
};

// Ends the phase early, at the first period, except its first one, at which the measure is beyond
// the level. The phase's duration is the latest end.
struct Until {
  // Side of the level on which the phase ends.
  enum class Is { above, below };

  std::string measure;  // "foot.normal_force", "joint.hip.angle", ...; empty: ends by time only
  Is is = Is::above;
  double level = 0;  // in the measure's SI unit
};

// A part of a step: foot path, stiffness and duration.
struct Phase {
  std::string name;
  double duration = 0;         // [s]
  double thesis_duration = 0;  // with thesis_timing, if the code's differs; 0: equal [s]

  Coordinate x, y;
  Points points;
  GroundForce ground_force;
  CylinderPhase cylinder;
  std::vector<JointPhase> joints;     // in the order of Plan::joints
  std::vector<std::string> disabled;  // joints that the low level does not control in this phase
  Until until;

  // Returns whether the phase has a foot path.
  bool has_path() const { return x.given() || y.given() || points.given(); }
};

// Initial values of a joint.
struct JointPlan {
  std::string name;
  double stiffness = 0;  // K_des [N m/rad]
  robot::Gains gains;    // given by the robot or the experiment
  bool enabled = true;
  bool driven = true;         // false: a passive joint, which has no values in files
  std::vector<double> range;  // lowest and highest desired angle, in the direction of increasing
                              // angle; empty: any [rad]
};

// Another order of the phases, for legs that name it.
struct Sequence {
  std::string name;
  std::vector<std::string> phases;
};

struct Plan {
  enum class Finish { vent, hold };  // vent: all exhausts open, all inlets shut

  double high_level_period = 0.01;  // period of the gait controller [s]
  double settle = 0;  // before the first phase, joints disabled [s]; not in the file's tables
  bool thesis_timing = false;  // as the code's loops: one more period per phase, s reaches 1

  std::vector<JointPlan> joints;      // in the robot's order; for several legs, those of a leg
  std::vector<std::string> sequence;  // names of phases
  std::vector<Sequence> others;       // [plan.<name>]
  int repeat = 1;                     // steps
  Finish finish = Finish::vent;
  std::vector<Phase> phases;
  std::vector<Change> changes;  // in any order; of several at one time the last one is in effect
};

// Returns a plan with the robot's joints and gains; `fields` reads the rest.
Plan plan_for(const robot::Robot&);

// Returns the angle if it is within the joint's range, else the nearer end [rad].
double within(const std::vector<double>& range, double angle) noexcept;

// Measured quantity that ends a phase.
struct Measure {
  // Kind of quantity.
  enum class Kind { none, normal_force, friction_force, angle, stiffness, tension, unknown };

  Kind kind = Kind::none;
  int index = -1;  // joint or muscle
};
// Returns the measure with that name.
Measure find_measure(const robot::Robot&, std::string_view name);
std::string_view unit_of(std::string_view measure);  // SI, from the name alone; "" if unknown

// Returns contradictions within the robot or the plan: unknown names, lists of unequal length.
std::vector<robot::Contradiction> contradictions(const robot::Robot&, const Plan&);

// Returns every stretch of a foot path that the leg cannot reach, with phase, s, target and reach.
// A run with such a plan is possible: the gait controller then aims at the nearest reachable point.
std::vector<robot::Contradiction> unreachable(const robot::Robot&, const Plan&);

// Return the periods of a phase that does not end early, of one step, and of the whole run up to
// `finish`.
int periods(const Plan&, const Phase&);
int periods_per_step(const Plan&);
std::int64_t periods(const Plan&);
std::int64_t periods(const robot::Robot&,
                     const Plan&);  // number of periods of the longest leg plan

// Returns a leg's plan: the plan with the order of phases that the leg names.
Plan plan_of_leg(const Plan& plan, const robot::LegParts& leg);

// Returns the periods from s = 0 to s = 1, even if the last one is not reached.
int steps_of_s(const Plan&, const Phase&);

// Returns the index in the list, or -1.
int find_phase(const Plan&, std::string_view name);

}  // namespace sinew::gait
