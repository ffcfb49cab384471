// robot/robot.h - description of a machine: links, joints, antagonist pairs, sensors. Simulation,
// controllers and analysis use it; it has no behaviour.
//
// Plane with x forward, y up, origin at the hip axis; angles counter-clockwise, the first
// joint's from +x, every other joint's from its proximal link's direction. Link k is attached at
// joint k: to the link before it, to another one (a tree), or to the body, which carries the first.
// SI units throughout.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/gas/hose.h"
#include "sinew/gas/leak.h"
#include "sinew/robot/control.h"
#include "sinew/units/pack.h"

namespace sinew::robot {

// Sizes of the loop's fixed arrays.
inline constexpr int max_joints = 24;
inline constexpr int max_muscles = 48;  // with an inlet and an exhaust each
inline constexpr int max_discs = 24;    // for all feet together

// Limits for one leg, which one gait controller drives.
inline constexpr int max_leg_joints = 8, max_leg_muscles = 16;

// Limits for one board of the low level; all boards' channels are numbered by one byte.
inline constexpr int board_joints = 8, board_channels = 32, board_bits = 32;
inline constexpr int max_boards = 6, max_sensors = max_boards * board_channels;

inline constexpr double not_set = std::numeric_limits<double>::quiet_NaN();

// Parent name of a link that is attached to the body.
inline constexpr std::string_view body_name = "body";

// A rigid part between two joints, or between a joint and the foot.
struct Link {
  std::string name;
  double length = 0;          // joint to joint, or joint to foot [m]
  double mass = 0;            // [kg]
  double center_of_mass = 0;  // distance from the proximal joint [m]
  double inertia = 0;         // about the centre of mass [kg m^2]
  std::string parent = {};    // link that carries it, or body_name; empty: the one before it
  double at = not_set;        // along the parent, or ahead of the body's origin; not set: at the
                              // parent's end, or at the origin [m]
};

// Gains in the controller's own units; see control/joint/config.h.
struct Gains {
  double angle = 0;      // G_theta [1/count]
  double stiffness = 0;  // G_k [1/(N m/rad)]
  double velocity = 0;   // G_v [s/count]
};

// End stops of a joint: a spring and a damper at either end of its range that only push.
struct Stop {
  std::vector<double> range;  // lowest and highest angle; empty: no stop [rad]
  double stiffness = 0;       // [N m/rad]
  double damping = 0;         // [N m s/rad]

  // Returns whether the joint has a stop.
  bool present() const { return range.size() == 2; }
};

// A joint between two links, with its drive, friction and stop.
struct Joint {
  // Direction in which the flexor turns the joint.
  enum class Flexion { raises_angle, lowers_angle };
  enum class Kind { driven, passive };  // passive: no muscles, no sensors, unknown to the low level

  std::string name;
  Kind kind = Kind::driven;
  double rest_angle = 0;  // angle at which every muscle has its mount_length [rad]
  Flexion flexion = Flexion::raises_angle;
  double moment_arm = 0;    // cam radius [m]
  double dry_friction = 0;  // bound [N m]
  double damping = 0;       // [N m s/rad]
  double damper = 0;        // rotary damper at the joint, 7.3 [N m s/rad]
  double spring = 0;        // [N m/rad]
  double spring_angle = 0;  // angle without spring torque [rad]
  Stop stop;
  Gains gains;
  Velocity velocity;
  StiffnessSource stiffness_source = StiffnessSource::forces;
  PressureLaw pressure_law;
  bool enabled = true;  // the low level may ignore a joint
  int board = 0;        // board of the low level, from 1; 0: the next that has room (boards.h)

  // Returns 1 if flexion raises the angle, else -1.
  double sign() const { return flexion == Flexion::raises_angle ? 1.0 : -1.0; }
};

// Cam of a tendon: round, or with a radius that depends on the joint's angle, linear between the
// points and constant beyond them.
struct Cam {
  double radius = not_set;           // not set: the joint's moment_arm [m]
  std::vector<double> angle, radii;  // ascending [rad], [m]; empty: round
};

// Actuators in parallel that act on one joint in one direction, with their air and valves.
struct Muscle {
  // Direction in which the muscle turns its joint.
  enum class Role { flexor, extensor };

  // The other joint that a muscle crosses.
  struct Second {
    std::string joint;  // empty: no second joint
    Role role = Role::flexor;
    Cam cam;
  };

  std::string name;
  std::string joint;
  Role role = Role::flexor;
  std::string actuator;  // name in the actuator files
  int count = 1;         // actuators in parallel
  Cam cam;               // at `joint`
  Second second;
  double mount_length = 0;               // at the joint's rest angle [m]
  double external_volume = 0;            // whole bundle, downstream of the valves [m^3]
  double bladder_stiffness = not_set;    // per actuator; not set: the actuator file's [N/m]
  double bladder_rest_length = not_set;  // [m]
  std::string inlet, exhaust;            // names in the valves file; no exhaust with a 3-way inlet
  int inlet_bit = 0, exhaust_bit = 8;    // bits of its board's output ports, B.1
  gas::Hose hose;                        // between it and its valves
  gas::Leak leak;                        // to the room
};

// Foot on the ground.
struct Foot {
  // A disc fixed to the last link, which touches the ground.
  struct Point {
    std::string name;
    double along = 0;   // centre, from the last joint along the link [m]
    double across = 0;  // to the left of the link's direction [m]
    double radius = 0;  // [m]
  };

