#include "sinew/identify/valve/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "sinew/gas/orifice.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/valve/added_volume.h"
#include "sinew/units/quantity.h"

namespace sinew::identify {

// --- preparation of a curve ---

namespace {

constexpr std::size_t fewest_on_the_way = 8;  // samples between 10 and 90 %
constexpr double smallest_range = 5e3;        // [Pa]
constexpr std::size_t most_alternating = 8;   // curves in one table

std::string pressure_text(double p) { return units::format_quantity(p, "Pa abs", "kPa abs", 4); }

// Returns the first row beyond this share of the change; rows() if no row is.
std::size_t first_beyond(const Curve& c, double share) {
  for (std::size_t i = 0; i < c.pressure.size(); ++i)
    if (c.share(c.pressure[i]) >= share) return i;
  return c.pressure.size();
}

// Returns the sum of squared residuals of these rows about a rest up to the row `last`, followed by
// a straight rise or fall.
double left_by_rest(const Curve& c, std::span<const std::size_t> rows, std::size_t last) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const std::size_t i : rows) {
    const double since = std::max(0.0, c.time[i] - c.time[last]), p = c.pressure[i] - c.pressure[0];
    n += 1;
    x += since;
    y += p;
    xx += since * since;
    xy += since * p;
    yy += p * p;
  }
  const double across = xx - x * x / n, along = xy - x * y / n;
  return std::max(0.0, yy - y * y / n - (across > 0 ? along * along / across : 0.0));
}

// Returns whether the record begins before the pressure moves: a rest of two rows or more fits the
// first tenth of the change much better than a rise from the first row. Long records are thinned.
bool rests_first(const Curve& c) {
  constexpr std::size_t enough = 200;
  const std::size_t moves = first_beyond(c, 0.03), end = std::max(first_beyond(c, 0.1), moves + 2);
  if (moves < 2 || end > c.time.size()) return moves >= 2;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < end; i += 1 + end / enough) rows.push_back(i);
  const double from_first = left_by_rest(c, rows, 0);
  for (std::size_t last = 1; last < moves; last += 1 + moves / enough)
    if (left_by_rest(c, rows, last) < 0.5 * from_first) return true;
  return false;
}

void find_ends(const Measured& data, Curve& c) {
  const std::size_t n = c.pressure.size(), tail = std::max<std::size_t>(3, n / 20);
  c.end = median(std::span(c.pressure).last(std::min(tail, n)));
  c.start = c.pressure.front();
  if (c.range() < smallest_range)
    throw Refusal(data.file + ": pressure",
                  fmt::format("{} at the start and {} at the end", pressure_text(c.start),
                              pressure_text(c.end)),
                  "a chamber that fills or vents by more than 5 kPa", "the columns, and the valve");
  const std::size_t moves = first_beyond(c, 0.03);
  c.opening_seen = rests_first(c);
  if (c.opening_seen)
    c.start = median(std::span(c.pressure).first(std::min<std::size_t>(moves, 9)));
}

void find_rate(const Measured& data, Curve& c) {
  const std::size_t a = first_beyond(c, 0.1), b = first_beyond(c, 0.9);
  const std::size_t on_the_way = b > a ? b - a : 0;
  if (on_the_way < fewest_on_the_way)
    throw Refusal(
        data.file + ": time", fmt::format("{} samples between 10 and 90 % of the way", on_the_way),
        fmt::format("at least {}: the sample rate is too low for this volume", fewest_on_the_way),
        "a faster sampling, or a larger volume");
  const std::size_t from = first_beyond(c, 0.15), to = std::max(first_beyond(c, 0.5), from + 2);
  c.rate = (c.pressure[to] - c.pressure[from]) / std::max(c.time[to] - c.time[from], 1e-9);
  const std::size_t last = c.time.size() - 1, tenth = last - std::max<std::size_t>(last / 10, 4);
  const double at_end = (c.pressure[last] - c.pressure[tenth]) / (c.time[last] - c.time[tenth]);
  c.settled = std::abs(at_end) < 0.1 * std::abs(c.rate);
  const std::size_t moves = first_beyond(c, 0.03);
  c.opening = c.opening_seen ? c.time[moves - 1] : c.time.front();
}

