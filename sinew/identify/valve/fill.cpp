#include "sinew/identify/valve/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/gas/orifice.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

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

// Computes intervals of a solution with values at their bounds as if those were slightly
// inside, from a solver with no steps.
void widen(const FitProblem& problem, Solution& s) {
  if (std::ranges::none_of(s.estimates, &Estimate::at_bound)) return;
  std::vector<Parameter> inside = problem.parameters;
  SolverOptions options = problem.options;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    Parameter& p = inside[i];
    const double margin = std::min(2 * options.difference * p.scale, 0.25 * (p.high - p.low));
    p.start = std::clamp(s.values[i], p.low + margin, p.high - margin);
  }
  options.most_steps = 0;
  const Solution free = least_squares(problem.residuals, problem.count, inside, options);
  const double change = s.rms > 0 && free.rms > 0 ? s.rms / free.rms : 1;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    Estimate& e = s.estimates[i];
    if (e.at_bound) continue;
    const double half = 0.5 * change * (free.estimates[i].high - free.estimates[i].low);
    if (!(half > e.high - e.value)) continue;
    e.standard_error = change * free.estimates[i].standard_error;
    e.low = e.value - half;
    e.high = e.value + half;
    const double size = std::max(std::abs(e.value), inside[i].scale);
    e.identifiable = half <= options.widest_interval * size;
  }
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
    widen(problem, s);
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

}  // namespace sinew::identify
