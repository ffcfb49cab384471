// config/valve_timing.h - reader of predict.dat: instants at which the PWM opens and closes a
// valve.
//
// The file has 101 rows `duty,close,open`, with duty 0, 1 … 100 % and instants in ticks of the PWM
// period.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::config {

struct ValveTiming {
  static constexpr int rows = 101;
  static constexpr std::uint16_t never = 101;  // later than the end of the period

  std::array<std::uint16_t, rows> closing{};  // [ticks], indexed by duty in percent
  std::array<std::uint16_t, rows> opening{};  // [ticks]
};

// Read a file or a text; throw Error.
ValveTiming read_valve_timing(const std::string& path);
ValveTiming parse_valve_timing(std::string_view text, const std::string& name);

}  // namespace sinew::config
