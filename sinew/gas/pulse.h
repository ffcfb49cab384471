// gas/pulse.h - effective opening time of a slow valve for one electrical pulse of a duty
// cycle.
//
// The coil is on for duty * period; the valve opens `opening_delay` after the coil is switched on
// and shuts `closing_delay` after it is switched off [thesis 3.4]:
//
//   open = 0                       if duty * period <= opening_delay        (never opens)
//        = period                  if (1 - duty) * period <= closing_delay  (never shuts)
//        = duty * period - opening_delay + closing_delay   otherwise
//
// Example [3.4]: with 4 ms and 1 ms, 50 % becomes 42.5 % at 25 Hz, and 35 % at 50 Hz (the text
// rounds 42.5 to 43). Times are equal within the tolerance of a shutter (delay.h). For steady
// trains of equal pulses, in pages, calculators and tests; the loop does not use it, since the body
// has the delays.
#pragma once

#include "sinew/gas/delay.h"

namespace sinew::gas {

// Returns the time for which a valve is open in each period, for a duty, the period and its delays
// [s].
constexpr double delivered_open_time(double duty, double period, double opening_delay,
                                     double closing_delay) noexcept {
  const double on = duty * period;
  const double off = period - on;
  if (!(on > 0) || (opening_delay > 0 && on <= opening_delay + Shutter::simultaneous)) return 0;
  if (!(off > 0) || (closing_delay > 0 && off <= closing_delay + Shutter::simultaneous))
    return period;
  const double open = on - opening_delay + closing_delay;
  return open < period ? open : period;
}

// Returns the same as a duty, 0 to 1.
constexpr double delivered_duty(double duty, double period, double opening_delay,
                                double closing_delay) noexcept {
  return delivered_open_time(duty, period, opening_delay, closing_delay) / period;
}

}  // namespace sinew::gas
