#include "sinew/identify/motion/swing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"
#include "sinew/identify/motion/decay.h"

namespace sinew::identify {

namespace {

constexpr ColumnSpec columns[] = {
    {"time", "s", 0, 0, needed_column, "of the sample"},
    {"length", "m", 5e-3, 5, needed_column, "of the muscle"},
    {"pressure", "Pa abs", 1e4, 5e6, optional_column, "of the trapped air"},
};

// The static model may miss the rest by this share of the length, and the tension that follows from
// the period by a factor within these limits.
constexpr double rest_within = 0.05, least_tension = 0.8, most_tension = 1.25;

// Straight line of y over a delayed x.
struct DelayedLine {
  StraightLine line;
  double delay = 0, left = 0;  // delay [s], and sum of squared residuals [y^2]
};

// Fits samples that are at least `margin` [s] from either end, as x is unknown before the record.
DelayedLine delayed_line(std::span<const double> t, std::span<const double> x,
                         std::span<const double> y, double delay, double margin) {
  std::vector<double> delayed_x(x.size());
  delayed(t, x, delay, delayed_x);
  const auto from = std::lower_bound(t.begin(), t.end(), t.front() + margin) - t.begin();
  const auto to = std::upper_bound(t.begin(), t.end(), t.back() - margin) - t.begin();
  const auto n = static_cast<std::size_t>(std::max<std::ptrdiff_t>(to - from, 0));
  const std::span<const double> u =
      std::span<const double>(delayed_x).subspan(static_cast<std::size_t>(from), n);
  const std::span<const double> v = y.subspan(static_cast<std::size_t>(from), n);
  DelayedLine out{line_through(u, v), delay};
  for (std::size_t i = 0; i < n; ++i)
    out.left += std::pow(v[i] - out.line.y - out.line.slope() * (u[i] - out.line.x), 2);
  return out;
}

// Returns the line with the best delay within a sixth of a period, by golden section; without delay
// if that gains no more than noise would.
DelayedLine best_line(std::span<const double> t, std::span<const double> x,
                      std::span<const double> y, double period) {
  constexpr double golden = 0.6180339887498949, significant = 9;  // three standard errors
  const double margin = period / 6;
  double low = -margin, high = margin;
  for (int i = 0; i < 30; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (delayed_line(t, x, y, a, margin).left < delayed_line(t, x, y, b, margin).left)
      high = b;
    else
      low = a;
  }
  const DelayedLine best = delayed_line(t, x, y, 0.5 * (low + high), margin);
  const double gained = delayed_line(t, x, y, 0, margin).left - best.left;
  const bool shows = gained > significant * best.left / static_cast<double>(t.size());
  return shows ? best : delayed_line(t, x, y, 0, 0);
}

}  // namespace

std::span<const ColumnSpec> decay_columns() { return columns; }

Swing::Swing(const DecayRecord& record) : file(record.data.file), stand(record.stand) {
  const std::vector<double>&t = record.data["time"], &x = record.data["length"];
  refuse_constant(record.data, "length", 1e-6, "a mass that swings", "the column, or the sensor");
  oscillation = find_turns(t, x, file + ": length");
  const DecayFit decay = decay_fit(oscillation, stand.mass);
  rest = std::isfinite(oscillation.rest) ? oscillation.rest : decay.solution["center"].value;
  amplitude = 0.5 * std::abs(oscillation.turns[0].value - oscillation.turns[1].value);

  const double end = oscillation.turns.back().time;
  std::size_t spikes = 0;
  for (std::size_t i = oscillation.falls; i < t.size() && t[i] <= end; ++i) {
    spikes += oscillation.spike[i];
    if (oscillation.spike[i] || (!time.empty() && t[i] <= time.back())) continue;
    time.push_back(t[i]);
    length.push_back(x[i]);
  }
  if (spikes > 0)
    notes.push_back(fmt::format("{}: {} samples that stand alone left out", file, spikes));
  for (const std::string& note : record.data.notes) notes.push_back(note);
  take_pressure(record.data);
  refuse_another_muscle();
}

// Fits ln P = ln P_rest - n_p ln(V + V_ext)/(V_rest + V_ext) by a straight line.
void Swing::take_pressure(const Measured& data) {
  const bool at_rest = !std::isfinite(stand.pressure);
  const bool exponent = !std::isfinite(stand.polytropic_exponent);
  if (!at_rest && !exponent) return;
  if (!data.has("pressure"))
    throw Refusal(file, "no measured pressure", "it, or the nominal one and an exponent",
                  "pressure=\"60 psi gauge\"");
  const double end = oscillation.turns.back().time;
  const auto air = [&](double l) {
    return std::log(actuator::volume(stand.actuator.braid, l) + stand.external_volume);
  };
  std::vector<double> t, x, y;
  for (std::size_t i = oscillation.falls; i < data.rows() && data["time"][i] <= end; ++i) {
    t.push_back(data["time"][i]);
    x.push_back(air(data["length"][i]));
    y.push_back(std::log(data["pressure"][i]));
  }
  // A sensor delay would reduce the slope.
  const DelayedLine best = best_line(t, x, y, oscillation.period);
  const StraightLine& line = best.line;
  pressure_delay = best.delay;
  if (exponent) stand.polytropic_exponent = -line.slope();
  if (at_rest) stand.pressure = std::exp(line.at(air(rest)));
  if (!(stand.polytropic_exponent >= 0.9 && stand.polytropic_exponent <= 1.6))
    throw Refusal(file + ": pressure",
                  fmt::format("it goes with the volume to the power {:.3g}", line.slope()),
                  "trapped air: between -0.9 and -1.6",
                  "external_volume=VOLUME, exponent=N, or the pressure's zero");
  notes.push_back(fmt::format("{}: the measured pressure gives {:.5g} Pa at rest, exponent {:.3f}",
                              file, stand.pressure, stand.polytropic_exponent));
  if (pressure_delay != 0)
    notes.push_back(fmt::format("{}: the measured pressure comes {:.1f} ms behind the length", file,
                                1e3 * pressure_delay));
}

void Swing::refuse_another_muscle() const {
  const auto hangs = rest_length(stand);
  if (hangs && std::abs(*hangs - rest) < rest_within * rest) return;
  const double holds =
      actuator::clamped_tension(stand.actuator, rest, 0, stand.pressure - stand.atmosphere,
                                stand.atmosphere) /
      stand.gravity;
  throw Refusal(
      file,
      fmt::format("a rest length of {:.4g} m; the actuator of the file lets {:.4g} kg hang {} "
                  "{:.4g} Pa absolute",
                  rest, stand.mass, hangs ? fmt::format("at {:.4g} m under", *hangs) : "nowhere at",
                  stand.pressure),
      fmt::format("both within {:.0f} %", 100 * rest_within),
      fmt::format("mass, pressure and their units: at the measured length it holds {:.3g} kg",
                  holds));
}

Hanging Swing::scaled(double tension) const {
  Hanging h = stand;
  h.actuator.effectiveness.scale *= tension;
  return h;
}

double Swing::stiffness() const {
  return actuator::stiffness_sealed(stand.actuator, rest, stand.pressure, stand.atmosphere,
                                    stand.external_volume, stand.polytropic_exponent);
}

double Swing::friction(const actuator::Loss& loss) const {
  actuator::Actuator a = stand.actuator;
  a.loss = loss;
  return actuator::coulomb_bound(a, rest, stand.pressure - stand.atmosphere, stand.atmosphere,
                                 stiffness());
}

bool Swing::simulate(const actuator::Loss& loss, std::span<const double> nuisance,
                     std::span<double> out) const {
  Hanging h = scaled(nuisance[3]);
  h.actuator.loss = loss;
  const double offset = nuisance[2];
  const std::span<const double> times(time.data(), out.size());
  if (!free_decay(h, nuisance[0] - offset, nuisance[1], times, out)) return false;
  for (double& x : out) x += offset;
  return true;
}

// Returns the factor on the tension, nearest to 1, that gives small oscillations the measured
// period.
double Swing::tension_of_period() const {
  const double wanted = 2 * std::numbers::pi / oscillation.period;
  const auto excess = [&](double tension) {
    const Hanging h = scaled(tension);
    const auto hangs = rest_length(h);
    return hangs ? sealed_frequency(h, *hangs) - wanted : -wanted;
  };
  const double at_one = excess(1);
  constexpr double step = 0.01;
  for (int i = 1; i * step <= most_tension - 1; ++i)
    for (const double side : {-1.0, 1.0}) {
      double from = 1 + side * step * (i - 1), to = 1 + side * step * i;
      if (to < least_tension || excess(to) * at_one > 0) continue;
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (from + to);
        (excess(middle) * at_one > 0 ? from : to) = middle;
      }
      return from;
    }
  throw Refusal(
      file,
      fmt::format("a period of {:.4g} s; of the actuator of the file {:.4g} s", oscillation.period,
                  2 * std::numbers::pi / (at_one + wanted)),
      fmt::format("one that {} to {} times its tension would have", least_tension, most_tension),
      "the mass that moves, external_volume=VOLUME, exponent=N");
}

