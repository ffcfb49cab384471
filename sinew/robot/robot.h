// robot/robot.h - what the machine is: links, joints, antagonist pairs, sensors. Description only:
// plants move it, controllers drive it, analysis reads its logs.
//
// Plane x forward, y up, origin at the hip axis; angles counter-clockwise, the first joint's from
// +x, every other joint's from its proximal link's direction. Link k hangs at joint k: on the link
// before it, on another one (a tree), or on the body, which carries the first. SI throughout.
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

// The sizes of the loop's fixed arrays.
inline constexpr int max_joints = 24;
inline constexpr int max_muscles = 48;  // with an inlet and an exhaust each
inline constexpr int max_discs = 24;    // of all feet together

// One leg's, which one gait controller drives.
inline constexpr int max_leg_joints = 8, max_leg_muscles = 16;

// One board's of the low level; all boards' channels are numbered by one byte.
inline constexpr int board_joints = 8, board_channels = 32, board_bits = 32;
inline constexpr int max_boards = 6, max_sensors = max_boards * board_channels;

inline constexpr double not_set = std::numeric_limits<double>::quiet_NaN();

// The name that a link gives as its parent if it hangs on the body.
inline constexpr std::string_view body_name = "body";

// A rigid part between two joints, or between a joint and the foot.
struct Link {
  std::string name;
  double length = 0;          // joint to joint, or joint to foot [m]
  double mass = 0;            // [kg]
  double center_of_mass = 0;  // from the proximal joint [m]
  double inertia = 0;         // about the centre of mass [kg m^2]
  std::string parent = {};    // link that it hangs on, or body_name; empty: the one before it
  double at = not_set;        // along the parent, or ahead of the body's origin; not set: at the
                              // parent's end, or at the origin [m]
};

// Gains in the controller's own units; see control/joint/config.h.
struct Gains {
  double angle = 0;      // G_theta [1/count]
  double stiffness = 0;  // G_k [1/(N m/rad)]
  double velocity = 0;   // G_v [s/count]
};

// A stop, which a joint strikes at the ends of its range: a spring and a damper at either end that
// only push.
struct Stop {
  std::vector<double> range;  // lowest and highest angle; empty: none [rad]
  double stiffness = 0;       // [N m/rad]
  double damping = 0;         // [N m s/rad]

  // Has the joint one?
  bool present() const { return range.size() == 2; }
};

// A joint, about which two links turn, with what drives, brakes and stops it.
struct Joint {
  // Which way the flexor turns the joint.
  enum class Flexion { raises_angle, lowers_angle };
  enum class Kind { driven, passive };  // passive: no muscles, no sensors, the low level knows none

  std::string name;
  Kind kind = Kind::driven;
  double rest_angle = 0;  // where every muscle has its mount_length [rad]
  Flexion flexion = Flexion::raises_angle;
  double moment_arm = 0;    // cam radius [m]
  double dry_friction = 0;  // bound [N m]
  double damping = 0;       // [N m s/rad]
  double damper = 0;        // of a rotary damper beside it, 7.3 [N m s/rad]
  double spring = 0;        // [N m/rad]
  double spring_angle = 0;  // where the spring pulls nothing [rad]
  Stop stop;
  Gains gains;
  Velocity velocity;
  StiffnessSource stiffness_source = StiffnessSource::forces;
  PressureLaw pressure_law;
  bool enabled = true;  // the low level may leave a joint alone
  int board = 0;        // of the low level, from 1; 0: the next that has room (boards.h)

  // Returns 1 where flexion raises the angle, else -1.
  double sign() const { return flexion == Flexion::raises_angle ? 1.0 : -1.0; }
};

// What a cord runs over: a round cam, or one whose radius changes with the joint's angle, straight
// between the points and constant beyond them.
struct Cam {
  double radius = not_set;           // not set: the joint's moment_arm [m]
  std::vector<double> angle, radii;  // ascending [rad], [m]; empty: round
};

// Actuators in parallel that pull one joint one way, with their air and valves.
struct Muscle {
  // Which way the muscle turns its joint.
  enum class Role { flexor, extensor };

  // The other joint that a muscle runs across.
  struct Second {
    std::string joint;  // empty: none
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
  double external_volume = 0;            // of the whole bundle, downstream of the valves [m^3]
  double bladder_stiffness = not_set;    // per actuator; not set: the actuator file's [N/m]
  double bladder_rest_length = not_set;  // [m]
  std::string inlet, exhaust;            // names in the valves file; no exhaust with a 3-way inlet
  int inlet_bit = 0, exhaust_bit = 8;    // of its board's output ports, B.1
  gas::Hose hose;                        // between it and its valves
  gas::Leak leak;                        // to the room
};

// The foot, which stands on the ground.
struct Foot {
  // A disc fixed to the last link, which touches the ground.
  struct Point {
    std::string name;
    double along = 0;   // of its centre, from the last joint along the link [m]
    double across = 0;  // to the left of the link's direction [m]
    double radius = 0;  // [m]
  };

