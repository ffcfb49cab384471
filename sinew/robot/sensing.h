// robot/sensing.h - conversion between a quantity and the converter's counts.
#pragma once

#include <cstdint>

#include "sinew/robot/robot.h"
#include "sinew/signals/port.h"

namespace sinew::robot {

// Returns noise of unit standard deviation as a hash of (seed, sensor, tick): without a stream,
// so that more readings, or another order, change nothing. It is the sum of twelve uniform numbers
// minus six, from the 16-bit pieces of three 64-bit hashes; bounded at 6.
double noise(std::uint64_t seed, int sensor, signals::Tick tick);

// A sensor's conversion, with its constants.
class SensorCounts {
 public:
  // A fixed source of 0.
  SensorCounts() = default;
  SensorCounts(const Sensor& sensor, const Converter& converter)
      : at_rest_(sensor.at_rest),
        noise_(sensor.noise),
        scale_(sensor.scale),
        counts_per_volt_(converter.counts_per_volt()),
        top_(converter.top()),
        // A potentiometer's scale is given per volt, a transducer's in volts.
        divides_(sensor.kind == Sensor::Kind::angle || sensor.kind == Sensor::Kind::cylinder),
        constant_(sensor.kind == Sensor::Kind::fixed) {}

  // Returns whether its counts have noise.
  bool noisy() const noexcept { return noise_ > 0; }
  // Returns the converter's counts for the angle [rad] or tension [N] at its input: offset, unit
  // noise (its standard deviation is 1), rounding to the nearest count, and its two ends (4.1, 4.4:
  // tension clips at 29.4 lb).
  std::uint16_t counts(double quantity, double unit_noise) const noexcept {
    double value = at_rest_ + noise_ * unit_noise;
    if (divides_)
      value += quantity / scale_ * counts_per_volt_;
    else if (!constant_)
      value += quantity * scale_ * counts_per_volt_;
    const double bounded = value < 0 ? 0.0 : value > top_ ? top_ : value;
    return static_cast<std::uint16_t>(bounded + 0.5);
  }

 private:
  double at_rest_ = 0, noise_ = 0;  // [count]
  double scale_ = 1;                // as the sensor's
  double counts_per_volt_ = 0, top_ = 0;
  bool divides_ = false, constant_ = true;
};

// Returns the counts of a sensor that is converted once.
inline std::uint16_t counts(const Sensor& sensor, const Converter& converter, double quantity,
                            double noise) {
  return SensorCounts(sensor, converter).counts(quantity, noise);
}

// Linear relation between a sensor's quantity and its counts.
struct SensorLine {
  double at_zero = 0;  // the quantity at `count_at_zero`
  double count_at_zero = 0;
  double counts_per_unit = 0;

  // Return the counts of a quantity, and the quantity of counts.
  double counts(double value) const { return count_at_zero + (value - at_zero) * counts_per_unit; }
  double value(double count) const { return at_zero + (count - count_at_zero) / counts_per_unit; }
};

// Return the line of a muscle's transducer: by its own scale, as in logs; and by the scale that the
// controller assumes for all of them [N].
SensorLine own_tension(const Sensor&, const Converter&);
SensorLine assumed_tension(const Sensor&, const Converter&);

}  // namespace sinew::robot
