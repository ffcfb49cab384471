// identify/joint/torque.h - what a joint's muscles and its load turn it by, under one of the models
// of joint.h.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/data/measured.h"
#include "sinew/identify/joint/hinge.h"
#include "sinew/identify/joint/joint.h"

namespace sinew::identify {

// One model of a joint's torque.
struct JointLaw {
  const char* name;
  const char* law;
  const char* source;
  bool hinge, pressure;  // between two points; an effectiveness that goes with the pressure
};

// All that a model may have. What is known, or no part of the model, is not among its parameters.
struct JointValues {
  double moment_arm = 0, origin_ratio = 0, origin_angle = 0;  // hinge.h
  double flexor_length = 0, extensor_length = 0;              // [m]
  double c0 = 1, c1 = 0;                                      // [1], [1/Pa]
  double friction = 0, damping = 0, delay = 0;                // [N m], [N m s/rad], [s]
  std::vector<double> bias, gain;  // of the torque of each recording [N m], [1]
};

// The measured joint: what its load asks for, and what a model's muscles give.
class JointTorque {
 public:
  // `setup` outlives it.
  JointTorque(const Measured& data, const JointSetup& setup);

  // Do the data have the pressures of that muscle?
  bool has_flexor() const { return !flexor_.empty(); }
  bool has_extensor() const { return !extensor_.empty(); }
  const std::vector<double>& torque() const { return torque_; }  // of the load [N m]
  // Returns 1 where flexion raises the angle, else -1; and how many rows there are.
  double sign() const { return sign_; }
  std::size_t rows() const { return angle_.size(); }
  double highest_gauge() const;   // [Pa]
  double largest_torque() const;  // of either sign [N m]
  double fastest() const;         // of a joint that moves [rad/s]
  std::size_t recordings() const { return recordings_; }

  // Returns what the values mean: how the muscles are led, and which share of their tension
  // arrives.
  static Hinge hinge(const JointLaw& law, const JointValues& v);
  actuator::Effectiveness effectiveness(const JointValues& v) const;

  // Torques that are left over  [N m].
  void residuals(const JointLaw& law, const JointValues& v, std::span<double> r) const;

  // Says so if muscles were longer or shorter than the law of the braid holds for.
  void warn_of_ends(const JointLaw& law, const JointValues& v,
                    std::vector<std::string>& warnings) const;

 private:
  double force(const actuator::Actuator& a, const Hinge& cord, double mount, double q,
               double pressure) const;

  void put_recordings(const Measured& data);
  double bias_of(const JointValues& v, std::size_t from, std::size_t to, std::size_t recording,
                 std::span<const double> needed) const;

  const JointSetup& setup_;
  double sign_ = 1;
  std::size_t recordings_ = 1;
  std::vector<double> recording_, time_, rate_;  // of each row; empty: one, at rest
  std::vector<double> angle_, flexor_, extensor_, torque_;
};

}  // namespace sinew::identify
