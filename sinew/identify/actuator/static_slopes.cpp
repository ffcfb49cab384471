#include "sinew/identify/actuator/static_slopes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/tension_slopes.h"
#include "sinew/identify/actuator/static_fit.h"

namespace sinew::identify {

namespace {

// A muscle's own value of a parameter is the reference's, multiplied with this power of the
// ratio of the rest lengths.
constexpr std::pair<FreeParameter, int> powers[] = {
    {FreeParameter::thread_length, 1},     {FreeParameter::turns, 1},
    {FreeParameter::saturation_length, 1}, {FreeParameter::bladder_rest_length, 1},
    {FreeParameter::stiffness, -1},        {FreeParameter::toe, -1},
    {FreeParameter::quadratic, -2},        {FreeParameter::cubic, -3}};

}  // namespace

MuscleLaw::MuscleLaw(const StaticSetting& setting, const StaticScales& scales, double labelled)
    : own_{.actuator = scaled(setting, scales, labelled)},
      rest_length_(rest_length_of(setting, labelled)),
      atmosphere_(scales.atmosphere) {
  for (const auto& [free_parameter, power] : powers)
    multiples_.push_back({free_parameter, power * value_of(own_, free_parameter),
                          std::pow(rest_length_ / scales.rest_length, power)});
}

double MuscleLaw::force(double length, const StaticPoint& point) const {
  return law_force(own_.actuator, length, point, atmosphere_);
}

void MuscleLaw::write_slopes(double length, const StaticPoint& point, double force,
                             ForceSlopes& out) const {
  const actuator::Actuator& a = own_.actuator;
  const double branch = static_cast<int>(point.branch);
  actuator::Actuator& by = out.by_parameter.actuator;
  const double felt = point.pressure - branch * actuator::half_width(a, length, point.pressure);
  const auto [by_length, by_pressure] =
      actuator::tension_slopes(a, length, felt, atmosphere_, force, by);
  by.hysteresis.half_width = -branch * by_pressure;
  by.hysteresis.width_per_pressure = -branch * by_pressure * std::max(point.pressure, 0.0);
  out.by_length = by_length;
  out.by_parameter.end_loss = -by.effectiveness.scale / rest_length_;
  double by_ratio = by.effectiveness.scale * (1 - a.effectiveness.scale) +
                    by.taper.rest_length * a.taper.rest_length;
  for (const Multiple& m : multiples_) {
    double& slope = value_of(out.by_parameter, m.free_parameter);
    by_ratio += m.grows * slope;
    slope *= m.factor;
  }
  out.by_rest_length = by_ratio / rest_length_;
}

}  // namespace sinew::identify
