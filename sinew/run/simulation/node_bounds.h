// run/simulation/node_bounds.h - how far a machine in a lane of a batch may be integrated ahead of
// its controllers.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "sinew/signals/port.h"
#include "sinew/signals/tick.h"

namespace sinew::run {

// Computes the time up to which a machine's nodes may be committed before a tick is visited. It is
// the time to which the tick's first access to the machine would commit them. A later bound would
// extrapolate readings from another node than run() does.
class NodeBounds {
 public:
  // `drives`: whether a valve is driven at t, before the conversions. Ticks must not decrease.
  double before(const signals::Scan& scan, signals::Tick t, bool samples, bool drives) noexcept {
    while (t - start_ >= scan.period) start_ += scan.period;
    const signals::Tick of_period = t - start_, lag = lag_of(scan, of_period);
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
  // Returns the ticks from the first start of the conversions that are read at a tick of the
  // period.
  static signals::Tick lag_of(const signals::Scan& scan, signals::Tick of_period) noexcept {
    signals::Tick longest = none;
    for (const signals::Conversion& c : scan.conversions) {
      const signals::Tick lag = c.read - c.start;
      if (c.read == of_period && lag > longest) longest = lag;
    }
    return longest;
  }

  signals::Tick start_ = 0;  // start of the present period
};

}  // namespace sinew::run
