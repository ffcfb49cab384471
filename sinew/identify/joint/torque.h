// identify/joint/torque.h - torque of a joint's muscles and load, under the models of joint.h.
#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/joint/joint.h"

namespace sinew::identify {

// Path of a muscle's tendon over a joint, round a cam or straight between two points: its moment
// arm and the muscle's shortening over the joint's angle q (Delta theta) from rest, positive where
// it shortens.
//
//   round   r(q) = r                          DL(q) = r q
//   hinge   r(q) = l_a l_d sin(theta_h)/l_D   DL(q) = l_D(q = 0) - l_D,  theta_h = theta_h0 - q
//           l_D^2 = l_a^2 + l_d^2 - 2 l_a l_d cos(theta_h)
//
//   r   moment arm [m]               l_a, l_d  from the joint to both ends of the muscle [m]
//   DL  shortening [m], DL' = r      theta_h   angle between them, seen from the joint [rad]
//
// A hinge is described by r = r(0), theta_h0 and l_a sin(theta_h0)/r, which is above 1; l_d
// follows.
class Hinge {
 public:
  // Returns a cam with this radius [m].
  static Hinge round(double arm) { return Hinge(arm, 0, 0, 0); }

  // `ratio` is l_a sin(angle)/arm, above 1; 0 < angle < pi.
  static Hinge points(double arm, double ratio, double angle) {
    const double s = std::sin(angle), origin = ratio * arm / s;
    const double insertion =
        origin * (std::sqrt(ratio * ratio - s * s) - std::cos(angle)) / (ratio * ratio - 1);
    return Hinge(arm, origin, insertion, angle);
  }

  // Returns the moment arm at this angle from rest [m].
  double arm(double q) const {
    if (origin_ == 0) return arm_;
    const double phi = angle_ - q;
    return origin_ * insertion_ * std::sin(phi) / distance(phi);
  }

  // Returns the shortening at this angle relative to rest [m].
  double shortening(double q) const {
    return origin_ == 0 ? arm_ * q : distance(angle_) - distance(angle_ - q);
  }

  double origin() const { return origin_; }        // l_a [m]
  double insertion() const { return insertion_; }  // l_d [m]

 private:
  Hinge(double arm, double origin, double insertion, double angle)
      : arm_(arm), origin_(origin), insertion_(insertion), angle_(angle) {}

  double distance(double phi) const {
    return std::sqrt(origin_ * origin_ + insertion_ * insertion_ -
                     2 * origin_ * insertion_ * std::cos(phi));
  }

  double arm_, origin_, insertion_, angle_;
};

// One model of a joint's torque.
struct JointLaw {
  const char* name;
  const char* law;
  const char* source;
  bool hinge, pressure;  // straight between two points; effectiveness depends on the pressure
};

// Values of a joint's models. Known values, and those that a model does not have, are not
// parameters.
struct JointValues {
  double moment_arm = 0, origin_ratio = 0, origin_angle = 0;  // Hinge
  double flexor_length = 0, extensor_length = 0;              // [m]
  double c0 = 1, c1 = 0;                                      // [1], [1/Pa]
  double friction = 0, damping = 0, delay = 0;                // [N m], [N m s/rad], [s]
  std::vector<double> bias, gain;  // torque sensor of each recording [N m], [1]
};

// A measured joint: torque of its load, and torque of a model's muscles.
class JointTorque {
 public:
  // `setup` must outlive this object.
  JointTorque(const Measured& data, const JointSetup& setup);

  // Return whether the data have the pressures of that muscle.
  bool has_flexor() const { return !flexor_.empty(); }
  bool has_extensor() const { return !extensor_.empty(); }
  const std::vector<double>& torque() const { return torque_; }  // load torques [N m]
  // Returns the growth of a row's torque per mass at the lever [N m/kg].
  double torque_per_load(std::size_t row) const;
  // Return 1 if flexion raises the angle, else -1; and the number of rows.
  double sign() const { return sign_; }
  std::size_t rows() const { return angle_.size(); }
  double highest_gauge() const;   // [Pa]
  double largest_torque() const;  // largest magnitude [N m]
  double fastest() const;         // largest rate of a moving joint [rad/s]
  std::size_t recordings() const { return recordings_; }

  // Return the path of the muscles and their effectiveness for these values.
  static Hinge hinge(const JointLaw& law, const JointValues& v);
  actuator::Effectiveness effectiveness(const JointValues& v) const;

  // Writes the torques that remain unbalanced [N m].
  void residuals(const JointLaw& law, const JointValues& v, std::span<double> r) const;

  // Adds a warning if muscles were longer or shorter than the range of the braid's law.
  void warn_of_ends(const JointLaw& law, const JointValues& v,
                    std::vector<std::string>& warnings) const;

 private:
  double force(const actuator::Actuator& a, const Hinge& tendon, double mount, double q,
               double pressure) const;

  void put_recordings(const Measured& data);
  double bias_of(const JointValues& v, std::size_t from, std::size_t to, std::size_t recording,
                 std::span<const double> needed) const;

  const JointSetup& setup_;
  double sign_ = 1;
  std::size_t recordings_ = 1;
  std::vector<double> recording_, time_, rate_;  // for each row; empty: one recording, at rest
  std::vector<double> angle_, flexor_, extensor_, torque_;
};

}  // namespace sinew::identify
