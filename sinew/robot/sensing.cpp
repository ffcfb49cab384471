#include "sinew/robot/sensing.h"

#include "sinew/units/hash.h"

namespace sinew::robot {

using units::mix;

double noise(std::uint64_t seed, int sensor, signals::Tick tick) {
  const std::uint64_t key =
      mix(seed + 0x9e3779b97f4a7c15ull * static_cast<std::uint64_t>(tick + 1));
  std::uint64_t sum = 0;
  for (std::uint64_t half = 0; half < 3; ++half) {
    std::uint64_t bits = mix(key + 8 * static_cast<std::uint64_t>(sensor) + half);
    for (int piece = 0; piece < 4; ++piece, bits >>= 16) sum += bits & 0xffffu;
  }
  return static_cast<double>(sum) / 65536.0 + 12.0 * 0.5 / 65536.0 - 6.0;
}

SensorLine own_tension(const Sensor& sensor, const Converter& converter) {
  return {.count_at_zero = sensor.assumed_at_rest,
          .counts_per_unit = sensor.scale * converter.counts_per_volt()};
}

SensorLine assumed_tension(const Sensor& sensor, const Converter& converter) {
  return {.count_at_zero = sensor.assumed_at_rest,
          .counts_per_unit = sensor.assumed_scale * converter.counts_per_volt()};
}

}  // namespace sinew::robot
