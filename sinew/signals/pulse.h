// signals/pulse.h - effective opening time of a slow valve for one electrical pulse of a duty
// cycle.
//
// The coil is on for duty * period; the valve opens `opening_delay` after the coil is switched on
// and shuts `closing_delay` after it is switched off [thesis 3.4]:
//
//   open = 0                       if duty * period < opening_delay        (never opens)
//        = period                  if (1 - duty) * period < closing_delay  (never shuts)
//        = duty * period - opening_delay + closing_delay   otherwise
//
// Example [3.4]: with 4 ms and 1 ms, 50 % becomes 42.5 % at 25 Hz, and 35 % at 50 Hz (the text
// rounds 42.5 to 43). All times have the same unit, for steady trains of equal pulses. For pages,
// calculators and tests; the loop does not use it, since the body has the delays.
#pragma once

#include <concepts>

namespace sinew::signals {

// Returns the time for which a valve is open in each period, for a duty and its delays, all in the
// same unit of time.
template <std::floating_point Real>
constexpr Real delivered_open_time(Real duty, Real period, Real opening_delay,
                                   Real closing_delay) noexcept {
  const Real on = duty * period;
  const Real off = period - on;
  if (!(on > Real(0)) || on < opening_delay) return Real(0);
  if (!(off > Real(0)) || off < closing_delay) return period;
  const Real open = on - opening_delay + closing_delay;
  return open < period ? open : period;
}

// Returns the same as a duty, 0 to 1.
template <std::floating_point Real>
constexpr Real delivered_duty(Real duty, Real period, Real opening_delay,
                              Real closing_delay) noexcept {
  return delivered_open_time(duty, period, opening_delay, closing_delay) / period;
}

}  // namespace sinew::signals
