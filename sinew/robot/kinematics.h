// robot/kinematics.h - positions of joints and feet from angles, and angles from a foot's position,
// [61]-[64], [72].
//
// Angles as in robot.h: the first from +x, every other from its proximal link's direction,
// counter-clockwise. Inverse kinematics and Jacobian are those of the leg with two links.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sinew/robot/robot.h"

namespace sinew::robot {

struct Point {
  double x = 0, y = 0;  // [m], or [N] for a force
};

struct TwoLinks {
  double l1 = 0, l2 = 0;  // [m]
};
// Returns whether the robot is a leg: two links at driven joints, and beyond them only passive
// ones, as an ankle's.
bool is_leg(const Robot&);
TwoLinks two_links(const Robot&);  // requires is_leg()

// Positions of a chain's joints and its end, from the first joint outwards [m].
struct Pose {
  std::array<Point, max_joints + 1> joint;  // joint[0] is the origin
  int links = 0;

  // Returns the end of the chain [m].
  Point foot() const { return joint[static_cast<std::size_t>(links)]; }
};

// Returns the positions by [61], [62] for up to max_joints links; requires as many angles.
Pose forward(std::span<const double> lengths, std::span<const double> angles);
Pose forward(const Robot&, std::span<const double> angles);  // requires is_serial()

// Returns the position of each link of a robot of any shape, from the body's origin; as many as
// there are angles.
struct LinkPlace {
  Point joint;         // its joint [m]
  double heading = 0;  // direction, from +x [rad]
};
std::vector<LinkPlace> places(const Robot&, std::span<const double> angles);

// Returns the foot's position, from the first joint [m].
Point foot_position(const TwoLinks&, double theta1, double theta2);

// Returns the angle in 0 .. 2 pi [rad].
double normalised(double angle);

// Direction of the knee: theta2 in pi .. 2 pi as the leg's [code of B.1], or in 0 .. pi.
enum class Knee { above_pi, below_pi };

// Angles that bring the foot to a target, or to the nearest reachable point.
struct Inverse {
  // Names whether the target could be reached, or the reason why not.
  enum class Status { reached, too_far, too_near, not_a_number };

  Status status = Status::reached;
  std::array<double, 2> angle{};     // for `nearest`, 0 .. 2 pi [rad]
  double distance = 0;               // target from the first joint [m]
  double shortest = 0, longest = 0;  // limits of the reach [m]
  Point nearest;                     // the target, or the nearest reachable point [m]

  // Returns whether the foot is at the target itself.
  bool reached() const { return status == Status::reached; }
};

// Returns [63], [64] without acos, which loses half its digits near a straight or a folded knee:
//
//   theta2 = +- 2 atan2(sqrt((l1 + l2)^2 - d^2), sqrt(d^2 - (l1 - l2)^2))
//   theta1 = atan2(y, x) - atan2(l2 sin theta2, l1 + l2 cos theta2)
Inverse inverse(const TwoLinks&, Point target, Knee = Knee::above_pi);

// Returns [63], [64] as in the code of B.1 (minus in [63], + or - in [64] by the side of the hip),
// extended to any target by normalising the angle. NaN if the target is out of reach.
std::array<double, 2> inverse_as_printed(const TwoLinks&, Point target);

// [72]: d(x, y)/d(theta1, theta2), row by row  [m/rad].
struct Jacobian {
  double x1 = 0, x2 = 0;
  double y1 = 0, y2 = 0;

  double determinant() const { return x1 * y2 - x2 * y1; }  // l1 l2 sin theta2
};
// Returns the Jacobian at these angles [rad].
Jacobian jacobian(const TwoLinks&, double theta1, double theta2);

// Returns the force of the ground on the foot, from the torques of the muscles [N]:
//
//   F = -(J^T)^-1 T                                             [71], [75];
// docs/evidence/departures.md lists the differences from the thesis.
//
// Static: inertia and weight of the links are neglected, as in 6.3. Near a straight or a folded
// knee the pose carries any force along the leg: singular, and the force is 0.
struct GroundReaction {
  Point force;
  bool singular = false;  // |sin theta2| < singular_sine
};
inline constexpr double singular_sine = 0.02;  // 1.1 deg from straight or folded
GroundReaction ground_reaction(const TwoLinks&, double theta1, double theta2,
                               std::array<double, 2> torque);

// Returns the torques with which the foot pushes with a force, from the first joint outwards, for
// any chain, joint by joint [N m], > 0 raises the angle:
//
//   T = J^T F    T_j = (foot - joint_j) x F                                                [71]
//
// F is the force of the foot on the ground [N]; the ground's reaction is -F. Static, as
// ground_reaction.
std::array<double, max_joints> torques_for(const Pose&, Point force);

// Returns the radius of a cam by its table, which has at least one point: linear in between,
// constant beyond [m].
double cam_radius(std::span<const double> angle, std::span<const double> radii, double at);

// Returns the radius of a muscle's cam at this angle of the joint [m].
double cam_radius(const Cam&, const Joint&, double angle);

// Returns the moment arm of a muscle at a joint at this angle, > 0 raises it; 0 at a joint that the
// muscle does not cross [m].
double moment_arm_at(const Muscle&, const Joint&, double angle);

// The muscles across a joint, found once for many torques. The robot must outlive the object.
class JointMuscles {
 public:
  // Finds the muscles across this joint.
  JointMuscles(const Robot& robot, int joint);

  // Returns their total torque, from the tensions in the robot's order [N m].
  double torque(double angle, std::span<const double> tensions) const;

 private:
  const Robot& robot_;
  const Joint& joint_;
  int flexor_ = -1, extensor_ = -1;  // used for a plain robot
};
// Returns the torque of all muscles across a joint, for a single use [N m].
double torque_of_muscles(const Robot&, int joint, double angle, std::span<const double> tensions);

// Returns a joint's torque from its muscles, > 0 raises the angle [N m]: [71]'s T with the sign of
// each.
double torque(const Joint&, double flexor_tension, double extensor_tension);

// Returns the length of a muscle by the cam [m]; the flexor shortens where its joint flexes.
double muscle_length(const Joint&, Muscle::Role, double mount_length, double angle);

// Returns the length of a muscle by its cams of any shape, at these angles of all joints  [m].
double muscle_length(const Robot&, const Muscle&, std::span<const double> angles);

// Returns the length assumed by the low level: with its assumed mount length, and B.1's exchange at
// the knee [m].
double assumed_muscle_length(const Robot&, int muscle, double angle);

}  // namespace sinew::robot
