// control/gait/plan.h - what the brain does over time: phases, their order, how often.
//
//   [control]        what holds until a phase says otherwise
//   [sequence]       the phases of a step, repeated
//   [plan.<name>]    another order of them, for a leg that names it
//   [phase.<name>]   a foot path or joint angles, and what else changes in that phase
//   [[change]]       what stands in place of all that from a time on (change.h)
//
// Within a phase the progress s runs from 0 to 1. What may change over a phase is a *profile*: a
// list of values. None: stays as it was. One: holds from this phase on. Several: passed through at
// equal steps of s, straight in between; what was reached last holds from there on.
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

// One coordinate of the foot path, about the first joint  [m].
struct Coordinate {
  // Says by which variable the polynomial goes: the share of the phase, or the foot's x.
  enum class Of { s, x };

  double from = robot::not_set, to = robot::not_set;  // straight in s, in place of a polynomial
  Profile polynomial;                                 // c0 + c1 u + c2 u^2 + ..., u = s or x
  Of of = Of::s;

  // Does it go straight from one value to another? Is it given at all?
  bool straight() const { return std::isfinite(from) || std::isfinite(to); }
  bool given() const { return straight() || !polynomial.empty(); }
};

// A polyline, run through at constant speed: s is the share of its length.
struct Points {
  std::vector<double> x, y;  // [m]

  // Are there any points?
  bool given() const { return !x.empty() || !y.empty(); }
};

struct GainProfiles {
  Profile angle;      // [1/count]
  Profile stiffness;  // [1/(N m/rad)]
  Profile velocity;   // [s/count]
};

// Open loop: duties in place of the joint's laws, while the phase lasts. What is not given is 0.
struct DutyProfiles {
  Profile flexor_inlet, flexor_exhaust, extensor_inlet, extensor_exhaust;  // [-] 0 .. 1

  // Is any of the four given?
  bool given() const {
    return !(flexor_inlet.empty() && flexor_exhaust.empty() && extensor_inlet.empty() &&
             extensor_exhaust.empty());
  }
};

// Of one joint in one phase.
struct JointPhase {
  Profile angle;      // in place of the foot path's [rad]
  Profile stiffness;  // [N m/rad]
  GainProfiles gains;
  DutyProfiles feedforward;
};

// Of the air cylinder that carries the body, B.1's joint 0: its desired travel, up from the
// extended stop. None: stays where it was; before the first one, at the stop. Or open loop; the
// chamber `up` then is the flexor, and inlet and exhaust of a chamber may be open together.
struct CylinderPhase {
  // Says by which variable the polynomial goes: the share of the phase, or the foot's height.
  enum class Of { s, foot_y };

  Profile position;    // over the phase [m]
  Profile polynomial;  // in its place: c0 + c1 u + ..., u = s or the foot path's height [m]
  Of of = Of::s;
  DutyProfiles feedforward;

  // Is there a position to go to? Is anything given at all?
  bool placed() const { return !position.empty() || !polynomial.empty(); }
  bool given() const { return placed() || feedforward.given(); }
};

// The normal force of [75] sets the height of a foot path, 6.3: where the foot carries less than
// `desired` the path goes down, where it carries more it goes up.
//
//   y = y_path + clamp(gain (F_y - desired), -limit, +limit)
struct GroundForce {
  double desired = 0;  // [N]
  double gain = 0;     // [m/N]; 0: the path stays as it is
  double limit = 0;    // of the correction, either way [m]

  // Is the force controlled at all?
  bool given() const { return gain != 0; }
};

// Ends the phase early: at the first period, its own first one excepted, at which the measure
// stands beyond the level. The phase's duration is the latest end.
struct Until {
  // Says on which side of the level the phase ends.
  enum class Is { above, below };

  std::string measure;  // "foot.normal_force", "joint.hip.angle", ...; empty: by time alone
  Is is = Is::above;
  double level = 0;  // in the measure's SI unit
};

// A part of a step: where the foot goes, how stiff, and for how long.
struct Phase {
  std::string name;
  double duration = 0;         // [s]
  double thesis_duration = 0;  // with thesis_timing, where the code's differs; 0: the same [s]

  Coordinate x, y;
  Points points;
  GroundForce ground_force;
  CylinderPhase cylinder;
  std::vector<JointPhase> joints;     // of Plan::joints
  std::vector<std::string> disabled;  // joints that the low level leaves alone in this phase
  Until until;

  // Does the foot have a path in it?
  bool has_path() const { return x.given() || y.given() || points.given(); }
};

// What holds from the start.
struct JointPlan {
  std::string name;
  double stiffness = 0;  // K_des [N m/rad]
  robot::Gains gains;    // the robot's, or the experiment's
  bool enabled = true;
  bool driven = true;         // false: a passive joint, of which no file says anything
  std::vector<double> range;  // lowest and highest desired angle, the way round that raises the
                              // angle; empty: any [rad]
};

// Another order of the phases, for a leg that names it.
struct Sequence {
  std::string name;
  std::vector<std::string> phases;
};

struct Plan {
  enum class Finish { vent, hold };  // vent: all exhausts open, all inlets shut

  double brain_period = 0.01;  // [s]
  double settle = 0;  // before the first phase, joints left alone [s]; not in the file's tables
  bool thesis_timing = false;  // loops of the code: one more period per phase, s reaches 1

  std::vector<JointPlan> joints;      // the robot's in its order; of several legs, a leg's
  std::vector<std::string> sequence;  // names of phases
  std::vector<Sequence> others;       // [plan.<name>]
  int repeat = 1;                     // steps
  Finish finish = Finish::vent;
  std::vector<Phase> phases;
  std::vector<Change> changes;  // in any order; of one time, the later ones come later
};

// A plan that knows the robot's joints and gains; `fields` fills in the rest.
Plan plan_for(const robot::Robot&);

// The angle itself where it lies within the joint's range, else the nearer end  [rad].
double within(const std::vector<double>& range, double angle) noexcept;

// What ends a phase, and what it is measured in.
struct Measure {
  // Names the quantity.
  enum class Kind { none, normal_force, friction_force, angle, stiffness, tension, unknown };

  Kind kind = Kind::none;
  int index = -1;  // joint or muscle
};
// Returns the measure that a name stands for.
Measure find_measure(const robot::Robot&, std::string_view name);
std::string_view unit_of(std::string_view measure);  // SI; by the name alone, "" where it is none

// What the robot or the plan itself does not allow: names that lead nowhere, lists of unequal
// length.
std::vector<robot::Contradiction> contradictions(const robot::Robot&, const Plan&);

// Every stretch of a foot path that the leg cannot reach: phase, s, target and reach. A run with
// such a plan is possible, the brain then aims at the nearest point that can be reached.
std::vector<robot::Contradiction> unreachable(const robot::Robot&, const Plan&);

// Periods of a phase that nothing ends early, of one step, and of the whole run up to `finish`.
int periods(const Plan&, const Phase&);
int periods_per_step(const Plan&);
std::int64_t periods(const Plan&);
std::int64_t periods(const robot::Robot&, const Plan&);  // of the leg that takes longest

// Returns what a leg follows: the plan, with the order of phases that the leg names in place of the
// plan's.
Plan plan_of_leg(const Plan& plan, const robot::LegParts& leg);

// Periods from s = 0 to s = 1, whether or not the last of them is reached.
int steps_of_s(const Plan&, const Phase&);

// Position in the list, or -1.
int find_phase(const Plan&, std::string_view name);

}  // namespace sinew::gait
