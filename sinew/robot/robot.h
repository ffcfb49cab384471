// robot/robot.h - what the machine is: links, joints, antagonist pairs, sensors. Description only:
// plants move it, controllers drive it, analysis reads its logs.
//
// Plane x forward, y up, origin at the hip axis; angles counter-clockwise, the first joint's from
// +x, every other joint's from its proximal link's direction. Link k hangs at joint k. SI
// throughout.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::robot {

inline constexpr int max_joints = 4;                // what the loop's fixed arrays hold
inline constexpr int max_muscles = 2 * max_joints;  // one pair per joint

inline constexpr double not_set = std::numeric_limits<double>::quiet_NaN();

struct Link {
  std::string name;
  double length = 0;          // joint to joint, or joint to foot [m]
  double mass = 0;            // [kg]
  double center_of_mass = 0;  // from the proximal joint [m]
  double inertia = 0;         // about the centre of mass [kg m^2]
};

// Gains in the controller's own units; see control/joint/config.h.
struct Gains {
  double angle = 0;      // G_theta [1/count]
  double stiffness = 0;  // G_k [1/(N m/rad)]
  double velocity = 0;   // G_v [s/count]
};

struct Joint {
  enum class Flexion { raises_angle, lowers_angle };

  std::string name;
  double rest_angle = 0;  // where every muscle has its mount_length [rad]
  Flexion flexion = Flexion::raises_angle;
  double moment_arm = 0;    // cam radius [m]
  double dry_friction = 0;  // bound [N m]
  double damping = 0;       // [N m s/rad]
  Gains gains;
  bool enabled = true;  // the low level may leave a joint alone

  double sign() const { return flexion == Flexion::raises_angle ? 1.0 : -1.0; }
};

// Actuators in parallel that pull one joint one way, with their air and valves.
struct Muscle {
  enum class Role { flexor, extensor };

  std::string name;
  std::string joint;
  Role role = Role::flexor;
  std::string actuator;                  // name in the actuator files
  int count = 1;                         // actuators in parallel
  double mount_length = 0;               // at the joint's rest angle [m]
  double external_volume = 0;            // of the whole bundle, downstream of the valves [m^3]
  double bladder_stiffness = not_set;    // per actuator; not set: the actuator file's [N/m]
  double bladder_rest_length = not_set;  // [m]
  std::string inlet, exhaust;            // names in the valves file; no exhaust with a 3-way inlet
  int inlet_bit = 0, exhaust_bit = 8;    // of the output port, B.1
};

struct Foot {
  bool present = false;
  double mass = 0;      // at the end of the last link [kg]
  double radius = 0;    // a disc about the ankle, fixed to the last link [m]
  double friction = 0;  // Coulomb, static = sliding [-]
};

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
  double drag = 0;            // dry [N]
  double track_length = 0;    // from the start to the stop [m]
  double stop_stiffness = 0;  // [N/m]
  double stop_damping = 0;    // [N s/m]
};

struct Converter {
  int bits = 12;
  double full_scale = 5;  // [V]

  int top() const { return (1 << bits) - 1; }
  double counts_per_volt() const { return (1 << bits) / full_scale; }
};

// `real` is what the hardware does, `assumed` what the controller believes.
struct Sensor {
  enum class Kind { angle, tension, fixed };  // fixed: a quantity that does not move (yet)

  std::string name;
  Kind kind = Kind::angle;
  std::string of;   // joint or muscle
  int channel = 0;  // of the converter board
  int tick = 1;     // of the period, when the result is read; the conversion starts a tick earlier

  double scale = 0;    // real: [rad/V] or [V/N]
  double at_rest = 0;  // real: counts at the joint's rest angle, at no tension or of what is fixed
  double noise = 0;    // real: standard deviation [count]

  double assumed_scale = 0;    // [count/rad] or [V/N]
  double assumed_at_rest = 0;  // [count]
};

// The low level's hardware: timing, and how it rounds.
struct LowLevel {
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
};

// The thesis's own quirks, on or off (docs/departures.md).
struct Thesis {
  bool knee_lengths_swapped = false;  // B.1 lengthens the flexor when a knee's angle falls
};

struct Robot {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Muscle> muscles;
  Foot foot;
  Ground ground;
  Trolley trolley;
  double gravity = 9.80665;  // [m/s^2]
  Converter converter;
  std::vector<Sensor> sensors;  // ascending in tick
  LowLevel low_level;
  Thesis thesis;
};

// Position in the list, or -1.
int find_joint(const Robot&, std::string_view name);
int find_muscle(const Robot&, std::string_view name);
int find_sensor(const Robot&, std::string_view name);
int muscle_of(const Robot&, int joint, Muscle::Role role);
int angle_sensor_of(const Robot&, int joint);
int tension_sensor_of(const Robot&, int muscle);

// Links and foot together  [kg].
double leg_mass(const Robot&);

// What is left of the total for the trolley itself  [kg]; 0 without a trolley.
double trolley_own_mass(const Robot&);

// What cannot be: names that lead nowhere, a joint without its pair, masses that do not add up.
struct Contradiction {
  std::string key, found, expected, try_this;
};
std::vector<Contradiction> contradictions(const Robot&);

}  // namespace sinew::robot