  bool present = false;
  double mass = 0;            // at the end of the last link [kg]
  double radius = 0;          // a disc about the ankle, fixed to the last link [m]
  double friction = 0;        // Coulomb, static = sliding [-]
  std::vector<Point> points;  // in place of the one disc at the link's end; a shoe has two
};

// One of several legs: a path of joints from the body outwards, with a foot at its end. The names
// of its joints and muscles begin with its own and "_"; what drives it, and what is logged of it,
// leaves that out (legs.h).
struct Leg {
  std::string name;
  std::vector<std::string> joints;  // from the body outwards
  Foot foot;                        // in place of Robot::foot where it is present
  std::string plan;                 // sequence of the experiment's that it follows; empty: the one
  double offset = 0;                // by which its sequence is ahead, as a share of a step [-]
};

// A level ground as a spring and a damper that only push.
struct Ground {
  bool present = false;
  double height = 0;            // of the ankle point at contact [m]
  double normal_stiffness = 0;  // [N/m]
  double normal_damping = 0;    // [N s/m]
};

// The trolley that carries the first joint along the track.
struct Trolley {
  bool present = false;
  double total_mass = 0;      // everything that moves along the track, the legs included [kg]
  double drag = 0;            // dry, while it rolls [N]
  double breakaway = 0;       // that sets it rolling; below the drag: the drag [N]
  double track_length = 0;    // from the start to the stop [m]
  double stop_stiffness = 0;  // [N/m]
  double stop_damping = 0;    // [N s/m]
  double payload = 0;         // rides on it, beside the total mass [kg]

  // Returns what has to be accelerated along the track  [kg].
  double moving_mass() const { return total_mass + payload; }

  // Bound of its dry friction, from what the last step held and could have held  [N]: less than
  // the bound is rest.
  double friction(double held, double bound) const {
    return present ? friction(held, bound, drag, breakaway) : 0.0;
  }
  // The law itself, of a double or a pack: the bound while it rolls, and that of rest.
  template <class S>
  static S friction(const S& held, const S& bound, const S& rolling, const S& at_rest) {
    const auto rests = ((held < bound) & (held > -bound)) | (bound == 0.0);
    return units::select(rests & (at_rest > rolling), at_rest, rolling);
  }
};

// Where the trolley's weight rests, 7.2: two rollers on the track. Along from the first joint,
// forward > 0. The rollers are loads to be reported; no motion depends on them.
struct Rollers {
  bool present = false;
  double front = 0, rear = 0;    // of the rollers [m]
  double height = 0;             // of the track above the first joint, cylinder extended [m]
  double counterweight = 0;      // part of the total mass [kg]
  double counterweight_at = 0;   // [m]
  double center_of_mass = 0;     // of the rest of the trolley and its payload [m]
  double center_of_mass_up = 0;  // above the first joint, cylinder extended [m]
};

// Joint 0 of 4.2: an air cylinder between trolley and body moves the first joint up and down.
// Travel counts upwards from the extended stop, where the first joint is at the origin.
struct Cylinder {
  // Says what the air in it does.
  enum class Mode { locked, regulator, valves, free };
  // One side of the piston with its two valves.
  struct Chamber {
    double dead_volume = 0;      // with its hoses, at its end of the stroke [m^3]
    std::string inlet, exhaust;  // names in the valves file
    int inlet_bit = 4, exhaust_bit = 12;
  };

  bool present = false;
  Mode mode = Mode::locked;  // at the extended stop; or behind a regulator; or four valves in a
                             // loop; or free: there is no air in it, the body slides
  double bore = 0, rod_diameter = 0, stroke = 0;  // [m]
  double body_mass = 0;  // what moves up and down, links and foot apart; in the total mass [kg]
  double friction = 0;   // of piston and bearings, dry [N]
  double damping = 0;    // [N s/m]
  double stop_stiffness = 0;  // of both ends of the stroke [N/m]
  double stop_damping = 0;    // [N s/m]
  double pressure = 0;  // Mode::regulator: in `down`, which pushes the body down, absolute [Pa]
  Chamber up, down;     // the chambers that push the body up (rod side) and down
  int board = 0;        // as a joint's
  double position_gain = 0;                         // Mode::valves, B.1: 0.9 % per count [1/count]
  double up_feedforward = 0, down_feedforward = 0;  // duties of inlet and exhaust alike, B.1 [-]
};

// Turns volts into counts, behind every sensor of a board.
struct Converter {
  int bits = 12;
  double full_scale = 5;  // [V]

