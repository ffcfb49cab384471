// design/joint.h - joint with an antagonistic pair of equal muscles, 4.2: torque, range of motion,
// stiffness and air of one design.
//
//   cam:    L_f = L_m - r a            L_e = L_m + r a            arm = r
//   lever:  L_f = L_m - r sin a        L_e = L_m + r sin a        arm = r cos a
//
//   T = n arm (F(L_f, p) - F(L_e, 0) - Q(L_f, p) - Q(L_e, 0))     torque that lifts [N m]
//   A = 2 s/r (cam), 2 asin(s/r) (lever)      s = min(L_m - L_min, L_max - L_m)
//   K = n r^2 (k_f + k_e)                                         stiffness at the middle [N m/rad]
//   m = rho(p) (n V(L_f(A_t/2)) + V_ext) - rho(0) (n V(L_f(-A_t/2)) + V_ext)
//
//   a    angle from the middle [rad]          n    muscles side by side [-]
//   r    moment arm [m]                       L_m  length of both muscles at the middle [m]
//   F    tension, tension.h [N]               Q    bound of its dry friction, loss.h [N]
//   p    gauge pressure of the muscle that pulls; the other one is vented [Pa]
//   A    range of motion: one muscle is fully contracted, L_min, where it does not pull at p, or
//   the
//        other one's threads are stretched, L_max (4.2) [rad]; L_min of the thesis's law: b/sqrt 3
//   A_t  angles over which the torque is needed [rad]
//   k    stiffness at constant pressure [26], and that of bladder and ends [N/m]
//   m    air of one stroke at the temperature of the room [kg]; rho = P/(R T)
//
// Valid for muscles that are straight between their ends and a cam they do not leave; the weight of
// the limb is part of the torque that is wanted. Tendons do not stretch. Departures from the
// thesis: it chooses the middle of the stroke as L_m, which gives the largest range; here L_m gives
// the largest torque among those with the range that is wanted.
#pragma once

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/gas/air.h"

namespace sinew::design {

// Names the mechanism at the joint.
enum class Arm { cam, lever };

// Requirements of a joint.
struct JointTask {
  double torque = 0;           // at each of the angles, in both directions [N m]
  double angles = 0;           // range over which it is needed [rad]
  double motion = 0;           // range of motion without load [rad]
  double pressure = 0;         // highest gauge pressure [Pa]
  double external_volume = 0;  // hose and fittings of the muscles side by side [m3]
  Arm arm = Arm::cam;
};

// A joint: equal muscles side by side on either side.
struct JointDesign {
  actuator::Actuator actuator;
  int count = 1;
  double moment_arm = 0;    // [m]
  double mount_length = 0;  // at the middle [m]
};

// A torque and the interval by the 95 % interval of the muscles' forces [N m]; NaN: unknown.
struct Torque {
  double value = 0, low = 0, high = 0;
};

// Returns the length of the muscle that raises the angle [m]; that of the other one is
// length_at(…, -angle).
double length_at(const JointDesign& joint, Arm arm, double angle);
// Returns the moment arm at an angle [m].
double arm_at(const JointDesign& joint, Arm arm, double angle);

// Returns the torque with which the joint raises the angle: one muscle has the gauge pressure `p`,
// the other one `opposed` [Pa].
Torque torque_at(const JointDesign& joint, const JointTask& task, double angle, double p,
                 double opposed, double atmosphere);

// Returns the weakest torque over the angles of the task, and its angle. `low` is the lowest bound
// over these angles; it is unknown if one bound is unknown.
struct Weakest {
  Torque torque;
  double angle = 0;
};
Weakest weakest_torque(const JointDesign& joint, const JointTask& task, double opposed,
                       double atmosphere);

// Returns the lengths between which the muscle works: fully contracted at the task's pressure, and
// with stretched threads, or the longest that was measured, where the file has measured lengths
// [m].
struct Stroke {
  double shortest = 0, longest = 0;
};
Stroke stroke_of(const actuator::Actuator& a, double pressure, double atmosphere);

// Returns the range of motion without load [rad]; 0 if the joint cannot move.
double motion_of(const JointDesign& joint, Arm arm, const Stroke& stroke);

// Returns the stiffness at the middle with both muscles at a gauge pressure [N m/rad].
double stiffness_at_middle(const JointDesign& joint, double pressure, double atmosphere);

// Returns the air that one stroke over the angles takes [kg].
double air_of_stroke(const JointDesign& joint, const JointTask& task, const gas::Air& air);

// Returns the largest gauge pressure in the opposing muscle at which the joint still has the task's
// torque at every angle [Pa]; NaN if it lacks the torque even when that muscle is vented.
double co_contraction_left(const JointDesign& joint, const JointTask& task, double atmosphere);

// Returns the mount length with the largest weakest torque among those that allow the motion [m];
// NaN if none does.
double best_mount_length(const JointDesign& joint, const JointTask& task, const Stroke& stroke,
                         double atmosphere);

}  // namespace sinew::design
