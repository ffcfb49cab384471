// run/controllers/changes.h - what stands in place of the plan's now: by the plan's own list, then
// by whoever steers. Both take effect at period starts; what was steered is kept.
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
  static constexpr std::size_t most = 1 << 16;  // that can be kept of one run

  // `legs`: those of the robot. `steering` may be null and outlives this.
  Changes(const gait::Plan& plan, std::span<const robot::LegParts> legs, Steering* steering);

  // At a period start, before the high level's word is passed on: what every leg desires.
  void apply(signals::Tick t, std::span<gait::Desired> legs) noexcept;

  // A wish of whoever holds the run: followed at the next period start, behind the plan's own
  // changes; a later one of the same setting and leg stands in its place. False, and nothing done,
  // for a setting or a leg that there is not.
  bool wish(const Steering::Wish& wish) noexcept;

  // The plan's list, and behind it what was steered, at the times at which it took effect.
  std::vector<gait::Change> all() const;

  // Returns what can be changed, by number.
  const std::vector<gait::Setting>& settings() const noexcept {
    return overrides_.front().settings();
  }

  // Everything that later words depend on. Copied like bytes. What was steered so far is no part of
  // it: that is a log.
  struct Waiting {
    bool given = false;
    Steering::Wish wish;
  };
  using WaitingOfLegs = std::array<std::array<Waiting, gait::Overrides::most>, robot::max_legs>;
  struct State {
    std::array<gait::Overrides::State, robot::max_legs> overrides{};  // by leg
    std::size_t next = 0;                                             // of the plan's list
    WaitingOfLegs waiting{};
    bool waits = false;
  };
  State state() const noexcept;
  void restore(const State& state) noexcept;

 private:
  struct Due {
    signals::Tick at = 0;
    Steering::Wish wish;
  };
  bool is_there(const Steering::Wish& wish) const noexcept;
  // Answers whether a wish is for the leg.
  static bool is_of(const Steering::Wish& wish, std::size_t leg) noexcept {
    return wish.leg < 0 || static_cast<std::size_t>(wish.leg) == leg;
  }
  void follow(const Steering::Wish& wish, std::size_t leg) noexcept;
  void follow(const Steering::Wish& wish) noexcept;
  void follow_waiting() noexcept;

  std::vector<gait::Change> planned_;
  std::vector<std::string> legs_;           // their names
  std::vector<gait::Overrides> overrides_;  // by leg
  Steering* steering_;
  std::vector<Due> due_;  // of the plan's list, by time
  std::size_t next_ = 0;
  WaitingOfLegs waiting_{};
  bool waits_ = false;  // one of them is given
  std::vector<Due> steered_;
};

}  // namespace sinew::run
