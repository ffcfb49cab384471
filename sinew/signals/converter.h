// signals/converter.h - the analogue-to-digital converter: 12 bits over 0 to 5 V [4.1, 5.2].
//
//   counts = floor(volts / 5 V * 4096), clipped to 0 .. 4095
//
// An ideal converter: the clip is the only fault it has. It is real and matters - a tension of more
// than 5 V / (0.17 V/lbf) = 29.4 lbf reads as 29.4 lbf (thesis 4.4, 6.3).
#pragma once

#include <concepts>
#include <cstdint>

namespace sinew::signals {

inline constexpr int converter_bits = 12;
inline constexpr std::uint16_t max_counts = (1u << converter_bits) - 1;  // 4095
inline constexpr float converter_full_scale = 5.0f;                      // [V] at 4096 counts

// A simulated sensor asks in double, a bench tool on the controller in float.
template <std::floating_point Real>
constexpr std::uint16_t to_counts(Real volts) noexcept {
  const Real scaled = volts * (Real(max_counts + 1) / Real(converter_full_scale));
  if (!(scaled > Real(0))) return 0;  // also what is not a number
  if (scaled >= Real(max_counts)) return max_counts;
  return static_cast<std::uint16_t>(scaled);
}

// The lower edge of the step that reads `counts`.
template <std::floating_point Real>
constexpr Real to_volts(std::uint16_t counts) noexcept {
  return Real(counts) * (Real(converter_full_scale) / Real(max_counts + 1));
}

}  // namespace sinew::signals