// Returns length and speed from the samples, and the rest from the static model.
Swing::Nuisance Swing::first_guess() const {
  const double begin = time[0];
  std::size_t count = 0;
  while (count < time.size() && time[count] < begin + oscillation.period / 12) ++count;
  const StraightLine line = line_through({time.data(), count}, {length.data(), count});
  const double tension = tension_of_period();
  return {line.at(begin), line.slope(), rest - *rest_length(scaled(tension)), tension};
}

std::array<Parameter, Swing::nuisances> Swing::parameters(const Nuisance& start) const {
  const double speed = amplitude * 2 * std::numbers::pi / oscillation.period;
  const double far = 3 * amplitude;
  return {Parameter{"start_length", "m", start[0], rest - far, rest + far, amplitude},
          Parameter{"start_velocity", "m/s", start[1], -unbounded, unbounded, speed},
          Parameter{"offset", "m", start[2], -0.3 * rest, 0.3 * rest, amplitude},
          Parameter{"tension", "1", start[3], 0.9 * least_tension, 1.1 * most_tension, 0.1}};
}

std::size_t Swing::samples_until(double share) const {
  const double end = time[0] + share * (oscillation.turns.back().time - time[0]);
  return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), end) - time.begin());
}

Swing::Nuisance Swing::nearest(const actuator::Loss& loss, const Nuisance& start,
                               std::size_t count) const {
  const auto residuals = [&](std::span<const double> p, std::span<double> r) {
    if (!simulate(loss, p, r)) return false;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= length[i];
    return true;
  };
  const Solution s = least_squares(residuals, count, parameters(start));
  Nuisance out;
  std::copy(s.values.begin(), s.values.end(), out.begin());
  return out;
}

// Fits a few periods first, then more: from a phase error of half a period the fit would not
// converge.
Swing::Nuisance Swing::settle(const actuator::Loss& loss) const {
  Nuisance at = first_guess();
  for (double periods = 2;; periods *= 2.5) {
    const auto end =
        std::lower_bound(time.begin(), time.end(), time[0] + periods * oscillation.period);
    if (end == time.end()) break;
    at = nearest(loss, at, static_cast<std::size_t>(end - time.begin()));
  }
  return nearest(loss, at, time.size());
}

Swing::Nuisance Swing::settle(const actuator::Loss& loss, const Nuisance& near) const {
  return nearest(loss, near, time.size());
}

}  // namespace sinew::identify
