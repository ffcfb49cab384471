// robot/transducer.h - readings of the stand's controller or of a rig: a quantity by a 12-bit
// converter, with the errors of a transducer.
//
//   x'     = scale x + offset + noise
//   counts = round(4095 (x' - low)/(high - low)),  clipped to 0 ... 4095
//   shown  = low + counts (high - low)/4095, to the nearest multiple of `resolution`
//
//   low, high  limits of the converter, in the quantity's SI unit     noise  rms noise of x'
//   scale      1 if calibrated correctly [-]     offset  reading at zero
//   resolution of a dial or a display; 0: that of the counts
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "sinew/signals/port.h"

namespace sinew::robot {

struct Transducer {
  // Pressure is gauge; the force is that of a load cell between actuator and load.
  enum class Of { length, force, pressure, acceleration };

  std::string name;
  Of of = Of::length;
  double low = 0, high = 0;  // [m] [N] [Pa] [m/s^2]
  double noise = 0;          // standard deviation, same unit
  double scale = 1;          // [-]
  double offset = 0;         // reading at zero, same unit
  double resolution = 0;     // step of the display, same unit
};

// Returns the counts of a quantity. `noise`: of unit standard deviation, robot::noise.
inline std::uint16_t counts(const Transducer& t, double quantity, double noise) noexcept {
  const double read = t.scale * quantity + t.offset + t.noise * noise;
  const double share = (read - t.low) / (t.high - t.low);
  const double bounded = share < 0 ? 0.0 : share > 1 ? 1.0 : share;
  return static_cast<std::uint16_t>(bounded * signals::max_counts + 0.5);
}

// Returns the quantity that the counts represent by the transducer's nominal range; rounding has an
// error of up to half a count.
inline double quantity(const Transducer& t, double counts) noexcept {
  return t.low + counts / signals::max_counts * (t.high - t.low);
}

// Returns the value as read from the display.
inline double shown(const Transducer& t, double counts) noexcept {
  const double value = quantity(t, counts);
  return t.resolution > 0 ? t.resolution * std::round(value / t.resolution) : value;
}

}  // namespace sinew::robot
