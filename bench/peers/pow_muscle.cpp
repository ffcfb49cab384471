#include "bench/peers/pow_muscle.h"

#include <cmath>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/tension.h"
#include "sinew/gas/orifice.h"

namespace sinew::bench {

namespace {

constexpr double gamma_air = gas::heat_capacity_ratio;
const double critical = gas::critical_pressure_ratio();

// sqrt(r^(2/g) - r^((g + 1)/g)) of [44]  [-].
double root_of_ratio(double r) {
  return std::sqrt(std::pow(r, 2.0 / gamma_air) - std::pow(r, (gamma_air + 1.0) / gamma_air));
}

}  // namespace

PowMuscle::PowMuscle(const air::Muscle& muscle, const gas::Air& air, const gas::Supply& supply)
    : muscle_(muscle),
      atmosphere_(air.atmosphere),
      supply_(supply.pressure),
      exponent_(air.polytropic_exponent),
      density_(gas::density_at_atmosphere(air)),
      factor_(actuator::braid_factor(muscle.actuator.braid)),
      shortest_(actuator::shortest_length(muscle.actuator.braid)),
      inlet_(orifice(muscle.inlet.flow, air)),
      exhaust_(orifice(muscle.exhaust.flow, air)) {
  if (!actuator::is_plain(muscle.actuator) || muscle.inlet.flow.law != gas::Flow::Law::orifice ||
      muscle.exhaust.flow.law != gas::Flow::Law::orifice)
    throw std::invalid_argument("a peer's muscle has a plain braid and two orifices");
}

PowMuscle::Orifice PowMuscle::orifice(const gas::Flow& flow, const gas::Air& air) {
  const double scale = flow.area * flow.efficiency / std::sqrt(air.temperature);
  Orifice o{.choked = scale * gas::choked_parameter(air.gas_constant),
            .free = scale * gas::free_parameter(air.gas_constant),
            .linear_below = flow.linear_below};
  if (o.linear_below > 0) o.linear = o.free * root_of_ratio(1.0 - o.linear_below) / o.linear_below;
  return o;
}

double PowMuscle::flow(const Orifice& o, double from, double to) noexcept {
  const bool forward = from >= to;
  const double up = forward ? from : to, down = forward ? to : from;
  double size = 0;
  if (up - down < o.linear_below * up)
    size = o.linear * (up - down);
  else if (down <= critical * up)
    size = o.choked * up;
  else
    size = o.free * up * root_of_ratio(down / up);
  return forward ? size : -size;
}

double PowMuscle::volume(double length) const noexcept {
  const double b = muscle_.actuator.braid.thread_length;
  return muscle_.count * (length * (b * b - length * length) * factor_) + muscle_.external_volume;
}

double PowMuscle::pressure(double mass, double length) const noexcept {
  return atmosphere_ * std::pow(mass / (volume(length) * density_), exponent_);
}

double PowMuscle::gain(double mass, double length, double inlet, double exhaust) const noexcept {
  if (!(inlet > 0) && !(exhaust > 0)) return 0;
  const double p = pressure(mass, length);
  double sum = 0;
  if (inlet > 0) sum += inlet * flow(inlet_, supply_, p);
  if (exhaust > 0) sum -= exhaust * flow(exhaust_, p, atmosphere_);
  return sum;
}

void PowMuscle::fill(double pressure, double length) noexcept {
  mass_ = density_ * std::pow(pressure / atmosphere_, 1.0 / exponent_) * volume(length);
}

void PowMuscle::step(double h, const Lengths& l, double inlet, double exhaust) noexcept {
  const double a = gain(mass_, l.begin, inlet, exhaust);
  const double b = gain(mass_ + 0.5 * h * a, l.middle, inlet, exhaust);
  const double c = gain(mass_ + 0.5 * h * b, l.middle, inlet, exhaust);
  const double d = gain(mass_ + h * c, l.end, inlet, exhaust);
  mass_ += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
}

PowMuscle::Pull PowMuscle::pull(double length, double rate, double pressure) const noexcept {
  const actuator::Actuator& a = muscle_.actuator;
  const double b2 = a.braid.thread_length * a.braid.thread_length;
  const double gauge = pressure - atmosphere_;
  const double drive = gauge * actuator::effectiveness(a.effectiveness, gauge, atmosphere_);
  double f = drive * factor_ * (3.0 * length * length - b2) + a.loss.viscous * rate +
             a.bladder.stiffness * (length - a.bladder.rest_length);
  if (length > a.long_end.length)
    f += a.long_end.stiffness * (length - a.long_end.length) + a.long_end.damping * rate;
  if (length < shortest_)
    f += a.short_end.stiffness * (length - shortest_) + a.short_end.damping * rate;
  const double rub = a.loss.coulomb_length * 3.0 * drive * (length + shortest_) * factor_;
  return {muscle_.count * std::fmax(f, 0.0), muscle_.count * std::fmax(rub, 0.0)};
}

}  // namespace sinew::bench
