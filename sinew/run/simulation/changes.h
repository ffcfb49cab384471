// run/simulation/changes.h - what stands in place of the plan's now: by the plan's own list, then
// by whoever steers. Both take effect at period starts; what was steered is kept.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sinew/control/gait/change.h"
#include "sinew/control/gait/gait_controller.h"
#include "sinew/control/gait/plan.h"
#include "sinew/run/simulation/steering.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

class Changes {
 public:
  static constexpr std::size_t most = 1 << 16;  // that can be kept of one run

  // `steering` may be null and outlives this.
  Changes(const gait::Plan& plan, Steering* steering);

  // At a period start, before the high level's word is passed on: what every leg desires, which one
  // change sets for all of them.
  void apply(signals::Tick t, std::span<gait::Desired> legs) noexcept;

  // A wish of whoever holds the run: followed at the next period start, behind the plan's own
  // changes; a later one of the same setting stands in its place. False, and nothing done, for a
  // setting that there is not.
  bool wish(const Steering::Wish& wish) noexcept;

  // The plan's list, and behind it what was steered, at the times at which it took effect.
  std::vector<gait::Change> all() const;

  const std::vector<gait::Setting>& settings() const noexcept { return overrides_.settings(); }

  // Everything that later words depend on. Copied like bytes. What was steered so far is no part of
  // it: that is a log.
  struct Waiting {
    bool given = false;
    Steering::Wish wish;
  };
  struct State {
    gait::Overrides::State overrides;
    std::size_t next = 0;  // of the plan's list
    std::array<Waiting, gait::Overrides::most> waiting{};
    bool waits = false;
  };
  State state() const noexcept { return {overrides_.state(), next_, waiting_, waits_}; }
  void restore(const State& state) noexcept;

 private:
  struct Due {
    signals::Tick at = 0;
    Steering::Wish wish;
  };
  void follow(const Steering::Wish& wish) noexcept;

  std::vector<gait::Change> planned_;
  gait::Overrides overrides_;
  Steering* steering_;
  std::vector<Due> due_;  // of the plan's list, by time
  std::size_t next_ = 0;
  std::array<Waiting, gait::Overrides::most> waiting_{};
  bool waits_ = false;  // one of them is given
  std::vector<Due> steered_;
};

}  // namespace sinew::run
