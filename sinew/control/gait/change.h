// control/gait/change.h - what is set in place of the plan's while it runs: gains, desired angles
// and stiffnesses, by the list [[change]] of an experiment or by a person who watches.
//
// A change takes effect at the first period start that is not before its time. From there on its
// value stands in place of the plan's, whatever phases, profiles and feedback say, until the run's
// end, the next change of that key, or its release: from then on the plan's own value counts, as it
// stands at that moment. The plan goes on underneath and learns nothing of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/robot/robot.h"

namespace sinew::gait {

struct Desired;
struct Plan;

struct Change {
  double time = 0;                // [s]
  std::string key;                // "control.gains.hip.angle", "control.angle.knee"
  double value = robot::not_set;  // in the key's SI unit
  bool release = false;           // no value: the plan's own again
  std::string leg;                // whose; empty: every leg's
};

// What can be changed, one for each key; its place in settings() is its number.
struct Setting {
  // Names what of a joint is set.
  enum class What { angle, stiffness, angle_gain, stiffness_gain, velocity_gain };
  static constexpr double most = 1e6;  // that is taken, in the key's SI unit

  std::string key;
  std::string_view unit;  // SI
  std::size_t joint = 0;  // of the robot's
  What what = What::stiffness;
};

// Five for each driven joint, in the robot's order.
std::vector<Setting> settings(const Plan& plan);

// SI; by the key alone, "" where it is none.
std::string_view unit_of_setting(std::string_view key);

// Place of the key in the list, or -1.
int find_setting(const std::vector<Setting>& settings, std::string_view key);

// The value that a setting has there  [its SI unit].
double& value_of(const Setting& setting, Desired& desired) noexcept;
double value_of(const Setting& setting, const Desired& desired) noexcept;

// The changes that stand in place of a leg's plan. They take no heap after construction.
class Overrides {
 public:
  static constexpr std::size_t most = 5 * robot::max_leg_joints;

  // Lists the settings of the plan's joints.
  explicit Overrides(const Plan& plan);

  // Both by the setting's number, which is below settings().size().
  void set(std::size_t setting, double value) noexcept { slots_[setting] = {true, value}; }
  void release(std::size_t setting) noexcept { slots_[setting].given = false; }

  // Is that one set in place of the plan's? And what can be set at all, by number.
  bool given(std::size_t setting) const noexcept { return slots_[setting].given; }
  const std::vector<Setting>& settings() const noexcept { return settings_; }

  // Puts what is set into the plan's word.
  void apply(Desired& desired) const noexcept;

  // The value that is set of each setting, by its number. Copied like bytes.
  struct Slot {
    bool given = false;
    double value = 0;
  };
  using State = std::array<Slot, most>;
  const State& state() const noexcept { return slots_; }
  void restore(const State& state) noexcept { slots_ = state; }

 private:
  std::vector<Setting> settings_;
  State slots_{};
};

}  // namespace sinew::gait