// Throws Refusal for a clipped curve. A flow through a valve slows down as the pressures approach
// each other; a curve that reaches its end at full rate and then stays on one value shows the
// limit of the sensor.
void refuse_saturated(const Measured& data, const Curve& c) {
  const std::size_t a = first_beyond(c, 0.6), b = first_beyond(c, 0.95);
  const double extreme = c.fills() ? largest(c.pressure) : smallest(c.pressure);
  const auto top = std::find(c.pressure.begin(), c.pressure.end(), extreme);
  const auto at = static_cast<std::size_t>(top - c.pressure.begin());
  std::size_t stays = 0;
  while (at + stays < c.pressure.size() && c.pressure[at + stays] == extreme) ++stays;
  if (stays < 5 || at <= b || b <= a) return;

  const double before = (c.share(c.pressure[b]) - c.share(c.pressure[a])) / (c.time[b] - c.time[a]);
  const double last = (1.0 - c.share(c.pressure[b - 1])) / (c.time[at] - c.time[b - 1]);
  if (last < 0.7 * before) return;
  throw Refusal(data.file + ": pressure",
                fmt::format("{} samples at {} right after full speed: the sensor or its converter "
                            "is at its end",
                            stays, pressure_text(extreme)),
                "a curve that slows down as it reaches the pressure of the port",
                "a sensor with a larger range, or a lower pressure");
}

// Throws Refusal if the rows of several curves alternate: a sample is then closer to one a few rows
// before than to its neighbour.
void refuse_alternating(const Measured& data, const Curve& c) {
  const auto way = [&](std::size_t lag) {
    double sum = 0;
    for (std::size_t i = lag; i < c.pressure.size(); ++i)
      sum += std::abs(c.pressure[i] - c.pressure[i - lag]);
    return sum / static_cast<double>(c.pressure.size() - lag);
  };
  const double next = way(1);
  for (std::size_t lag = 2; lag <= most_alternating && 4 * lag < c.pressure.size(); ++lag)
    if (next > 4 * way(lag))
      throw Refusal(data.file + ": pressure", fmt::format("{} curves whose rows take turns", lag),
                    "the rows of one filling or venting",
                    "where=\"valve=inlet\", with the column that names the valve of a row");
}

void refuse_to_and_fro(const Measured& data, const Curve& c) {
  double most = c.start;  // farthest value so far
  std::size_t where = 0;
  for (std::size_t i = 0; i < c.pressure.size(); ++i) {
    if (c.share(c.pressure[i]) > c.share(most)) most = c.pressure[i];
    if (c.share(most) - c.share(c.pressure[i]) > 0.15 && where == 0) where = i;
  }
  if (where == 0) return;
  throw Refusal(
      fmt::format("{}:{}: pressure", data.file, data.lines[where]),
      fmt::format("a fall back by more than 15 % of the way, to {}",
                  pressure_text(c.pressure[where])),
      "one filling or one venting",
      "where=\"valve=inlet\", if a column names the valve of a row; or a column `command`, for "
      "pulses");
}

// Removes rows long after the pressure has settled, which would only improve the score.
void cut_hold(Curve& c) {
  const std::size_t settled = first_beyond(c, 0.98);
  if (settled >= c.time.size()) return;
  const double until = c.opening + 2.0 * (c.time[settled] - c.opening);
  std::size_t keep = settled;
  while (keep < c.time.size() && c.time[keep] <= until) ++keep;
  if (keep == c.time.size()) return;
  c.notes.push_back(
      fmt::format("{} of {} rows are fitted, until {:.4g} s: of the hold, as long as it took to "
                  "come within 2 %",
                  keep, c.time.size(), c.time[keep - 1]));
  c.time.resize(keep);
  c.pressure.resize(keep);
}

