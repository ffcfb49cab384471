// fmu/muscle/joint.h - joints with their muscles and valves, for a body that somebody else moves:
// angles, rates and currents of the valves in, torques out.
//
//   L_m = mount - sum_k s_k S_k(theta_k)        T_k = sum_m s_k r_k(theta_k) F_m
//
// with the cams of mechanism/planar/muscle_routing.h. Over a step the angles run straight from
// where they are to angle + rate x step; each muscle's length runs straight between its lengths at
// the two ends. Torque > 0 raises the angle. Gravity, stops, damping and dry friction of the joint
// are the body's; `friction` is the bound of what the muscles' meshes add to it.
//
// Each muscle is fed at the supply's pressure: a tank that several muscles empty is refused.
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

  // Takes the model that the description tells of. Throws std::exception for what is wrong with it.
  explicit Joint(const Description& description);
  // Describes the named joints of a robot with every muscle that crosses one of them; `muscles` are
  // the robot's, in its order. Throws std::invalid_argument for a joint that there is not, for one
  // without muscles, for a muscle that crosses a joint that is not named, and for a tank.
  static Description describe(const robot::Robot& robot, const std::vector<air::Muscle>& muscles,
                              const std::vector<std::string>& joints, const gas::Air& air,
                              const gas::Supply& supply, double pressure);

  // The variables, with the values of those that are set.
  const Sheet& sheet() const { return sheet_; }
  Sheet& sheet() { return sheet_; }

  // Throws std::exception for parameters that do not go together, and for angles at which a muscle
  // would be longer or shorter than it can be.
  void begin();
  double output(std::size_t place) const;
  std::string wrong(double step) const;
  const char* advance(double end, double step) noexcept;
  double last() const noexcept { return units::unbounded; }

  // The model's own state as bytes, and back.
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
  robot::Robot robot_;  // joints and routes alone
  gas::Air air_;
  gas::Supply supply_;
  std::vector<Pull> pulls_;
  std::vector<Places> at_;  // by joint
  std::size_t initial_pressure_ = 0;
  std::optional<plant::MuscleRouting> routing_;
  std::vector<double> angles_;  // where the last step ended [rad]
  Arms arms_{};                 // there [m]
};

}  // namespace sinew::fmu
