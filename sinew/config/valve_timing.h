// config/valve_timing.h - predict.dat: when the PWM opens and closes a valve for a duty.
//
// 101 rows `duty,close,open`, duty counting 0, 1 … 100 %, the instants in ticks of the PWM period.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::config {

struct ValveTiming {
  static constexpr int rows = 101;
  static constexpr std::uint16_t never = 101;  // later than the period is long

  std::array<std::uint16_t, rows> closing{};  // [ticks], by duty in percent
  std::array<std::uint16_t, rows> opening{};  // [ticks]
};

// Throw Error.
ValveTiming read_valve_timing(const std::string& path);
ValveTiming parse_valve_timing(std::string_view text, const std::string& name);

}  // namespace sinew::config