void add_time_notes(const Measured& data, Curve& c) {
  std::size_t same = 0;
  for (std::size_t i = 1; i < c.time.size(); ++i) same += c.time[i] == c.time[i - 1];
  if (same > 0)
    c.notes.push_back(
        fmt::format("{}: {} rows have the time of the row before them", data.file, same));
  if (!c.opening_seen)
    c.notes.emplace_back(
        "the curve begins while the pressure moves: the valve's instant is not in it");
}

}  // namespace

Curve curve_of(const Measured& data) {
  Curve c{.time = data["time"], .pressure = data["pressure"], .notes = data.notes};
  if (data.rows() < 2 * fewest_on_the_way)
    throw Refusal(data.file, fmt::format("{} rows", data.rows()),
                  fmt::format("at least {}", 2 * fewest_on_the_way), "a longer record");
  refuse_alternating(data, c);
  find_ends(data, c);
  find_rate(data, c);
  refuse_saturated(data, c);
  refuse_to_and_fro(data, c);
  cut_hold(c);
  add_time_notes(data, c);
  return c;
}

namespace {

using enum Chamber::Shape;
using enum gas::Flow::Law;

constexpr std::string_view rigid_orifice = "V d rho/dt = m', [44]; rho ~ P^(1/n)";
constexpr std::string_view rigid_iso = "V d rho/dt = m', ISO 6358; rho ~ P^(1/n)";
constexpr std::string_view soft_iso = "d(rho V)/dt = m', ISO 6358; V = V_end (1 - s exp(-dP/P_s))";
constexpr std::string_view hose_iso =
    "s V before a hose of h C, (1 - s) V behind it; ISO 6358; rho ~ P^(1/n)";

constexpr std::array all_models{
    FillModel{"orifice isothermal", rigid_orifice, "[38]-[44], n = 1", rigid, orifice, 1},
    FillModel{"orifice adiabatic", rigid_orifice, "[38]-[44], n = 1.4", rigid, orifice, 1.4},
    FillModel{"orifice polytropic", rigid_orifice, "[38]-[44]", rigid, orifice, 0},
    FillModel{"iso isothermal", rigid_iso, "ISO 6358-1, n = 1", rigid, iso6358, 1},
    FillModel{"iso adiabatic", rigid_iso, "ISO 6358-1, n = 1.4", rigid, iso6358, 1.4},
    FillModel{"iso polytropic", rigid_iso, "ISO 6358-1, [40]", rigid, iso6358, 0},
    FillModel{"iso leaking", rigid_iso, "ISO 6358-1, [40], a hole", rigid, iso6358, 0, true},
    FillModel{"soft isothermal", soft_iso, "ours, n = 1", soft, iso6358, 1},
    FillModel{"soft polytropic", soft_iso, "ours, [40]", soft, iso6358, 0},
    FillModel{"hose isothermal", hose_iso, "ours, n = 1", hose, iso6358, 1},
    FillModel{"hose adiabatic", hose_iso, "ours, n = 1.4", hose, iso6358, 1.4},
    FillModel{"hose polytropic", hose_iso, "ours, [40]", hose, iso6358, 0}};

// Returns C/V of a rigid chamber with the curve's rate under choked flow.
double conductance_at(const Curve& c, const gas::Air& air) {
  const double up = std::max(c.start, c.end);
  const double flow = gas::mass_flow_iso6358(1.0, 0.3, up, air.temperature, 0.0);
  return std::abs(c.rate) / (air.gas_constant * air.temperature * flow);
}

// Returns starts spread over the possible values, as there may be several minima; empty: one is
// enough. Before a narrow hose a small share of the volume fills fast, and C/V is less than the
// first rise suggests.
std::vector<std::vector<double>> spread_starts(const FillModel& model,
                                               std::span<const FreeValue> free) {
  struct Spread {
    double share, factor, exponent;
  };
  constexpr Spread of_rigid[] = {{0, 1, 1.03}, {0, 1, 1.35}};
  constexpr Spread more[] = {{0.2, 1, 1.05}, {0.2, 1, 1.35}, {0.02, 0.05, 1.2}, {0.7, 1, 1.1}};
  std::vector<std::vector<double>> out;
  if (model.shape == rigid && model.exponent > 0) return out;
  for (const Spread& s :
       model.shape == rigid ? std::span<const Spread>(of_rigid) : std::span<const Spread>(more)) {
    std::vector<double>& one = out.emplace_back();
    for (const FreeValue& f : free)
      one.push_back(f.member == &Chamber::conductance ? s.factor * f.parameter.start
                    : f.member == &Chamber::share     ? s.share
                    : f.member == &Chamber::exponent  ? s.exponent
                                                      : f.parameter.start);
  }
  return out;
}

// Returns why a model is not tried; empty: it is.
std::string not_tried(const FillModel& model, const ValveOptions& options) {
  if (model.leak && !options.port)
    return "a leak and the port's pressure have the same effect; port=PRESSURE separates them";
  const bool named = options.exponent == 1.0 || options.exponent == gas::heat_capacity_ratio;
  if (options.exponent && (model.exponent > 0 ? model.exponent != *options.exponent : named))
    return fmt::format("the exponent is known, {:g}", *options.exponent);
  return "";
}

// Returns whether a row is held out: every second tenth of the change, without its ends.
bool is_held_out(const Curve& c, std::size_t i) {
  const double share = c.share(c.pressure[i]);
  return share > 0.1 && share < 0.8 && static_cast<int>(10 * share) % 2 == 1;
}

// Throws Refusal if the curve does not determine C/V.
void refuse_undetermined(const Solution& s) {
  const Estimate& k = s["conductance_per_volume"];
  if (k.at_bound) throw Refusal(k.name, "a fit at the bound of its range", "one within it", "");
  if (!std::isfinite(k.high))
    throw Refusal(k.name, "nothing in the curve that depends on it alone", "an interval", "");
}

}  // namespace

