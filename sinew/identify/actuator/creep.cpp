#include "sinew/identify/actuator/creep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/actuator/hysteresis.h"
#include "sinew/identify/actuator/static_settled.h"
#include "sinew/identify/contest/contest.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/data/series.h"

namespace sinew::identify {

namespace {

constexpr ColumnSpec creep_specs[] = {
    {"time", "s", 0, 0, needed_column, "from before the pressure rises"},
    {"force", "N", 0.05, 2e4, needed_column, "tension of the muscle"},
    {"pressure", "Pa gauge", 1e4, 5e6, needed_column, "in the muscle"},
};

// Structure of a candidate model: number of creep elements, and with or without friction.
struct Form {
  std::string_view name;
  int elements = 0;
  bool friction = false;
};
constexpr Form forms[] = {{"none", 0, false},
                          {"one", 1, false},
                          {"two", 2, false},
                          {"friction", 0, true},
                          {"friction-and-one", 1, true},
                          {"friction-and-two", 2, true}};

constexpr int stretches = 10;           // parts of the recording, cross-validated by turns
constexpr std::size_t least_rows = 12;  // fewest rows that creep can be fitted to
constexpr int least_rests = 2;  // fewer: the pressure is let in slowly, and every row is fitted

// A recording, and which of its rows are fitted.
struct Held {
  std::span<const double> time, force;
  std::vector<double> pressure;   // without its noise while it rests
  std::vector<std::size_t> rows;  // at which the pressure rests
  double top = 0, pull = 0;       // largest pressure and force [Pa], [N]
  double noise = 0;               // subtracted from the pressure [Pa]

