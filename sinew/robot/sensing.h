// robot/sensing.h - from a quantity to the converter's counts.
#pragma once

#include <cstdint>

#include "sinew/robot/robot.h"
#include "sinew/signals/port.h"

namespace sinew::robot {

// Noise of unit standard deviation as a hash of (seed, sensor, tick): no stream, so that reading
// more, or in another order, changes nothing. Sum of twelve uniform numbers minus six, from the
// sixteen-bit pieces of three 64-bit hashes; bounded at 6.
double noise(std::uint64_t seed, int sensor, signals::Tick tick);

// What the converter reports for the angle [rad] or tension [N] at its input: offset, noise,
// rounding to the nearest count, and its two ends (4.1, 4.4: tension clips at 29.4 lb).
std::uint16_t counts(const Sensor& sensor, const Converter& converter, double quantity,
                     double noise);

}  // namespace sinew::robot
