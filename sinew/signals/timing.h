// signals/timing.h - switching times of a valve within its period, for each whole percent of duty.
//
// The controller counts ticks from each call of its law: 1 in the tick of the law, 100 in the last
// tick before the next one. A valve that is on is switched off at the first count >= closing[duty];
// a valve that is off is switched on at the first count >= opening[duty]. Usually that is the last
// count, so the pulse of a duty starts with the next period and the duty of *that* period ends it.
//
// The thesis reads the table from `predict.dat` (B.1; the file is lost). Two tables:
//
//   identity      closing = duty, opening = 100; 0 never opens, 100 never closes
//   compensated   closing = duty - closing delay, opening = 100 - opening delay: the valve itself,
//                 not its coil, is open for the duty
#pragma once

#include <array>
#include <cstdint>

namespace sinew::signals {

inline constexpr int max_duty = 100;  // [%]

// The ticks of a period at which a valve shuts and opens, by the percent of its duty.
struct ValveTiming {
  std::array<std::uint16_t, max_duty + 1> closing{},
      opening{};  // [ticks]; beyond the period: never
};

// Returns the timing of a valve without delays.
constexpr ValveTiming identity_timing(std::uint16_t period = 100) noexcept {
  const std::uint16_t never = static_cast<std::uint16_t>(period + 1);
  ValveTiming t;
  for (unsigned duty = 0; duty <= max_duty; ++duty) {
    t.closing[duty] = static_cast<std::uint16_t>(duty * period / max_duty);
    t.opening[duty] = period;
  }
  t.opening[0] = never;
  t.closing[max_duty] = never;
  return t;
}

// Returns the timing of a valve with these delays in whole ticks. A pulse shorter than the closing
// delay ends in the tick of the law.
constexpr ValveTiming compensated_timing(std::uint16_t opening_delay, std::uint16_t closing_delay,
                                         std::uint16_t period = 100) noexcept {
  ValveTiming t = identity_timing(period);
  for (unsigned duty = 1; duty < max_duty; ++duty) {
    std::uint16_t& closing = t.closing[duty];
    closing = static_cast<std::uint16_t>(closing > closing_delay ? closing - closing_delay : 0);
  }
  for (unsigned duty = 1; duty <= max_duty; ++duty) {
    std::uint16_t& opening = t.opening[duty];
    opening = static_cast<std::uint16_t>(opening > opening_delay ? opening - opening_delay : 0);
  }
  return t;
}

// Returns whether with duty 0 a valve closes in the tick of the law and stays shut. Then two
// valves whose duties are never positive together are never on together, whatever the rest of the
// table.
constexpr bool closes_at_zero(const ValveTiming& t, std::uint16_t period = 100) noexcept {
  return t.closing[0] <= 1 && t.opening[0] > period;
}

}  // namespace sinew::signals
