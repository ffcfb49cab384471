#include "sinew/identify/valve/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sinew/gas/orifice.h"

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
void widen(Solution& s, const Residuals& residuals, std::size_t rows,
           std::span<const Parameter> parameters, SolverOptions options) {
  if (std::none_of(s.estimates.begin(), s.estimates.end(),
                   [](const Estimate& e) { return e.at_bound; }))
    return;
  std::vector<Parameter> inside(parameters.begin(), parameters.end());
  for (std::size_t i = 0; i < inside.size(); ++i) {
    Parameter& p = inside[i];
    const double margin = std::min(2 * options.difference * p.scale, 0.25 * (p.high - p.low));
    p.start = std::clamp(s.values[i], p.low + margin, p.high - margin);
  }
  options.most_steps = 0;
  const Solution free = least_squares(residuals, rows, inside, options);
  const double change = s.rms > 0 && free.rms > 0 ? s.rms / free.rms : 1;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    Estimate& e = s.estimates[i];
    if (e.at_bound) continue;
    const double half = 0.5 * change * (free.estimates[i].high - free.estimates[i].low);
    if (!(half > e.high - e.value)) continue;
    e.standard_error = change * free.estimates[i].standard_error;
    e.low = e.value - half;
    e.high = e.value + half;
    const double size = std::max(std::abs(e.value), parameters[i].scale);
    e.identifiable = half <= options.widest_interval * size;
  }
}

}  // namespace

std::span<const FillModel> fill_models() { return all_models; }

std::vector<FreeValue> free_values(const FillModel& model, const Curve& c,
                                   const ValveOptions& options) {
  std::vector<FreeValue> out;
  const auto add = [&](std::string name, std::string unit, double start, double low, double high,
                       double scale, double Chamber::*member) {
    out.push_back({{std::move(name), std::move(unit), start, low, high, scale}, member});
  };
  const double k = conductance_at(c, options.air), range = c.range();
  add("conductance_per_volume", "1/(s Pa)", k, 1e-3 * k, 20 * k, k, &Chamber::conductance);
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
        0.1 * way, nullptr);
  }
  return out;
}

FillCase fill_case(const FillModel& model, const Curve& c, const ValveOptions& options,
                   std::span<const FreeValue> free, std::span<const double> values) {
  FillCase out;
  out.chamber = {.shape = model.shape, .law = model.flow};
  if (options.exponent) out.chamber.exponent = *options.exponent;
  if (model.exponent > 0) out.chamber.exponent = model.exponent;
  if (options.port) out.chamber.port = *options.port;
  out.chamber.start = c.start;
  out.opening = c.opening;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i].member)
      out.chamber.*free[i].member = values[i];
    else
      out.opening = values[i];
  }
  return out;
}

FitProblem fill_problem(const FillModel& model, const Curve& c, const ValveOptions& options,
                        std::span<const std::size_t> keep) {
  const std::vector<FreeValue> free = free_values(model, c, options);
  FitProblem out{.count = keep.size(),
                 .options = {.correlated = true,
                             .most_steps = 60,
                             .widest_interval = 0.25,
                             .difference = 1e-3},
                 .constraints = {}};
  for (const FreeValue& f : free) out.parameters.push_back(f.parameter);
  out.residuals = [&model, &c, &options, free, rows = std::vector(keep.begin(), keep.end()),
                   all = std::vector<double>(c.time.size())](std::span<const double> p,
                                                             std::span<double> r) mutable {
    const FillCase fill = fill_case(model, c, options, free, p);
    const Opening opening{fill.opening, true};
    if (!simulate(fill.chamber, options.air, {&opening, 1}, c.time, all)) return false;
    for (std::size_t i = 0; i < rows.size(); ++i) r[i] = all[rows[i]] - c.pressure[rows[i]];
    return true;
  };
  return out;
}

Refit fit_fill(const FillModel& model, const Curve& c, const ValveOptions& options,
               std::span<const std::size_t> keep, std::span<const std::vector<double>> starts) {
  FitProblem of = fill_problem(model, c, options, keep);
  std::vector<std::vector<double>> from(starts.begin(), starts.end());
  if (from.size() > 1) {
    SolverOptions rough = of.options;
    rough.most_steps = 12;
    from = {least_squares_from(of.residuals, of.count, of.parameters, from, rough).values};
  }
  Solution s = least_squares_from(of.residuals, of.count, of.parameters, from, of.options);
  widen(s, of.residuals, of.count, of.parameters, of.options);
  return {std::move(of), std::move(s)};
}

}  // namespace sinew::identify