  bool present = false;
  double mass = 0;            // at the end of the last link [kg]
  double radius = 0;          // a disc about the ankle, fixed to the last link [m]
  double friction = 0;        // Coulomb, static = sliding [-]
  std::vector<Point> points;  // instead of the one disc at the link's end; a shoe has two
};

// One of several legs: a path of joints from the body outwards, with a foot at its end. The
// names of its joints and muscles begin with its own and "_"; its controller and its log omit that
// prefix (legs.h).
struct Leg {
  std::string name;
  std::vector<std::string> joints;  // ordered from the body outwards
  Foot foot;                        // replaces Robot::foot if present
  std::string plan;                 // name of its sequence in the experiment; empty: the only one
  double offset = 0;                // lead of its sequence, as a share of a step [-]
};

// Level ground, as a spring and a damper that only push.
struct Ground {
  bool present = false;
  double height = 0;            // height of the ankle point at contact [m]
  double normal_stiffness = 0;  // [N/m]
  double normal_damping = 0;    // [N s/m]
};

// The trolley that carries the first joint along the track.
struct Trolley {
  bool present = false;
  double total_mass = 0;      // all parts that move along the track, with the legs [kg]
  double drag = 0;            // dry friction while it rolls [N]
  double breakaway = 0;       // force that starts it; below the drag: the drag [N]
  double track_length = 0;    // distance from the start to the stop [m]
  double stop_stiffness = 0;  // [N/m]
  double stop_damping = 0;    // [N s/m]
  double payload = 0;         // carried in addition to the total mass [kg]

  // Returns the mass that is accelerated along the track [kg].
  double moving_mass() const { return total_mass + payload; }

  // Returns the bound of its dry friction [N], from the force and the bound of the last step: a
  // force below the bound means rest.
  double friction(double held, double bound) const {
    return present ? friction(held, bound, drag, breakaway) : 0.0;
  }
  // The law for a double or a pack: the bound while rolling, or that at rest.
  template <class S>
  static S friction(const S& held, const S& bound, const S& rolling, const S& at_rest) {
    const auto rests = ((held < bound) & (held > -bound)) | (bound == 0.0);
    return units::select(rests & (at_rest > rolling), at_rest, rolling);
  }
};

// Supports of the trolley's weight, 7.2: two rollers on the track. Positions are from the first
// joint, forward > 0. The rollers' loads are only reported; no motion depends on them.
struct Rollers {
  bool present = false;
  double front = 0, rear = 0;    // positions of the rollers [m]
  double height = 0;             // track above the first joint, cylinder extended [m]
  double counterweight = 0;      // part of the total mass [kg]
  double counterweight_at = 0;   // [m]
  double center_of_mass = 0;     // rest of the trolley with its payload [m]
  double center_of_mass_up = 0;  // above the first joint, cylinder extended [m]
};

// Joint 0 of 4.2: an air cylinder between trolley and body moves the first joint up and down.
// Travel counts upwards from the extended stop, where the first joint is at the origin.
struct Cylinder {
  // Names the state of its air.
  enum class Mode { locked, regulator, valves, free };
  // One side of the piston with its two valves.
  struct Chamber {
    double dead_volume = 0;      // includes hoses, at its end of the stroke [m^3]
    std::string inlet, exhaust;  // names in the valves file
    int inlet_bit = 4, exhaust_bit = 12;
  };

  bool present = false;
  Mode mode = Mode::locked;  // locked at the extended stop; or with a regulator; or with four
                             // valves in a loop; or free: without air, the body slides
  double bore = 0, rod_diameter = 0, stroke = 0;  // [m]
  double body_mass = 0;  // lifted parts without links and foot; included in the total mass [kg]
  double friction = 0;   // dry friction of piston and bearings [N]
  double damping = 0;    // [N s/m]
  double stop_stiffness = 0;  // both ends of the stroke [N/m]
  double stop_damping = 0;    // [N s/m]
  double pressure = 0;  // Mode::regulator: in `down`, which pushes the body down, absolute [Pa]
  Chamber up, down;     // the chambers that push the body up (rod side) and down
  int board = 0;        // as for a joint
  double position_gain = 0;                         // Mode::valves, B.1: 0.9 % per count [1/count]
  double up_feedforward = 0, down_feedforward = 0;  // duties of inlet and exhaust, B.1 [-]
};

// Converter from volts to counts, for all sensors of a board.
struct Converter {
  int bits = 12;
  double full_scale = 5;  // [V]

