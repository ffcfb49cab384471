// units/dimension.h - physical dimension of a unit, as exponents of eight base dimensions.
//
// Angle and count are dimensions here although SI treats them as plain numbers: "0.9 %/count" and
// "35 lbf in/rad" are gains and stiffnesses whose denominator must not be lost.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sinew::units {

struct Dimension {
  std::int8_t mass = 0;         // kg
  std::int8_t length = 0;       // m
  std::int8_t time = 0;         // s
  std::int8_t temperature = 0;  // K
  std::int8_t angle = 0;        // rad
  std::int8_t count = 0;        // count
  std::int8_t voltage = 0;      // V
  std::int8_t current = 0;      // A

  constexpr bool operator==(const Dimension&) const = default;
};

// Returns a times b to the power n (n = -1 divides).
constexpr Dimension combine(Dimension a, Dimension b, int n = 1) {
  const auto sum = [n](std::int8_t x, std::int8_t y) {
    return static_cast<std::int8_t>(x + n * y);
  };
  return {sum(a.mass, b.mass),       sum(a.length, b.length),
          sum(a.time, b.time),       sum(a.temperature, b.temperature),
          sum(a.angle, b.angle),     sum(a.count, b.count),
          sum(a.voltage, b.voltage), sum(a.current, b.current)};
}

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension mass{.mass = 1};
inline constexpr Dimension length{.length = 1};
inline constexpr Dimension time{.time = 1};
inline constexpr Dimension temperature{.temperature = 1};
inline constexpr Dimension angle{.angle = 1};
inline constexpr Dimension count{.count = 1};
inline constexpr Dimension voltage{.voltage = 1};
inline constexpr Dimension current{.current = 1};
inline constexpr Dimension resistance{.voltage = 1, .current = -1};
inline constexpr Dimension inductance{.time = 1, .voltage = 1, .current = -1};
inline constexpr Dimension area{.length = 2};
inline constexpr Dimension volume{.length = 3};
inline constexpr Dimension frequency{.time = -1};
inline constexpr Dimension acceleration{.length = 1, .time = -2};
inline constexpr Dimension force{.mass = 1, .length = 1, .time = -2};
inline constexpr Dimension pressure{.mass = 1, .length = -1, .time = -2};
inline constexpr Dimension energy{.mass = 1, .length = 2, .time = -2};
inline constexpr Dimension power{.mass = 1, .length = 2, .time = -3};
}  // namespace dimension

// Name of a dimension in messages: "kg (mass)".
struct DimensionName {
  Dimension dimension;
  std::string_view unit;
  std::string_view word;
};

inline constexpr std::array dimension_names = {
    DimensionName{dimension::none, "1", "number"},
    DimensionName{dimension::mass, "kg", "mass"},
    DimensionName{dimension::length, "m", "length"},
    DimensionName{dimension::time, "s", "time"},
    DimensionName{dimension::temperature, "K", "temperature"},
    DimensionName{dimension::angle, "rad", "angle"},
    DimensionName{dimension::count, "count", "count"},
    DimensionName{dimension::voltage, "V", "voltage"},
    DimensionName{dimension::current, "A", "current"},
    DimensionName{dimension::resistance, "ohm", "resistance"},
    DimensionName{dimension::inductance, "H", "inductance"},
    DimensionName{dimension::area, "m2", "area"},
    DimensionName{dimension::volume, "m3", "volume"},
    DimensionName{dimension::frequency, "1/s", "frequency"},
    DimensionName{dimension::acceleration, "m/s2", "acceleration"},
    DimensionName{dimension::force, "N", "force"},
    DimensionName{dimension::pressure, "Pa", "pressure"},
    DimensionName{dimension::energy, "N m", "torque or energy"},
    DimensionName{dimension::power, "W", "power"},
    DimensionName{{.length = 1, .time = -1}, "m/s", "speed"},
    DimensionName{{.time = -1, .angle = 1}, "rad/s", "angular speed"},
    DimensionName{{.mass = 1, .time = -2}, "N/m", "stiffness"},
    DimensionName{{.mass = 1, .time = -1}, "N s/m", "damping, or kg/s mass flow"},
    DimensionName{{.mass = 1, .length = 2, .time = -2, .angle = -1}, "N m/rad", "joint stiffness"},
    DimensionName{{.mass = 1, .length = 2, .time = -1, .angle = -1}, "N m s/rad", "joint damping"},
    DimensionName{{.mass = 1, .length = 2}, "kg m2", "moment of inertia"},
};

}  // namespace sinew::units
