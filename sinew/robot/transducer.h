// robot/transducer.h - what the stand's controller reads and what a rig writes down: a
// quantity by a 12-bit converter, with the errors that a transducer has.
//
//   x'     = scale x + offset + noise
//   counts = round(4095 (x' - low)/(high - low)),  clipped to 0 ... 4095
//   shown  = low + counts (high - low)/4095, to the nearest multiple of `resolution`
//
//   low, high  of the converter's range, in the quantity's SI unit     noise  of x', rms
//   scale      1 if it is calibrated well [-]     offset  what it reads of nothing
//   resolution of a dial or a display; 0: the counts are all there is
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "sinew/signals/port.h"

namespace sinew::robot {

struct Transducer {
  // Pressure is gauge; the force is what a load cell between actuator and load sees.
  enum class Of { length, force, pressure, acceleration };

  std::string name;
  Of of = Of::length;
  double low = 0, high = 0;  // [m] [N] [Pa] [m/s^2]
  double noise = 0;          // standard deviation, the same unit
  double scale = 1;          // [-]
  double offset = 0;         // the same unit
  double resolution = 0;     // the same unit
};

// `noise`: of unit standard deviation, robot::noise.
inline std::uint16_t counts(const Transducer& t, double quantity, double noise) noexcept {
  const double read = t.scale * quantity + t.offset + t.noise * noise;
  const double share = (read - t.low) / (t.high - t.low);
  const double bounded = share < 0 ? 0.0 : share > 1 ? 1.0 : share;
  return static_cast<std::uint16_t>(bounded * signals::max_counts + 0.5);
}

// What the counts stand for, by who believes in the transducer; half a count is the error of
// rounding.
inline double quantity(const Transducer& t, double counts) noexcept {
  return t.low + counts / signals::max_counts * (t.high - t.low);
}

// What somebody writes down who reads it.
inline double shown(const Transducer& t, double counts) noexcept {
  const double value = quantity(t, counts);
  return t.resolution > 0 ? t.resolution * std::round(value / t.resolution) : value;
}

}  // namespace sinew::robot
