// run/simulation/node_bounds.h - how far a machine in a lane of a batch may be integrated ahead of
// its controllers.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

// Computes the time up to which a machine's nodes may be committed before a tick is visited. It is
// the time to which the tick's first access to the machine would commit them. A later bound would
// extrapolate readings from another node than run() does.
class NodeBounds {
 public:
  explicit NodeBounds(const signals::Scan& scan) : period_(scan.period), lag_(scan.period, none) {
    for (const signals::Conversion& c : scan.conversions)
      if (c.read < scan.period)
        lag_[c.read] = std::max(lag_[c.read], static_cast<signals::Tick>(c.read - c.start));
  }

  // `drives`: whether a valve is driven at t, before the conversions. Ticks must not decrease.
  double before(signals::Tick t, bool samples, bool drives) noexcept {
    while (t - start_ >= period_) start_ += period_;
    const signals::Tick of_period = t - start_, lag = lag_[static_cast<std::size_t>(of_period)];
    if (lag != none && !(drives && of_period != 0)) return seconds(t - lag);
    if (of_period == 0 && !samples) return nothing;  // usually the high level's commands only
    return before(seconds(t));                       // an edge at t: all nodes before it
  }

  static constexpr double nothing = -std::numeric_limits<double>::max();

 private:
  static constexpr signals::Tick none = -1;
  // Returns the next smaller number; of 0 or a negative number, `nothing`.
  static double before(double x) {
    return x > 0 ? std::bit_cast<double>(std::bit_cast<std::int64_t>(x) - 1) : nothing;
  }
  static double seconds(signals::Tick t) { return static_cast<double>(t) * signals::tick_seconds; }

  signals::Tick period_, start_ = 0;  // start of the present period
  std::vector<signals::Tick> lag_;    // for the conversions read at a tick of the period
};

}  // namespace sinew::run
