// control/gait/change.h - values that override those of the plan during a run: gains, desired
// angles and stiffnesses, set by the list [[change]] of an experiment or by an operator.
//
// A change takes effect at the first period start at or after its time. From then on its value
// overrides those of phases, profiles and feedback, until the end of the run, the next
// change of that key, or its release: then the plan's current value is in effect again. The plan
// continues during a change and is not affected by it.
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
  double value = robot::not_set;  // in the key's SI unit; not set: no value
  bool release = false;           // true: return to the plan's value
  std::string leg;                // name of the leg; empty: all legs
};

// A value that can be changed; its index in settings() is its number.
struct Setting {
  // Value of a joint that is set.
  enum class What { angle, stiffness, angle_gain, stiffness_gain, velocity_gain };
  static constexpr double most = 1e6;  // largest accepted magnitude, in the key's SI unit

  std::string key;
  std::string_view unit;  // SI unit
  std::size_t joint = 0;  // index in the robot's joints
  What what = What::stiffness;
};

// Returns the settings: five for each driven joint, in the robot's order.
std::vector<Setting> settings(const Plan& plan);

// Returns the SI unit of a key, from its name alone; "" if it is not a setting.
std::string_view unit_of_setting(std::string_view key);

// Returns the index of the key in the list, or -1.
int find_setting(const std::vector<Setting>& settings, std::string_view key);

// Return the value that a setting refers to [its SI unit].
double& value_of(const Setting& setting, Desired& desired) noexcept;
double value_of(const Setting& setting, const Desired& desired) noexcept;

// Changes that override the plan of a leg. No heap is used after construction.
class Overrides {
 public:
  static constexpr std::size_t most = 5 * robot::max_leg_joints;

  // Lists the settings of the plan's joints.
  explicit Overrides(const Plan& plan);

  // Set or release a setting by its number, which must be below settings().size().
  void set(std::size_t setting, double value) noexcept { overrides_[setting] = {true, value}; }
  void release(std::size_t setting) noexcept { overrides_[setting].given = false; }

  // Return whether a setting overrides the plan, and the list of all settings.
  bool given(std::size_t setting) const noexcept { return overrides_[setting].given; }
  const std::vector<Setting>& settings() const noexcept { return settings_; }

  // Replaces the plan's values by those that are set.
  void apply(Desired& desired) const noexcept;

  // The value of each setting, by its number. Trivially copyable.
  struct Override {
    bool given = false;
    double value = 0;
  };
  using State = std::array<Override, most>;
  const State& state() const noexcept { return overrides_; }
  void restore(const State& state) noexcept { overrides_ = state; }

 private:
  std::vector<Setting> settings_;
  State overrides_{};
};

}  // namespace sinew::gait
