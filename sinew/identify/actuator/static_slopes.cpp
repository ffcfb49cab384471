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

// Tension of an actuator at one length and pressure, with its derivatives.
struct TensionAt {
  double tension;
  StaticSetting by;
  actuator::TensionSlopes slopes;

  TensionAt(const actuator::Actuator& a, double length, double pressure, double atmosphere)
      : tension(actuator::clamped_tension(a, length, 0, pressure, atmosphere)),
        slopes(actuator::tension_slopes(a, length, pressure, atmosphere, tension, by.actuator)) {}
};

// Adds `share` times the derivatives of the pulling pressure (hysteresis.h) at a length and a
// pressure. Mixed second derivatives of the tension are differences over the pressure.
void add_pulling_slopes(const actuator::Actuator& a, double length, double pressure,
                        double atmosphere, double share, ForceSlopes& out) {
  const double step = 1e-4 * pressure;
  TensionAt low(a, length, pressure - step, atmosphere),
      high(a, length, pressure + step, atmosphere);
  const auto slope = [&, by_pressure = 0.5 * (low.slopes.by_pressure + high.slopes.by_pressure),
                      tension = 0.5 * (low.tension + high.tension)](double at_low, double at_high) {
    const double mixed = 0.5 * (at_high - at_low) / step;
    return share * (0.5 * (at_low + at_high) - tension * mixed / by_pressure) / by_pressure;
  };
  const auto add = [&](auto place) {
    place(out.by_parameter) += slope(place(low.by), place(high.by));
  };
  for (int q = 0; q <= static_cast<int>(FreeParameter::toe); ++q)
    add([q](StaticSetting& s) -> double& { return value_of(s, static_cast<FreeParameter>(q)); });
  add([](StaticSetting& s) -> double& { return s.actuator.effectiveness.scale; });
  add([](StaticSetting& s) -> double& { return s.actuator.taper.rest_length; });
  out.by_length += slope(low.slopes.by_length, high.slopes.by_length);
}

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
  const double p = point.pressure;
  const double felt = p - branch * actuator::half_width(a, length, p, atmosphere_);
  const auto [by_length, by_pressure] =
      actuator::tension_slopes(a, length, felt, atmosphere_, force, by);
  out.by_length = by_length;
  by.hysteresis = {};
  out.by_parameter.end_loss = 0;
  if (branch != 0) {
    const double by_width = -branch * by_pressure, share = a.hysteresis.width_per_tension;
    const double pulls = actuator::pulling_pressure(a, length, p, atmosphere_);
    if (share > 0 && pulls > 0) {
      if (pulls < actuator::most_pulling_pressure(a, p))
        add_pulling_slopes(a, length, p, atmosphere_, by_width * share, out);
      else
        by.effectiveness.threshold -= 2 * by_width * share;
    }
    by.hysteresis = {.half_width = by_width,
                     .width_per_pressure = by_width * std::max(p, 0.0),
                     .width_per_tension = by_width * pulls};
  }
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