  // Return the highest count, and the number of counts per volt.
  int top() const { return (1 << bits) - 1; }
  double counts_per_volt() const { return (1 << bits) / full_scale; }
};

// Values marked `real` are those of the hardware, `assumed` those that the controller uses.
struct Sensor {
  // fixed: a constant quantity; cylinder: its travel; pressure: gauge, of a muscle
  enum class Kind { angle, tension, fixed, pressure, velocity, cylinder };

  std::string name;
  Kind kind = Kind::angle;
  std::string of;   // joint or muscle
  int board = 0;    // for a fixed one, as for a joint; others are on the board of their quantity
  int channel = 0;  // channel of its board's converter
  int tick = 1;     // result is read then within the period; conversion starts a tick earlier

  double scale = 0;    // real: [rad/V], [V/N], [V/Pa], [V s/rad] or [m/V]
  double at_rest = 0;  // real: counts at the joint's rest angle, or at zero
  double noise = 0;    // real: standard deviation [count]

  double assumed_scale = 0;    // [count/rad], [V/N], [V/Pa], [V s/rad] or [count/m]
  double assumed_at_rest = 0;  // [count]

  // Limits of a plausible reading; control/setup/supervision.h derives missing ones.
  std::vector<double> plausible;  // lowest, highest [count]
  double max_rate = not_set;      // [count/s]
  double frozen_limit = not_set;  // longest time of constant counts while driven; not set: any [s]
};

// The low level's hardware: timing, and rounding.
struct LowLevel {
  // Names the duties that are truncated to whole percents: each law's, their sum, or none.
  enum class Rounding { truncate_each_law, truncate_sum, none };

  int pwm_ticks = 100;   // per period
  int output_delay = 1;  // ticks between law and edge
  Rounding rounding = Rounding::truncate_each_law;
  double stiffness_pole_clamp =
      0;  // angle from the pole of [27] within which the last value is held; -800 deg: never [rad]
  double assumed_thread_length = 0;  // b in the stiffness law; 0: the actuator's [m]
  double assumed_mount_length = 0;   // free length in the stiffness law; 0: the muscle's [m]
  double stiffness_factor = 0;       // 5.5 in B.1; 0: from the assumed scales
  std::string valve_timing;          // path of predict.dat; empty: the identity table
  double vent_time = 0;              // time with open exhausts at start-up and shut-down [s]
  double dead_band = 0;              // duties of sealing valves below it are 0; whole percents [-]
  int hold_limit = 0;  // consecutive bad readings of a channel that end the run; 0: no limit
  double command_rate = not_set;  // rate of a desired angle above which it is rejected [rad/s]
  double interrupt_time = 0;      // longest interrupt of the thesis's program, 5.2; 0: unknown [s]
};

// Peculiarities of the thesis, on or off (docs/evidence/departures.md).
struct Thesis {
  bool knee_lengths_swapped = false;  // B.1 lengthens the flexor when a knee's angle falls
};

struct Robot {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Muscle> muscles;
  std::vector<Leg> legs;  // empty: one leg, which is the whole robot
  Foot foot;
  Ground ground;
  Trolley trolley;
  Rollers rollers;
  Cylinder cylinder;
  double gravity = 9.80665;  // [m/s^2]
  Converter converter;
  std::vector<Sensor> sensors;  // ascending in tick on each board
  LowLevel low_level;
  Thesis thesis;
};

// Return the index in the list, or -1.
int find_joint(const Robot&, std::string_view name);
int find_muscle(const Robot&, std::string_view name);
int find_sensor(const Robot&, std::string_view name);
int muscle_of(const Robot&, int joint, Muscle::Role role);  // also one with it as its second
int angle_sensor_of(const Robot&, int joint);
int tension_sensor_of(const Robot&, int muscle);
int pressure_sensor_of(const Robot&, int muscle);
int velocity_sensor_of(const Robot&, int joint);
int cylinder_sensor(const Robot&);

// Returns whether a law needs this muscle's tension sensor.
bool needs_tension(const Robot&, int muscle);

// Returns whether every joint has a pair of its own over round cams of its moment arm, no other
// muscles act, and all sensors are of angles and tensions: the conditions of the thesis's laws.
bool is_plain(const Robot&);

// Returns the index of the link that carries a link; -1: the body; -2: an unknown name.
int parent_of(const Robot&, std::size_t link);

// Returns the position at which a link is attached, along its parent or ahead of the body's origin
// [m].
double attachment_of(const Robot&, std::size_t link);

// Returns whether each link is at the end of the one before, with one foot: no tree.
bool is_serial(const Robot&);

// Returns whether the robot is a planar chain in closed form: at most two joints, every muscle over
// a round cam at one of them, a foot of one disc, and no cylinder or a locked one.
bool is_chain(const Robot&);

// Returns the mass of links and feet [kg].
double leg_mass(const Robot&);

// Returns the remainder of the total mass for the trolley itself [kg]; 0 without a trolley.
double trolley_own_mass(const Robot&);

// A contradiction: an unknown name, a joint without its pair, masses that do not add up.
struct Contradiction {
  std::string key, found, expected, try_this;
};
std::vector<Contradiction> contradictions(const Robot&);

}  // namespace sinew::robot
