#include "sinew/identify/valve/chamber.h"

#include <algorithm>
#include <array>
#include <cmath>

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

class Rates {
 public:
  Rates(const Chamber& c, const gas::Air& air)
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

// Makes one step of ROS3, an L-stable Rosenbrock method of order 3 (Sandu et al., Atmos. Environ.
// 31, 1997): fast modes that have decayed do not limit the step. Returns its error from the
// embedded method of order 2.
double step(const Rates& rates, bool open, double h, const State& f, State& y) {
  constexpr double gamma = 0.43586652150845967;
  constexpr double c21 = -1.0156171083877702, c31 = 4.0759956452537700, c32 = 9.2076794298330791;
  constexpr double m2 = 6.1697947043828246, m3 = -0.42772256543218573;
  constexpr double e1 = 0.5, e2 = -2.9079558716805470, e3 = 0.22354069897811570;

  // A = 1/(h gamma) - d f/d y, with numerical derivatives.
  constexpr double delta = 1e-7;
  std::array<State, 2> a{};
  for (std::size_t k = 0; k < 2; ++k) {
    State moved = y;
    moved[k] += delta;
    const State g = rates(moved, open);
    for (std::size_t i = 0; i < 2; ++i) a[i][k] = -(g[i] - f[i]) / delta;
    a[k][k] += 1.0 / (h * gamma);
  }
  const double determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  const auto solve = [&](const State& b) {
    return State{(b[0] * a[1][1] - b[1] * a[0][1]) / determinant,
                 (b[1] * a[0][0] - b[0] * a[1][0]) / determinant};
  };

  const State k1 = solve(f);
  const State f2 = rates({y[0] + k1[0], y[1] + k1[1]}, open);
  const State k2 = solve({f2[0] + c21 / h * k1[0], f2[1] + c21 / h * k1[1]});
  const State k3 =
      solve({f2[0] + (c31 * k1[0] + c32 * k2[0]) / h, f2[1] + (c31 * k1[1] + c32 * k2[1]) / h});
  double error = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    y[i] += k1[i] + m2 * k2[i] + m3 * k3[i];
    error = std::max(error, std::abs(e1 * k1[i] + e2 * k2[i] + e3 * k3[i]));
  }
  return error;
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
  const Rates rates(chamber, air);
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
    while (t < until) {
      double to = t + 1.001 * h < until ? t + h : until;
      const State from = y, f = rates(from, open);
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
    }
    for (; i < times.size() && times[i] <= t; ++i) pressure[i] = gas::pressure_of_y(air, y[0]);
    if (!last) open = openings[edge].open;
  }
  return true;
}

}  // namespace sinew::identify
