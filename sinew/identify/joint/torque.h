// identify/joint/torque.h - torque of a joint's muscles and load, under the models of joint.h.
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
  bool hinge, pressure;  // straight between two points; effectiveness depends on the pressure
};

// Values of a joint's models. Known values, and those that a model does not have, are not
// parameters.
struct JointValues {
  double moment_arm = 0, origin_ratio = 0, origin_angle = 0;  // hinge.h
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
