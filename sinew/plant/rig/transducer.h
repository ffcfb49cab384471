// plant/rig/transducer.h - what the stand's controller reads: a quantity by a 12-bit converter.
//
//   counts = round(4095 (x - low)/(high - low) + noise),  clipped to 0 ... 4095
//
//   low, high  of the converter's range, in the quantity's SI unit     noise  of it, rms
#pragma once

#include <cstdint>
#include <string>

#include "sinew/signals/port.h"

namespace sinew::plant {

struct Transducer {
  // Pressure is gauge; the force is what a load cell between actuator and load sees.
  enum class Of { length, force, pressure, acceleration };

  std::string name;
  Of of = Of::length;
  double low = 0, high = 0;  // [m] [N] [Pa] [m/s^2]
  double noise = 0;          // standard deviation, the same unit
};

// `noise`: of unit standard deviation, robot::noise.
inline std::uint16_t counts(const Transducer& t, double quantity, double noise) noexcept {
  const double share = (quantity + t.noise * noise - t.low) / (t.high - t.low);
  const double bounded = share < 0 ? 0.0 : share > 1 ? 1.0 : share;
  return static_cast<std::uint16_t>(bounded * signals::max_counts + 0.5);
}

// What the counts stand for; half a count is the error of rounding.
inline double quantity(const Transducer& t, double counts) noexcept {
  return t.low + counts / signals::max_counts * (t.high - t.low);
}

}  // namespace sinew::plant