std::span<const FillModel> fill_models() { return all_models; }

std::vector<FreeValue> free_values(const FillModel& model, const Curve& c,
                                   const ValveOptions& options) {
  std::vector<FreeValue> out;
  const auto add = [&](std::string name, std::string unit, double start, double low, double high,
                       double scale, double ValvedChamber::*member) {
    out.push_back({{std::move(name), std::move(unit), start, low, high, scale}, member});
  };
  const double k = conductance_at(c, options.air), range = c.range();
  add("conductance_per_volume", "1/(s Pa)", k, 1e-3 * k, 20 * k, k, &Chamber::conductance);
  out.back().parameter.may_widen = true;
  if (model.flow == iso6358)
    add("critical_pressure_ratio", "1", 0.3, 0, 0.95, 1, &Chamber::critical_ratio);
  if (model.exponent == 0 && !options.exponent)
    add("polytropic_exponent", "1", 1.05, 1, 5.0 / 3.0, 1, &Chamber::exponent);
  if (model.leak) add("leak_over_conductance", "1", 1e-3, 0, 0.5, 0.01, &Chamber::leak);
  if (model.shape == soft) {
    add("swelling_share", "1", 0.5, 0, 0.95, 1, &Chamber::share);
    add("swelling_pressure", "Pa diff", 0.3 * range, 0.01 * range, 3 * range, range,
        &Chamber::swell);
  }
  if (model.shape == hose) {
    add("share_before_hose", "1", 0.2, 0.01, 0.95, 1, &Chamber::share);
    add("hose_over_conductance", "1", 1, 0.05, 10, 1, &Chamber::hose);
  }
  if (!options.port) {
    const double beyond = c.fills() ? 0.01 * range : -0.01 * range;
    const double most = c.end + 40 * beyond, least = c.end - 2 * beyond;
    add("port_pressure", "Pa abs", c.end + beyond, std::max(1e3, std::min(least, most)),
        std::max(least, most), range, &Chamber::port);
  }
  if (!c.opening_seen) {
    add("start_pressure", "Pa abs", c.start, std::max(1e3, c.start - 0.1 * range),
        c.start + 0.1 * range, range, &Chamber::start);
  } else {  // the initial pressure is measured
    const double way = range / std::abs(c.rate);
    add("opening_instant", "s", c.opening, c.time.front() - 0.01 * way, c.opening + 0.5 * way,
        0.1 * way, &ValvedChamber::opening_instant);
  }
  return out;
}