  // Returns the index of the time stretch that contains a row.
  int stretch(std::size_t row) const {
    const double share = (time[row] - time.front()) / (time.back() - time.front());
    return std::min(static_cast<int>(stretches * share), stretches - 1);
  }
};

// Returns the effective pressure at every row: the output of a play operator.
std::vector<double> effective_pressures(std::span<const double> pressure, double half_width) {
  std::vector<double> out;
  double f = pressure[0];
  for (const double p : pressure) out.push_back(f = actuator::play(f, p, half_width));
  return out;
}

// Returns the delayed pressure at every row. The pressure is linear between rows, so this is exact.
std::vector<double> delayed_pressures(std::span<const double> t, std::span<const double> p,
                                      double tau) {
  std::vector<double> z{p[0]};
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double dt = t[i] - t[i - 1];
    const double rise = dt > 0 ? (p[i] - p[i - 1]) / dt : 0;
    const double lag = rise * tau;
    z.push_back(p[i] - lag + (z.back() - p[i - 1] + lag) * std::exp(-dt / tau));
  }
  return z;
}

// Returns the force at every row. `x` holds A, P0, w if there is friction, then c and tau of each
// element.
std::vector<double> force(const Held& held, const Form& form, std::span<const double> x) {
  const std::vector<double> f = effective_pressures(held.pressure, form.friction ? x[2] : 0.0);
  std::vector<double> out;
  for (const double each : f) out.push_back(x[0] * std::max(each - x[1], 0.0));
  for (std::size_t k = form.friction ? 3 : 2; k + 1 < x.size(); k += 2) {
    const std::vector<double> z = delayed_pressures(held.time, f, x[k + 1]);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += x[0] * x[k] * std::max(z[i] - x[1], 0.0);
  }
  return out;
}

std::vector<Parameter> parameters(const Held& held, const Form& form) {
  const double top = held.top, pull = held.pull;
  const double span = held.time.back() - held.time.front();
  std::vector<Parameter> out{{"slope", "N/Pa", 2 * pull / top, 0, unbounded, pull / top},
                             {"threshold", "Pa diff", 0.5 * top, 0, 0.999 * top, 0.1 * top}};
  if (form.friction)
    out.push_back({"half_width", "Pa diff", 0.01 * top, 0, 0.3 * top, 0.01 * top, true});
  constexpr std::string_view shares[] = {"share_1", "share_2"};
  constexpr std::string_view times[] = {"time_1", "time_2"};
  for (int k = 0; k < form.elements; ++k) {
    const double tau = span * (form.elements == 1 ? 0.1 : k == 0 ? 0.02 : 0.3);
    out.push_back({std::string(shares[k]), "1", 0.05, 0, 2, 0.1, true});
    out.push_back({std::string(times[k]), "s", tau, 1e-3 * span, 2 * span, tau, true});
  }
  return out;
}

Candidate candidate_of(const Held& held, const Form& form) {
  Candidate out{
      .model = std::string(form.name),
      .law = "F = A (max(f - P0, 0) + sum c_i max(z_i - P0, 0)), z_i' = (f - z_i)/tau_i",
      .source = form.friction ? "actuator/creep.h, actuator/hysteresis.h" : "actuator/creep.h",
      .parameters = parameters(held, form),
      .options = {.correlated = true, .tolerance = 1e-12},
      .may_be_at_bound = {"threshold"}};
  // The law has a corner at the threshold, so its derivatives just above 0 are those of the noise
  // of the vented rows.
  constexpr double above_noise = 0.1;
  out.finish = [](const FitProblem& problem, std::span<const Solution>, Solution& s) {
    widen_at_bounds(problem, s, above_noise);
  };
  out.predict = [&held, &form](std::span<const double> x, std::span<double> f) {
    std::ranges::copy(force(held, form, x), f.begin());
    return true;
  };
  for (const double threshold : {0.0, 0.5, 0.9}) {
    std::vector<double> start = starts_of(out.parameters);
    start[1] = threshold * held.top;
    start[0] = held.pull / (held.top - start[1]);
    out.starts.push_back(start);
  }
  return out;
}

// Splits the time into ten stretches. Every second one is left out in each of two trials.
Trial trial_of(const Held& held) {
  Trial out{.measured = {held.force.begin(), held.force.end()}, .rows = held.rows};
  out.cross_validates = true;
  // The mean keeps a part of the pressure's noise, which therefore widens the intervals.
  out.weights.assign(held.force.size(), 1);
  out.variances.assign(held.force.size(), std::pow(held.pull / held.top * held.noise, 2));
  out.band_where = "while the pressure rests";
  for (int parity = 0; parity < 2; ++parity) {
    Split& split = out.splits.emplace_back();
    for (const std::size_t row : held.rows)
      (held.stretch(row) % 2 == parity ? split.held_out : split.fitted).push_back(row);
  }
  return out;
}

// Returns whether the pressure falls again by more than a tenth of its range.
bool vents(std::span<const double> pressure) {
  double highest = pressure[0], fall = 0;
  for (const double p : pressure) {
    highest = std::max(highest, p);
    fall = std::max(fall, highest - p);
  }
  return fall > 0.1 * (highest - *std::ranges::min_element(pressure));
}

// Warns where the rise of the pressure itself explains a tenth or more of the force's growth after
// one time constant of the slowest element: creep and pressure are then confounded.
void warn_of_pressure(const Measured& m, const actuator::Creep& creep, Report& report) {
  const std::vector<double>&t = m["time"], &f = m["force"], &p = m["pressure"];
  const double slowest = *std::max_element(creep.time.begin(), creep.time.end());
  if (!(slowest > 0)) return;
  std::size_t from = 0;
  while (from + 2 < t.size() && t[from] < t[0] + slowest) ++from;
  const double by_pressure = report.best().parameters[0].value * (p.back() - p[from]);
  const double growth = f.back() - f[from];
  if (by_pressure < 0.1 * growth) return;
  report.warnings.push_back(fmt::format(
      "creep and pressure are confounded: after {:.3g} s force grows by {:.3g} N, of which the "
      "pressure's rise of {:.2f} % gives {:.3g} N; a law without creep leaves {:.2f} % of the "
      "largest force",
      t[from], growth, 100 * (p.back() / p[from] - 1), by_pressure,
      report.fits[0].fit.rmse_percent));
}

// Returns the rms distance of values from a line.
double rms_from(const StraightLine& line, std::span<const double> x, std::span<const double> y) {
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) squares += std::pow(y[i] - line.at(x[i]), 2);
  return std::sqrt(squares / static_cast<double>(x.size()));
}

