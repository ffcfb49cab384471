// log/ring.h - what passes between the loop and the log's thread.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/signals/ring.h"

namespace sinew::log {

inline constexpr std::size_t kMaxFields = 4;  // of a topic

// Holds what the loop hands over: one message of a topic.
struct Sample {
  std::int64_t time_ns = 0;
  std::uint16_t topic = 0;
  std::array<double, kMaxFields> values{};
};

using Ring = signals::Ring<Sample>;

}  // namespace sinew::log
