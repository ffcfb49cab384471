#include "sinew/run/bring_up/at_rest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sinew::run {

Rest rest_of(const Recording& r, std::size_t channel) {
  Rest out;
  for (const Sample& s : r.samples) {
    out.mean += s.counts[channel];
    out.bad += s.status[channel] != signals::Status::ok;
    ++out.readings;
  }
  out.mean /= std::max(out.readings, 1);
  for (const Sample& s : r.samples) out.deviation += std::pow(s.counts[channel] - out.mean, 2);
  out.deviation = std::sqrt(out.deviation / std::max(out.readings - 1, 1));
  return out;
}

std::string wrong_with(const robot::Sensor& s, const Rest& rest,
                       const control::SensorLimits& limits, double top, const std::string& wire) {
  const double share = 0.05 * top;
  if (rest.bad > 0)
    return fmt::format("{}: {} of {} readings did not come in time or are none ({})", s.name,
                       rest.bad, rest.readings, wire);
  // A transducer may rest at the scale's end; whether it is alive a muscle will show.
  const bool rests_there = s.assumed_at_rest < 4 || s.assumed_at_rest > top - 4;
  if ((rest.mean < 4 || rest.mean > top - 4) && !rests_there)
    return fmt::format(
        "{} reads {:.0f}, an end of the converter's scale: look at its cable and its "
        "supply ({})",
        s.name, rest.mean, wire);
  if (rest.mean < limits.low || rest.mean > limits.high)
    return fmt::format("{} reads {:.0f}; expected {} to {}: is its cable another's? ({})", s.name,
                       rest.mean, limits.low, limits.high, wire);
  const bool has_zero = s.kind == robot::Sensor::Kind::tension ||
                        s.kind == robot::Sensor::Kind::pressure ||
                        s.kind == robot::Sensor::Kind::angle;
  if (has_zero && std::abs(rest.mean - s.assumed_at_rest) > share)
    return fmt::format(
        "{} reads {:.0f} at rest; expected {:.0f}, within {:.0f}: is it loaded, or "
        "its cable another's? ({}); a robot whose sensor is so says it with "
        "sensor.{}.assumed.at_rest",
        s.name, rest.mean, s.assumed_at_rest, share, wire, s.name);
  return "";
}

}  // namespace sinew::run
