#include "sinew/identify/actuator/static_slopes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static_fit.h"

namespace sinew::identify {

namespace {

// What a muscle's own value of a knob is the reference's times: its power of the rest lengths'
// ratio.
constexpr std::pair<Knob, int> powers[] = {
    {Knob::thread_length, 1},       {Knob::turns, 1},      {Knob::saturation_length, 1},
    {Knob::bladder_rest_length, 1}, {Knob::stiffness, -1}, {Knob::toe, -1},
    {Knob::quadratic, -2},          {Knob::cubic, -3}};

// How the pressure widens the ends of a taper: the share of the extra gain that is left of it, and
// its slope by the pressure  [-], [1/Pa].
struct Fade {
  double share = 0, slope = 0;

  Fade(const actuator::Taper& taper, double pressure) {
    if (!actuator::tapers(taper)) return;
    share = pressure > 0 ? std::exp(-pressure / taper.extra_pressure) : 1;
    slope = pressure > 0 ? -share / taper.extra_pressure : 0;
  }
};

// Derivatives of the wall's area by thread length, turns and thickness.
void write_wall(const actuator::Actuator& a, double x, double per_area, actuator::Actuator& by) {
  const double t = a.wall.thickness, b = a.braid.thread_length,
               d = actuator::widest_diameter(a.braid);
  const double s = actuator::braid_sine(a.braid, x), pi = std::numbers::pi;
  const double shape = 2 * s - 1 / s;
  by.wall.thickness = per_area * pi * (d * shape - 2 * t);
  if (!(t > 0)) return;
  const double by_sine = s > 0.1 ? x * x / (b * b * b * s) * (2 + 1 / (s * s)) : 0;
  by.braid.thread_length += per_area * pi * t * (d / b * shape + d * by_sine);
  by.braid.turns -= per_area * pi * t * d / a.braid.turns * shape;
}

void write_bladder(const actuator::Bladder& b, double x, double share, actuator::Bladder& by) {
  const double u = actuator::held(b, x) - b.rest_length, v = u / b.saturation_length;
  const double e = v < 0 ? std::exp(v) : 1;
  by.stiffness = share * u;
  by.quadratic = share * u * u;
  by.cubic = share * u * u * u;
  by.saturating_tension = share * (v < 0 ? e - 1 : v);
  by.saturation_length = -share * b.saturating_tension * e * v / b.saturation_length;
}

}  // namespace

MuscleLaw::MuscleLaw(const StaticSetting& setting, const StaticScales& scales, double labelled)
    : own_{.actuator = scaled(setting, scales, labelled)},
      rest_length_(rest_length_of(setting, labelled)),
      atmosphere_(scales.atmosphere) {
  for (const auto& [knob, power] : powers)
    multiples_.push_back(
        {knob, power * value_of(own_, knob), std::pow(rest_length_ / scales.rest_length, power)});
}

double MuscleLaw::force(double length, const StaticPoint& point) const {
  return law_force(own_.actuator, length, point, atmosphere_);
}

void MuscleLaw::write_slopes(double length, const StaticPoint& point, double force,
                             ForceSlopes& out) const {
  const actuator::Actuator& a = own_.actuator;
  const actuator::Effectiveness& e = a.effectiveness;
  const double branch = static_cast<int>(point.branch);
  const double p = point.pressure - branch * a.hysteresis.half_width;
  const double x = length - a.series.compliance * force;
  const double kappa = actuator::taper_gain(a.taper, p), w = actuator::working_length(a, x, p);
  const Fade fade(a.taper, p);

  // What braid and bladder pull with, and its slopes by the length and by the area of the braid.
  const double acting = actuator::acting_pressure(e, p);
  const double eff = actuator::effectiveness(e, p, atmosphere_);
  const double area = actuator::ideal_tension(a.braid, w, 1) + actuator::wall_area(a, w);
  const double by_w =
      acting * eff * (actuator::ideal_stiffness(a.braid, w, 1) + actuator::wall_area_slope(a, w));
  const actuator::BladderPull bladder = actuator::bladder_pull(a.bladder, x);
  const double pull = acting * eff * area + bladder.tension;
  const actuator::ToePull toe = actuator::toe_pull(a.toe, pull);
  const double steep = by_w * kappa + bladder.stiffness;
  const double left = 1 / (1 + a.series.compliance * toe.share * steep), s = toe.share * left;
  out.by_length = s * steep;

  actuator::Actuator& by = out.by_knob.actuator;
  const double per_area = s * acting * eff, b = a.braid.thread_length, n = a.braid.turns;
  by.braid.thread_length = -2 * per_area * b * actuator::braid_factor(a.braid);
  by.braid.turns = -2 / n * per_area * actuator::ideal_tension(a.braid, w, 1);
  write_wall(a, w, per_area, by);
  const double per_eff = s * acting * area;
  by.effectiveness.c0 = per_eff * e.scale;
  by.effectiveness.c1 = by.effectiveness.c0 * p;
  by.effectiveness.c2 = by.effectiveness.c1 * p;
  const bool taut = p > e.threshold;
  by.effectiveness.threshold = taut ? -s * eff * area : 0;
  by.caps.length = -s * by_w;
  by.taper.gain = -s * by_w * (a.taper.rest_length - x);
  by.taper.extra_gain = by.taper.gain * fade.share;
  by.taper.extra_pressure =
      -by.taper.gain * a.taper.extra_gain * fade.slope * p / a.taper.extra_pressure;
  write_bladder(a.bladder, x, s, by.bladder);
  by.bladder.rest_length = -s * bladder.stiffness;
  by.series.compliance = -force * out.by_length;
  by.toe.tension = a.toe.tension > 0 ? left * (force - toe.share * pull) / a.toe.tension : 0;
  const double by_pressure = (taut || p < 0 ? s * eff * area : 0) +
                             per_eff * e.scale * (e.c1 + 2 * p * e.c2) +
                             by.taper.gain * a.taper.extra_gain * fade.slope;
  by.hysteresis.half_width = -branch * by_pressure;

  const double per_scale = per_eff * (e.c0 + p * (e.c1 + p * e.c2));
  out.by_knob.end_loss = -per_scale / rest_length_;
  double by_ratio = per_scale * (1 - e.scale) + s * by_w * (1 - kappa) * a.taper.rest_length;
  for (const Multiple& m : multiples_) {
    double& slope = value_of(out.by_knob, m.knob);
    by_ratio += m.grows * slope;
    slope *= m.factor;
  }
  out.by_rest_length = by_ratio / rest_length_;
}

}  // namespace sinew::identify
