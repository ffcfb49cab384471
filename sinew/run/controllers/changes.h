// run/controllers/changes.h - overrides of the plan's setpoints: first by the plan's own list of
// changes, then by steering. Both take effect at the start of a period; steered changes are
// recorded.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sinew/control/gait/change.h"
#include "sinew/control/gait/gait_controller.h"
#include "sinew/control/gait/plan.h"
#include "sinew/robot/legs.h"
#include "sinew/run/controllers/steering.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

class Changes {
 public:
  static constexpr std::size_t most = 1 << 16;  // steered changes that can be recorded in a run

  // `legs` are those of the robot. `steering` may be null and must outlive this object.
  Changes(const gait::Plan& plan, std::span<const robot::LegParts> legs, Steering* steering);

  // Applies the changes to the setpoints of all legs at the start of a period, before the high
  // level passes them on.
  void apply(signals::Tick t, std::span<gait::Desired> legs) noexcept;

  // Requests a change that takes effect at the start of the next period, after the plan's own
  // changes. A later request for the same setting and leg replaces it. Returns false, without
  // effect, if the setting or the leg does not exist.
  bool request_change(const Steering::Request& request) noexcept;

  // Returns the plan's list, followed by the steered changes with the times at which they took
  // effect.
  std::vector<gait::Change> all() const;

  // Returns the settings that can be changed, by number.
  const std::vector<gait::Setting>& settings() const noexcept {
    return overrides_.front().settings();
  }

  // The complete state, copied as bytes. The record of steered changes is a log and not part of the
  // state.
  struct Waiting {
    bool given = false;
    Steering::Request request;
  };
  using WaitingOfLegs = std::array<std::array<Waiting, gait::Overrides::most>, robot::max_legs>;
  struct State {
    std::array<gait::Overrides::State, robot::max_legs> overrides{};  // one per leg
    std::size_t next = 0;                                             // index in the plan's list
    WaitingOfLegs waiting{};
    bool waits = false;  // whether any of them is given
  };
  State state() const noexcept;
  void restore(const State& state) noexcept;

 private:
  struct Due {
    signals::Tick at = 0;
    Steering::Request request;
  };
  bool is_there(const Steering::Request& request) const noexcept;
  // Returns whether a request applies to the leg.
  static bool is_of(const Steering::Request& request, std::size_t leg) noexcept {
    return request.leg < 0 || static_cast<std::size_t>(request.leg) == leg;
  }
  void override_setting(const Steering::Request& request, std::size_t leg) noexcept;
  void override_setting(const Steering::Request& request) noexcept;
  void apply_waiting() noexcept;

  std::vector<gait::Change> planned_;
  std::vector<std::string> legs_;           // their names
  std::vector<gait::Overrides> overrides_;  // one per leg
  Steering* steering_;
  std::vector<Due> due_;  // the plan's list, sorted by time
  State state_;           // without the overrides
  std::vector<Due> steered_;
};

}  // namespace sinew::run
