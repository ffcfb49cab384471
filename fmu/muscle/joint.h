// fmu/muscle/joint.h - FMU model of joints with their muscles and valves, for a body simulated by
// the importer: angles, rates and currents of the valves in, torques out.
//
//   L_m = mount - sum_k s_k S_k(theta_k)        T_k = sum_m s_k r_k(theta_k) F_m
//
// The cams are in mechanism/planar/muscle_routing.h. During a step the angles change linearly to
// angle + rate x step, and each muscle's length changes linearly between its lengths at both ends.
// Torque > 0 raises the angle. Gravity, stops, damping and dry friction of the joint belong to the
// body; `friction` is the bound of the friction that the muscles' meshes add.
//
// Each muscle is supplied at the supply's pressure: a robot with a tank shared by several muscles
// is refused.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fmu/muscle/muscle.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/robot/robot.h"

namespace sinew::fmu {

class Joint {
 public:
  static constexpr std::string_view kind = "joint";

  // Builds the model of a description. Throws std::exception if the description is invalid.
  explicit Joint(const Description& description);
  // Describes the named joints of a robot with every muscle that crosses one of them; `muscles` are
  // the robot's, in its order. Throws std::invalid_argument for an unknown joint, a joint without
  // muscles, a muscle that also crosses another joint, and a tank.
  static Description describe(const robot::Robot& robot, const std::vector<air::Muscle>& muscles,
                              const std::vector<std::string>& joints, const gas::Air& air,
                              const gas::Supply& supply, double pressure);

  // Return the variables, with the values that were set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  // Starts the model. Throws std::exception for parameters that contradict each other, and for
  // angles at which a muscle has an impossible length.
  void begin();
  double output(std::size_t place) const;
  std::string refusal(double step) const;
  const char* advance(double end, double step) noexcept;
  double last() const noexcept { return units::unbounded; }

  // Save and restore the model's own state as bytes.
  std::vector<std::byte> save() const;
  void restore(std::span<const std::byte> saved);

 private:
  static constexpr int most = robot::max_muscles;
  using Lengths = air::Lanes<most>;
  using Arms = plant::MuscleRouting::MomentArms<most>;

  struct Places {
    std::size_t angle, rate, torque, friction;
  };
  struct Pull {
    air::Muscle muscle;
    ValvePlaces valves;
    std::size_t tension, pressure, length, mass;
    std::optional<air::DrivenMuscle> driven;
    Commanded commanded;
  };

  template <class Visitor>
  void visit(Visitor& v);
  void place_variables(double pressure);
  void place_outputs();
  std::vector<double> angles_after(double step) const;
  void lengths_at(std::span<const double> angles, Lengths& lengths, Arms& arms) const noexcept;
  std::string wrong_at(std::span<const double> angles) const;
  double of_joint(std::size_t joint, bool friction) const noexcept;

  Sheet sheet_;
  robot::Robot robot_;  // only joints and routes
  gas::Air air_;
  gas::Supply supply_;
  std::vector<Pull> pulls_;
  std::vector<Places> at_;  // one per joint
  std::size_t initial_pressure_ = 0;
  std::optional<plant::MuscleRouting> routing_;
  std::vector<double> angles_;  // at the end of the last step [rad]
  Arms arms_{};                 // at these angles [m]
};

}  // namespace sinew::fmu