bool predict_fill(const FillModel& model, const Curve& c, const ValveOptions& options,
                  std::span<const FreeValue> free, std::span<const double> values,
                  std::span<double> pressure) {
  ValvedChamber chamber;
  chamber.shape = model.shape;
  chamber.law = model.flow;
  if (options.exponent) chamber.exponent = *options.exponent;
  if (model.exponent > 0) chamber.exponent = model.exponent;
  if (options.port) chamber.port = *options.port;
  chamber.start = c.start;
  chamber.opening_instant = c.opening;
  for (std::size_t i = 0; i < free.size(); ++i) chamber.*free[i].member = values[i];
  const Opening opening{chamber.opening_instant, true};
  return simulate(chamber, options.air, {&opening, 1}, c.time, pressure);
}

Candidate fill_candidate(const FillModel& model, const Curve& c, const ValveOptions& options) {
  const std::vector<FreeValue> free = free_values(model, c, options);
  Candidate out{.model = std::string(model.name),
                .law = std::string(model.law),
                .source = std::string(model.source),
                .starts = spread_starts(model, free),
                .search_tolerance = 0,
                .search_steps = 24,
                .options = fill_options,
                .may_be_at_bounds = true,
                .refused = not_tried(model, options)};
  for (const FreeValue& f : free) out.parameters.push_back(f.parameter);
  out.predict = [&model, &c, &options, free](std::span<const double> p, std::span<double> values) {
    return predict_fill(model, c, options, free, p, values);
  };
  out.finish = [](const FitProblem& problem, std::span<const Solution>, Solution& s) {
    widen_at_bounds(problem, s);
    refuse_undetermined(s);
  };
  return out;
}

Report fill_contest(const Curve& c, const ValveOptions& options, std::span<const FillModel> models,
                    bool is_scored_elsewhere) {
  Report out{.full_scale = c.range()};
  std::vector<Candidate> candidates;
  for (const FillModel& model : models) candidates.push_back(fill_candidate(model, c, options));
  Split tenths;
  for (std::size_t i = 0; i < c.time.size(); ++i)
    (is_held_out(c, i) ? tenths.held_out : tenths.fitted).push_back(i);
  Trial trial{.measured = c.pressure, .has_band = false};
  if (!is_scored_elsewhere) trial.splits = {tenths};
  fit_candidates(std::move(candidates), trial, out);
  return out;
}

std::vector<FillSquares> squares_of(const Report& report) {
  std::vector<FillSquares> out;
  for (const Fit& fit : report.fits) {
    FillSquares& one = out.emplace_back();
    if (!fit.refused.empty()) continue;
    const Solution& s = fit.refit->solution;
    for (const double r : s.residuals) one.found += r * r;
    const int freedom = std::max(1, s.freedom);
    const double t = t_quantile(freedom);
    one.acceptable = one.found * (1 + t * t * s.inflation / freedom);
  }
  return out;
}

