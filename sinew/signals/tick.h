// signals/tick.h - time in ticks of the controller.
#pragma once

#include <cstdint>

namespace sinew::signals {

using Tick = std::int64_t;  // 100 us periods since the start of the run

inline constexpr double tick_seconds = 1e-4;              // [s]
inline constexpr std::int64_t tick_nanoseconds = 100000;  // [ns]

}  // namespace sinew::signals
