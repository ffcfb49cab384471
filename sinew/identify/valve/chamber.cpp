#include "sinew/identify/valve/chamber.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/air/stiff/quick.h"
#include "sinew/gas/orifice.h"
#include "sinew/units/math.h"

namespace sinew::identify {

namespace {

using State = std::array<double, 2>;  // y at the sensor, y behind the hose

constexpr double first_step = 1e-4;  // after an edge, as a share of the filling time
constexpr double growth = 1.3;       // factor of the next step after a small error
constexpr double step_error = 2e-6, longest_way = 0.02;  // error and change of y in a step
constexpr int most_steps = 20'000;

gas::Flow flow_of(const Chamber& c, const gas::Air& air, double factor) {
  gas::Flow f{.law = c.law};
  if (c.law == gas::Flow::Law::iso6358) {
    f.sonic_conductance = c.conductance * factor;
    f.critical_pressure_ratio = c.critical_ratio;
  } else {
    f.area = gas::effective_area_of(c.conductance * factor, air);
  }
  return f;
}

class ChamberRates {
 public:
  ChamberRates(const Chamber& c, const gas::Air& air)
      : chamber_(c),
        valve_(gas::flow_constants(flow_of(c, air, 1), air)),
        leak_(gas::flow_constants(flow_of(c, air, c.leak), air)),
        hose_(gas::flow_constants(flow_of(c, air, c.hose), air)),
        vent_(gas::flow_constants(flow_of(c, air, c.vent), air)),
        density_(gas::density_at_atmosphere(air)),
        port_(gas::y_of(air, c.port)),
        start_(c.start / air.atmosphere),
        swell_(c.swell / air.atmosphere) {}

  State operator()(const State& y, bool open) const {
    double in = open ? gas::flow_y(valve_, port_, y[0]) : 0.0;
    if (!open && chamber_.vent > 0) in -= gas::flow_y(vent_, y[0], 1.0);
    if (chamber_.shape != Chamber::Shape::hose) {
      if (chamber_.leak > 0) in -= gas::flow_y(leak_, y[0], 1.0);
      return {in / capacity(y[0], 1.0), 0.0};
    }
    const double on = gas::flow_y(hose_, y[0], y[1]);
    const double out = chamber_.leak > 0 ? gas::flow_y(leak_, y[1], 1.0) : 0.0;
    return {(in - on) / capacity(y[0], chamber_.share),
            (on - out) / capacity(y[1], 1.0 - chamber_.share)};
  }

  // Returns the number of volumes whose pressures change: 2 with a hose.
  std::size_t volumes() const { return chamber_.shape == Chamber::Shape::hose ? 2 : 1; }

  // Returns about the time in which the choked valve fills the chamber from vacuum to the port's
  // pressure [s].
  double filling_time() const {
    return density_ / (chamber_.exponent * gas::flow_y(valve_, 1.0, 0.5));
  }

 private:
  // Returns dm/dy of a volume.
  double capacity(double y, double volume) const {
    const double y3 = y * y * y, p = y3 * y3 * y;
    const double n = chamber_.exponent;
    const double density = density_ * (n == 1 ? p : units::power(y, 7.0 / n));
    double out = density * 7.0 / (n * y);
    if (chamber_.shape == Chamber::Shape::soft) {
      const double away = chamber_.share * units::exp(-(p - start_) / swell_);
      out = out * (1.0 - away) + density * away / swell_ * 7.0 * y3 * y3;
    }
    return out * volume;
  }

  const Chamber& chamber_;
  gas::FlowConstants valve_, leak_, hose_, vent_;
  double density_, port_, start_, swell_;
};

// Makes one step from y, where the rates are f, and returns its error: the larger one of both.
double step(const ChamberRates& rates, bool open, double h, const State& f, State& y) {
  constexpr double delta = 1e-7;  // of a numerical derivative
  using Rate = air::QuickRates<2, 0>;
  const auto at = [&](double, const State& now, bool slopes) {
    if (!slopes) return Rate{.mass = rates(now, open)};
    Rate out{.mass = f};
    for (std::size_t k = 0; k < rates.volumes(); ++k) {
      State moved = now;
      moved[k] += delta;
      const State g = rates(moved, open);
      for (std::size_t i = 0; i < 2; ++i) out.mass_by[i][k] = (g[i] - f[i]) / delta;
    }
    return out;
  };
  const air::QuickStep<2> result = air::rodas3_step<2>(at, 0, y, h);
  y = result.mass;
  return std::max(result.error[0], result.error[1]);
}

// Interpolates between two nodes by the cubic with their values and slopes.
double between(double t, double from, double h, double y0, double f0, double y1, double f1) {
  const double s = (t - from) / h;
  const double rise = y1 - y0;
  return y0 + s * (h * f0 + s * (3 * rise - h * (2 * f0 + f1) + s * (h * (f0 + f1) - 2 * rise)));
}

bool sensible(const Chamber& c) {
  return c.conductance > 0 && c.port > 0 && c.start > 0 && c.exponent >= 1 && c.share >= 0 &&
         c.share < 1 && c.critical_ratio >= 0 && c.critical_ratio < 1 && c.swell > 0 &&
         c.leak >= 0 && c.vent >= 0 &&
         (c.shape != Chamber::Shape::hose || (c.share > 0 && c.hose > 0));
}

}  // namespace

bool simulate(const Chamber& chamber, const gas::Air& air, std::span<const Opening> openings,
              std::span<const double> times, std::span<double> pressure) {
  if (!sensible(chamber)) return false;
  if (times.empty()) return true;
  const ChamberRates rates(chamber, air);
  const double begin =
      openings.empty() ? times.front() : std::min(times.front(), openings.front().time);

  State y{gas::y_of(air, chamber.start), gas::y_of(air, chamber.start)};
  std::size_t i = 0;  // index of the next requested time
  bool open = false;
  int steps = 0;
  double t = begin;
  for (std::size_t edge = 0; edge <= openings.size() && i < times.size(); ++edge) {
    const bool last = edge == openings.size();
    const double until = last ? times.back() : openings[edge].time;
    double h = first_step * rates.filling_time();
    State f = rates(y, open);
    while (t < until) {
      double to = t + 1.001 * h < until ? t + h : until;
      const State from = y;
      double error = 0;
      // The slope jumps where a flow reverses: use smaller steps there.
      while (error = step(rates, open, to - t, f, y), ++steps,
             !(error < step_error && y[0] > 0 && y[1] > 0)) {
        if (steps > most_steps) return false;
        h = 0.3 * (to - t);
        to = t + h;
        y = from;
      }
      const State g = rates(y, open);
      for (; i < times.size() && times[i] <= to; ++i)
        pressure[i] =
            gas::pressure_of_y(air, between(times[i], t, to - t, from[0], f[0], y[0], g[0]));
      if (error < 0.3 * step_error && std::abs(y[0] - from[0]) < longest_way) h *= growth;
      t = to;
      f = g;
    }
    for (; i < times.size() && times[i] <= t; ++i) pressure[i] = gas::pressure_of_y(air, y[0]);
    if (!last) open = openings[edge].open;
  }
  return true;
}

}  // namespace sinew::identify