// Takes the noise of the sensor off the pressure of rows `from` to `to`, which are at rest: each is
// replaced by the line through its longest neighbourhood that is straight to the noise. A law that
// follows the noise would give creep with a short time in place of a part of its slope, which
// smooths it: then neither is right, nor are their intervals. Returns the noise [Pa].
double smooth_rest(std::span<const double> time, std::size_t from, std::size_t to,
                   std::vector<double>& pressure) {
  constexpr std::size_t reaches[] = {50, 25, 12, 6};
  constexpr double straight = 1.15;  // rms distance from the line, in noises
  if (to - from < 2 * std::size(reaches)) return 0;
  std::vector<double> bends;
  for (std::size_t i = from + 1; i + 1 < to; ++i)
    bends.push_back(pressure[i - 1] - 2 * pressure[i] + pressure[i + 1]);
  const double noise = spread(bends) / std::sqrt(6.0);
  const std::vector<double> read = pressure;
  for (std::size_t i = from; i < to; ++i)
    for (const std::size_t reach : reaches) {
      const std::size_t first = i < from + reach ? from : i - reach;
      const std::size_t count = std::min(to, i + reach + 1) - first;
      const std::span<const double> x = time.subspan(first, count),
                                    y = std::span(read).subspan(first, count);
      const StraightLine line = line_through(x, y);
      if (rms_from(line, x, y) > straight * noise) continue;
      pressure[i] = line.at(time[i]);
      break;
    }
  return noise;
}

// Prepares a recording for the fit, and notes how many of its rows are not fitted.
Held held_of(const Measured& data, Report& report) {
  Held out{.time = data["time"], .force = data["force"], .pressure = data["pressure"], .rows = {}};
  out.top = largest(data["pressure"]);
  out.pull = largest(data["force"]);
  const Settled settled = settled_samples(out.time, out.pressure);
  const bool all = settled.rests < least_rests || data.rows() - settled.moving() < least_rows;
  for (std::size_t i = 0; i < data.rows(); ++i)
    if (all || settled.sample[i]) out.rows.push_back(i);
  for (std::size_t i = 0; i < out.rows.size();) {
    const std::size_t first = i;
    while (i < out.rows.size() && out.rows[i] == out.rows[first] + i - first) ++i;
    out.noise = std::max(out.noise,
                         smooth_rest(out.time, out.rows[first], out.rows[i - 1] + 1, out.pressure));
  }
  if (out.rows.size() < data.rows())
    report.notes.push_back(fmt::format(
        "{} of {} samples are followed and not fitted, as the pressure moves by more than {:.2g} "
        "kPa in {:.2g} s",
        data.rows() - out.rows.size(), data.rows(), 1e-3 * settled.most, settled.window));
  return out;
}

}  // namespace

std::span<const ColumnSpec> creep_columns() { return creep_specs; }

std::vector<std::string> creep_models() {
  std::vector<std::string> out;
  for (const Form& form : forms) out.emplace_back(form.name);
  return out;
}

CreepResult identify_creep(const Measured& data, host::Tally* done) {
  if (data.rows() < least_rows)
    throw Refusal(data.file, fmt::format("{} rows", data.rows()),
                  fmt::format("at least {}", least_rows), "a longer hold");
  CreepResult out;
  Report& report = out.report;
  report.set_subject("creep from " + data.file, "force", "N", "the largest force");
  report.full_scale = largest(data["force"]);
  report.notes = data.notes;
  const Held held = held_of(data, report);
  const bool both = vents(held.pressure);
  std::vector<Candidate> tried;
  for (const Form& form : forms)
    if (both || !form.friction) tried.push_back(candidate_of(held, form));
  fit_candidates(tried, trial_of(held), report, done);
  report.not_shown = {"creep and friction at other lengths"};
  report.rows = {.x = "time", .x_unit = "s", .at = data["time"], .measured = data["force"]};
  conclude(report);
  refuse_unexplained(report, 15, "the columns and their units, or a longer record");
  const Form& best = *std::ranges::find(forms, report.best().model, &Form::name);
  const std::vector<Estimate>& found = report.best().parameters;
  const std::size_t first = best.friction ? 3 : 2;
  if (best.friction) out.hysteresis.half_width = found[2].value;
  for (std::size_t k = first; k + 1 < found.size(); k += 2) {
    out.creep.share[(k - first) / 2] = found[k].value;
    out.creep.time[(k - first) / 2] = found[k + 1].value;
  }
  warn_of_pressure(data, out.creep, report);
  return out;
}

}  // namespace sinew::identify
