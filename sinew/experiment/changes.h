// experiment/changes.h - what stands in place of the plan's now: by the plan's own list, then by
// whoever steers. Both take effect at period starts; what was steered is kept.
#pragma once

#include <span>
#include <vector>

#include "sinew/control/gait/brain.h"
#include "sinew/control/gait/change.h"
#include "sinew/control/gait/plan.h"
#include "sinew/experiment/steering.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

class Changes {
 public:
  static constexpr std::size_t most = 1 << 16;  // that can be kept of one run

  // `steering` may be null and outlives this.
  Changes(const gait::Plan& plan, Steering* steering);

  // At a period start, before the high level's word is passed on: what every leg desires, which one
  // change sets for all of them.
  void apply(signals::Tick t, std::span<gait::Desired> legs) noexcept;

  // The plan's list, and behind it what was steered, at the times at which it took effect.
  std::vector<gait::Change> all() const;

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
  std::vector<Due> steered_;
};

}  // namespace sinew::experiment
