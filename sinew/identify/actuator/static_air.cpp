#include "sinew/identify/actuator/static_air.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/actuator/body.h"

namespace sinew::identify {

double cylinder_volume(double length, double diameter) {
  return 0.25 * std::numbers::pi * diameter * diameter * length;
}

double give_volume(double rest_length, double volume, bool braid_is_known, actuator::Actuator& a) {
  constexpr double most = 1.5;  // corresponds to an effectiveness of two thirds
  a.air.offset = 0;
  const double fitted = actuator::volume(a, rest_length);
  const double kappa = braid_is_known || !(fitted > 0) ? 1 : std::clamp(volume / fitted, 1.0, most);
  a.braid.turns /= std::sqrt(kappa);
  a.wall.thickness *= std::sqrt(kappa);
  for (double* c : {&a.effectiveness.c0, &a.effectiveness.c1, &a.effectiveness.c2}) *c /= kappa;
  // Ignore a difference due to rounding.
  const double left = volume - actuator::volume(a, rest_length);
  if (std::abs(left) > 1e-9 * volume) a.air.offset = left;
  return kappa;
}

AirAtRest air_by_force(const actuator::Actuator& a, double rest_length) {
  constexpr double least = 1.0 / 6, most = 3.6;
  const double v = actuator::volume(a, rest_length);
  return {.volume = v, .low = least * v, .high = most * v};
}

Json to_json(const AirAtRest& air) {
  Json out{{"volume_m3", air.volume}, {"known", air.known}};
  if (!air.known) out.update({{"low_m3", air.low}, {"high_m3", air.high}});
  return out;
}

}  // namespace sinew::identify