  // Returns the highest count, and how many counts a volt makes.
  int top() const { return (1 << bits) - 1; }
  double counts_per_volt() const { return (1 << bits) / full_scale; }
};

// `real` is what the hardware does, `assumed` what the controller believes.
struct Sensor {
  // fixed: a quantity that does not move; cylinder: its travel; pressure: gauge, of a muscle
  enum class Kind { angle, tension, fixed, pressure, velocity, cylinder };

  std::string name;
  Kind kind = Kind::angle;
  std::string of;   // joint or muscle
  int board = 0;    // of a fixed one, as a joint's; any other is on that of what it measures
  int channel = 0;  // of its board's converter
  int tick = 1;     // of the period, when the result is read; the conversion starts a tick earlier

  double scale = 0;    // real: [rad/V], [V/N], [V/Pa], [V s/rad] or [m/V]
  double at_rest = 0;  // real: counts at the joint's rest angle, or where the quantity is zero
  double noise = 0;    // real: standard deviation [count]

  double assumed_scale = 0;    // [count/rad], [V/N], [V/Pa], [V s/rad] or [count/m]
  double assumed_at_rest = 0;  // [count]

  // The limits of a reading that is believed; control/setup/supervision.h derives those not given.
  std::vector<double> plausible;  // lowest, highest [count]
  double max_rate = not_set;      // [count/s]
  double frozen_limit = not_set;  // the same counts while driven end the run; not set: never [s]
};

// The low level's hardware: timing, and how it rounds.
struct LowLevel {
  // Where duties lose their fraction of a percent: each law's, their sum, or never.
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
  double vent_time = 0;              // exhausts open at start-up and shut-down [s]
  double dead_band = 0;              // duties of sealing valves below it are 0; whole percents [-]
  int hold_limit = 0;                // bad readings of a channel in a row that end the run; 0: any
  double command_rate = not_set;     // of a desired angle, above which it is rejected [rad/s]
  double interrupt_time = 0;  // longest interrupt of the thesis's program, 5.2; 0: not known [s]
};

// The thesis's own quirks, on or off (docs/evidence/departures.md).
struct Thesis {
  bool knee_lengths_swapped = false;  // B.1 lengthens the flexor when a knee's angle falls
};

struct Robot {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Muscle> muscles;
  std::vector<Leg> legs;  // empty: one, which is all of the robot's links
  Foot foot;
  Ground ground;
  Trolley trolley;
  Rollers rollers;
  Cylinder cylinder;
  double gravity = 9.80665;  // [m/s^2]
  Converter converter;
  std::vector<Sensor> sensors;  // on each board ascending in tick
  LowLevel low_level;
  Thesis thesis;
};

// Position in the list, or -1.
int find_joint(const Robot&, std::string_view name);
int find_muscle(const Robot&, std::string_view name);
int find_sensor(const Robot&, std::string_view name);
int muscle_of(const Robot&, int joint, Muscle::Role role);  // also one that has it as its second
int angle_sensor_of(const Robot&, int joint);
int tension_sensor_of(const Robot&, int muscle);
int pressure_sensor_of(const Robot&, int muscle);
int velocity_sensor_of(const Robot&, int joint);
int cylinder_sensor(const Robot&);

// Does a law need what this muscle's transducer says?
bool needs_tension(const Robot&, int muscle);

// Every joint has a pair of its own over round cams of its moment arm, nothing else pulls, and no
// sensor but angles and tensions looks: what the thesis's laws of a joint are written for.
bool is_plain(const Robot&);

// The link that a link hangs on, by its position; -1: the body. A name that leads nowhere: -2.
int parent_of(const Robot&, std::size_t link);

// Returns where a link hangs: along its parent, or ahead of the body's origin  [m].
double attachment_of(const Robot&, std::size_t link);

// One link after the other, each at the end of the one before, with one foot: no tree.
bool is_serial(const Robot&);

// At most two joints, every muscle over a round cam at one of them, one disc for a foot, the
// cylinder locked or none: a machine that a planar chain in closed form holds.
bool is_chain(const Robot&);

// Links and feet together  [kg].
double leg_mass(const Robot&);

// What is left of the total for the trolley itself  [kg]; 0 without a trolley.
double trolley_own_mass(const Robot&);

// What cannot be: names that lead nowhere, a joint without its pair, masses that do not add up.
struct Contradiction {
  std::string key, found, expected, try_this;
};
std::vector<Contradiction> contradictions(const Robot&);

}  // namespace sinew::robot