void reach_for_fixed(std::span<const FillSquares> squares, Report& report) {
  const std::span<const FillModel> models = fill_models();
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t k = 0; k < models.size(); ++k) {
      const FillModel &free = models[i], &fixed = models[k];
      if (free.exponent != 0 || fixed.exponent == 0 || free.shape != fixed.shape ||
          free.flow != fixed.flow || !report.fits[i].refused.empty() ||
          !report.fits[k].refused.empty() || squares[k].found > squares[i].acceptable)
        continue;
      for (Estimate& e : report.fits[i].parameters) {
        if (e.at_bound) continue;
        if (e.name == "polytropic_exponent") {
          e.low = std::min(e.low, fixed.exponent);
          e.high = std::max(e.high, fixed.exponent);
          e.identifiable = false;
        }
        if (const Estimate* other = report.fits[k].estimate(e.name)) {
          e.low = std::min(e.low, other->low);
          e.high = std::max(e.high, other->high);
          e.identifiable &= half_of(e) <= well_known;
        }
      }
    }
}

void refuse_undetermined_models(Report& report, double worst_fit) {
  const auto is_open = [](const Fit& fit) { return !(half_of(fit.parameters.front()) <= 1); };
  const bool others = std::ranges::any_of(report.fits, [&](const Fit& fit) {
    return fit.refused.empty() && fit.fit.rmse_percent <= worst_fit && !is_open(fit);
  });
  if (!others) return;
  for (Fit& fit : report.fits)
    if (fit.refused.empty() && is_open(fit))
      fit.refused =
          fmt::format("leaves C/V open by +- {:.0f} %", 100 * half_of(fit.parameters.front()));
}

std::string reach_over_models(std::span<const FillSquares> squares, std::size_t count,
                              Report& report) {
  const std::vector<Fit>& fits = report.fits;
  std::size_t best = report.chosen;
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (fits[i].refused.empty() && squares[i].found < squares[best].found) best = i;
  const double acceptable = std::max(squares[best].acceptable, squares[report.chosen].found);

  const std::span<Estimate> known = std::span(report.fits[report.chosen].parameters).first(count);
  std::string names;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (i == report.chosen || !fits[i].refused.empty() || squares[i].found > acceptable) continue;
    bool is_wider = count > 1;
    for (std::size_t k = 0; k < count; ++k) {
      Estimate& e = known[k];
      const Estimate& other = fits[i].parameters[k];
      is_wider = is_wider || other.low < e.low || other.high > e.high;
      e.low = std::min(e.low, other.low);
      e.high = std::max(e.high, other.high);
    }
    if (is_wider) names += (names.empty() ? "" : ", ") + fits[i].model;
  }
  if (names.empty()) return names;
  for (Estimate& e : known) {
    e.standard_error = std::max(e.standard_error, 0.25 * (e.high - e.low));
    e.identifiable &= half_of(e) <= well_known;
  }
  return names;
}

// --- identification: all models are fitted, one is chosen, and C/V is determined without V ---

namespace {

// Returns whether a parameter belongs to this record, not to the valve and its chamber.
bool of_the_record(std::string_view name) {
  return name == "start_pressure" || name == "opening_instant";
}

// Scores the model on another record: model values are kept, start pressure and opening instant are
// fitted.
Score score_other(const FillModel& model, const Curve& other, const ValveOptions& options,
                  const Solution& found) {
  const std::vector<FreeValue> free = free_values(model, other, options);
  std::vector<double> values;
  std::vector<Parameter> record;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Parameter& p = free[i].parameter;
    values.push_back(of_the_record(p.name) ? p.start : found[p.name].value);
    if (!of_the_record(p.name)) continue;
    record.push_back(p);
    index.push_back(i);
  }
  const auto residuals = [&](std::span<const double> p, std::span<double> r) {
    for (std::size_t i = 0; i < p.size(); ++i) values[index[i]] = p[i];
    if (!predict_fill(model, other, options, free, values, r)) return false;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= other.pressure[i];
    return true;
  };
  return score(least_squares(residuals, other.time.size(), record).residuals, other.range());
}

