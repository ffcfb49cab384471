#include "sinew/recording/wrap.h"

#include <fmt/format.h>

#include <cmath>

namespace sinew::recording {

double Unwrapper::operator()(double time) {
  if (count_ > 1 && time < last_) {
    if (const std::optional<double> range = range_of(time)) {
      added_ += *range;
      ++wraps_;
      last_ = time;  // the step stays that before the wrap
      return time + added_;
    }
  }
  if (count_ > 0 && time != last_) step_ = time - last_;
  ++count_;
  last_ = time;
  return time + added_;
}

// Returns the counter's range if it was near its end before the step back and is near its start
// now.
std::optional<double> Unwrapper::range_of(double time) const {
  constexpr int widths[] = {8, 16, 24, 32, 53, 64};
  constexpr double units[] = {1, 1e-3, 1e-6, 1e-9};
  if (!(step_ > 0)) return std::nullopt;
  for (const int bits : widths) {
    for (const double unit : units) {
      const double range = std::ldexp(unit, bits);
      const bool as_far = std::abs(range - (last_ - time) - step_) <= step_;
      const double begin = time < 0 ? -range / 2 : 0;
      const bool at_ends = time >= begin && time - begin <= 2 * step_;
      // Fewer samples per turn do not determine the range.
      if (!as_far || !at_ends || range < 16 * step_) continue;
      bits_ = bits;
      return range;
    }
  }
  return std::nullopt;
}

std::string wraps_text(std::string_view column, const Unwrapper& clock) {
  return fmt::format("{}: a counter of {} bits wrapped {}; its times continue", column,
                     clock.bits(),
                     clock.wraps() == 1 ? "once" : fmt::format("{} times", clock.wraps()));
}

}  // namespace sinew::recording
