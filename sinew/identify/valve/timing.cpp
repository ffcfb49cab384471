#include "sinew/identify/valve/timing.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/gas/pulse.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

CompensatedTiming compensated(double opening_delay, double closing_delay, double frequency) {
  constexpr int period = signals::max_duty;
  constexpr std::uint16_t never = period + 1;
  const double tick = 1.0 / (period * frequency);
  const int lead = static_cast<int>(std::lround(opening_delay / tick));
  if (lead >= period)
    throw Refusal(
        "delays",
        fmt::format("{:.3g} ms until it opens, at {:g} Hz", 1e3 * opening_delay, frequency),
        "less than the period of the pulses", "a lower frequency");
  const auto open = static_cast<std::uint16_t>(period - lead);

  // The coil is on from `open` of the last period to `close` of this one, with at least a tick off
  // between.
  const auto delivered = [&](int close) {
    const int on = close >= never ? period : std::min(close + lead, period - 1);
    return gas::delivered_duty(static_cast<double>(on) / period, period * tick, opening_delay,
                               closing_delay);
  };

  CompensatedTiming out;
  out.timing.closing[0] = 0;
  out.timing.opening[0] = never;
  int close = 0;  // does not decrease with the duty
  for (unsigned duty = 1; duty <= signals::max_duty; ++duty) {
    const double wanted = static_cast<double>(duty) / period;
    const auto error = [&](int c) { return std::abs((c == 0 ? 0.0 : delivered(c)) - wanted); };
    int best = close;
    for (int c = close; c <= never; ++c)  // closing in the last tick would have no effect
      if (c != period && error(c) < error(best) - 1e-9) best = c;
    if (delivered(best) >= 1) best = never;  // instead of a gap that is too short
    close = best;
    out.timing.closing[duty] = static_cast<std::uint16_t>(close);
    out.timing.opening[duty] = close == 0 ? never : open;
    out.delivered[duty] = close == 0 ? 0.0 : delivered(close);
    out.worst = std::max(out.worst, error(close));
  }
  return out;
}

std::string predict_dat(const signals::ValveTiming& timing) {
  std::string out;
  for (unsigned duty = 0; duty <= signals::max_duty; ++duty)
    out += fmt::format("{},{},{}\n", duty, timing.closing[duty], timing.opening[duty]);
  return out;
}

}  // namespace sinew::identify