// Notes pairs of the valve's parameters that the curve hardly separates.
void add_correlation_notes(const Solution& s, Fit& fit) {
  const std::size_t n = s.estimates.size();
  const auto cov = [&](std::size_t i, std::size_t k) { return s.covariance[i * n + k]; };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      if (of_the_record(s.estimates[i].name) || of_the_record(s.estimates[k].name)) continue;
      const double r = cov(i, k) / std::sqrt(cov(i, i) * cov(k, k));
      if (std::isfinite(r) && std::abs(r) > 0.95)
        fit.notes.push_back(fmt::format("{} and {} can hardly be separated: correlation {:.3f}",
                                        s.estimates[i].name, s.estimates[k].name, r));
    }
  for (const std::string& direction : s.undetermined)
    fit.notes.push_back("the curve does not determine " + direction);
}

// Adds notes to the fit of a model, and its score on another record, if not null.
void complete(const FillModel& model, const Curve* other, const ValveOptions& options, Fit& fit) {
  if (!fit.refused.empty()) return;
  const Solution& s = fit.refit->solution;
  fit.parameters.front().identifiable &= half_of(fit.parameters.front()) <= well_known;
  add_correlation_notes(s, fit);
  if (!other) return;
  try {
    fit.held_out = score_other(model, *other, options, s);
  } catch (const Refusal& refusal) {
    fit.refused = refusal.what();
  }
}

// Adds conductance or volume, from C/V and the other of the two.
void divide(const FillModel& model, const ValveOptions& options, Fit& fit) {
  Estimate& k = fit.parameters.front();
  if (options.volume) {
    const Estimate c = scaled(k, "sonic_conductance", "m3/(s Pa)", *options.volume);
    if (model.flow == gas::Flow::Law::iso6358)
      k = c;
    else
      k = scaled(c, "area", "m2", gas::effective_area_of(1.0, options.air));
  } else if (options.conductance) {
    Estimate v = k;
    v.name = "volume";
    v.unit = "m3";
    v.value = *options.conductance / k.value;
    v.standard_error = k.standard_error * v.value / k.value;
    if (v.profile) std::ranges::reverse(v.profile->error);
    v.low = *options.conductance / k.high;
    v.high = k.low > 0 ? *options.conductance / k.low : unbounded;
    k = v;
  }
}

// Notes the exponent from the variant with a free one, if the chosen model has it fixed.
void add_exponent_note(Report& report) {
  const std::span<const FillModel> models = fill_models();
  const FillModel& chosen = models[report.chosen];
  if (chosen.exponent == 0 || !report.fits[report.chosen].refused.empty()) return;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const FillModel& m = models[i];
    if (m.shape != chosen.shape || m.flow != chosen.flow || m.exponent != 0 || m.leak) continue;
    if (const Estimate* e = report.fits[i].estimate("polytropic_exponent"))
      report.fits[report.chosen].notes.push_back(
          fmt::format("polytropic_exponent is {:g} by the model; fitted it is {:.3f}{}",
                      chosen.exponent, e->value,
                      e->at_bound ? ", the bound of its range"
                                  : fmt::format(" +- {:.2g}", 0.5 * (e->high - e->low))));
  }
}

// Adds notes to the report. `alone`: C/V by the chosen model, not widened to other models.
void describe(const Curve& c, const ValveOptions& options, const Estimate& alone,
              ValveResult& out) {
  Report& r = out.report;
  r.notes.insert(r.notes.end(), c.notes.begin(), c.notes.end());
  if (!options.port)
    r.notes.push_back(fmt::format(
        "the pressure on the valve's other side is fitted as a constant, {}; a supply that droops "
        "or an unknown zero of the sensor has the effect of another b or n",
        c.fills() ? "for a supply" : "for a room"));
  if (options.volume) r.notes.emplace_back("the volume is taken as exact");
  const Estimate& k = r.best().parameters.front();
  if (!options.volume && !options.conductance && !options.per_volume) {
    const std::vector<std::string> ways = ways_to_separate(half_of(alone), half_of(k));
    r.notes.insert(r.notes.end(), ways.begin(), ways.end());
    out.refused = fmt::format(
        "sonic conductance: found C/V = {} alone; expected the volume too: one curve does "
        "not separate C from V; try volume=\"0.5 L\", conductance=C in place of the volume, "
        "added_volume=\"0 L,0.5 L\" with a second file, or per_volume=true where C/V is enough",
        units::format_quantity(k.value, "1/(s Pa)", "1/(s bar)", 4));
  }
  if (half_of(k) <= well_known) return;
  out.refused += fmt::format(
      "{}{}: found an interval of +- {:.0f} %; expected at most +- {:.0f} %; try {}{}a rigid "
      "chamber "
      "near the valve, less noise",
      out.refused.empty() ? "" : "\n", k.name, 100 * half_of(k), 100 * well_known,
      options.port ? "" : "port=PRESSURE on the valve's other side, ",
      options.exponent ? "" : "exponent=N where it is known (1 in a chamber full of wire wool), ");
}

}  // namespace

void refuse_unsettled(const Measured& data, const Curve& c, const ValveOptions& options) {
  if (c.settled || options.port) return;
  throw Refusal(data.file + ": pressure",
                fmt::format("one that still moves at the end, at {}",
                            units::format_quantity(c.pressure.back(), "Pa abs", "kPa abs", 4)),
                "one that settles at the pressure on the valve's other side",
                "a longer record, or port=PRESSURE");
}

void refuse_poor_fit(const Measured& data, const Report& report, double worst) {
  if (report.best().fit.rmse_percent <= worst) return;
  throw Refusal(
      data.file,
      fmt::format("{:.2g} % of the range left by the best model, {}",
                  report.best().fit.rmse_percent, report.best().model),
      fmt::format("at most {:g} %: one valve, one constant port pressure, one chamber behind it",
                  worst),
      "a rigid chamber near the valve, the pressure of the supply recorded with it");
}

ValveResult identify_fill(const Measured& data, const ValveOptions& options,
                          const Measured* other) {
  const Curve c = curve_of(data);
  std::optional<Curve> unseen;
  if (other) unseen = curve_of(*other);
  refuse_unsettled(data, c, options);

  ValveResult out = before(options);
  Report& report = out.report;
  report = fill_contest(c, options, fill_models(), other != nullptr);
  report.set_subject(
      fmt::format("{} of a chamber through a valve", c.fills() ? "filling" : "venting"), "pressure",
      "Pa diff", "the pressure's range");
  report.not_shown = {"the flow in the other direction, and how fast the valve switches"};
  report.held_out_is = other ? other->file + ", with its own start and opening instant"
                             : "every second tenth of the way, 10 to 20 % up to 70 to 80 %";
  for (std::size_t i = 0; i < report.fits.size(); ++i)
    complete(fill_models()[i], unseen ? &*unseen : nullptr, options, report.fits[i]);
  const std::vector<FillSquares> squares = squares_of(report);
  reach_for_fixed(squares, report);
  refuse_undetermined_models(report, options.worst_fit);
  report.rows = {
      .x = "time", .x_unit = "s", .unit = "Pa abs", .at = c.time, .measured = c.pressure};
  conclude(report, 0.1, unresolved_error);
  const Estimate alone = report.best().parameters.front();
  if (const std::string names = reach_over_models(squares, 1, report); !names.empty())
    report.fits[report.chosen].notes.push_back(
        "the curve does not distinguish the chamber from others, and the interval of C/V covers "
        "them: " +
        names);
  for (std::size_t i = 0; i < report.fits.size(); ++i)
    if (report.fits[i].refused.empty()) divide(fill_models()[i], options, report.fits[i]);
  refuse_poor_fit(data, report, options.worst_fit);
  add_exponent_note(report);
  if (options.volume)
    replace_flow(fill_models()[report.chosen].flow,
                 "sinew identify valve " + data.file + ", model " + report.best().model, out);
  describe(c, options, alone, out);
  return out;
}

}  // namespace sinew::identify
