#include "sinew/identify/contest/fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/contest/refusal.h"
#include "sinew/json/json.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

namespace {

bool usable(const Fit& fit) { return fit.refused.empty(); }

enum class By { cross_validation, held_out, fit };

// Smaller errors count as this [%], so that a kind of parts that a law fits exactly does not decide
// alone.
constexpr double exact = 1e-3;

double error_of(const Fit& fit, By by) {
  if (by == By::cross_validation && !fit.kinds.empty()) {
    double logarithms = 0;
    for (const double kind : fit.kinds) logarithms += std::log(std::max(kind, exact));
    return std::exp(logarithms / static_cast<double>(fit.kinds.size()));
  }
  if (by == By::cross_validation) return fit.cross_validated->rmse_percent;
  return by == By::held_out ? fit.held_out->rmse_percent : fit.fit.rmse_percent;
}

// Returns the best measure of error that all usable fits have.
By measure(const Report& report) {
  bool cross = true, held_out = true;
  for (const Fit& fit : report.fits) {
    if (!usable(fit)) continue;
    cross &= fit.cross_validated.has_value();
    held_out &= fit.held_out.has_value();
  }
  return cross ? By::cross_validation : held_out ? By::held_out : By::fit;
}

// Returns the fits that may be chosen; all usable ones if each has a reason not to be.
std::vector<const Fit*> eligible(const Report& report) {
  std::vector<const Fit*> all, out;
  for (const Fit& fit : report.fits) {
    if (!usable(fit)) continue;
    all.push_back(&fit);
    if (fit.not_chosen.empty()) out.push_back(&fit);
  }
  if (!out.empty() || all.empty()) return out;
  return all;
}

// Returns whether the fit is about as good as the best one for every kind of parts.
bool costs_no_kind(const Fit& fit, const Fit& best, By by, double tolerance, double negligible) {
  if (by != By::cross_validation) return true;
  for (std::size_t k = 0; k < std::min(fit.kinds.size(), best.kinds.size()); ++k)
    if (fit.kinds[k] > std::max({(1 + tolerance) * best.kinds[k], negligible, exact})) return false;
  return true;
}

// Describes how close the next fits are to the chosen one; `fits` are in ascending order of error.
std::string runners_up(const std::vector<const Fit*>& fits, const Fit& chosen, By by) {
  constexpr std::size_t most = 3;
  std::string out;
  std::size_t count = 0;
  for (const Fit* fit : fits) {
    if (fit == &chosen || count == most) continue;
    const double ratio = error_of(*fit, by) / error_of(chosen, by);
    out += fmt::format("{}{} {:.2f} times its error", count++ == 0 ? "; next: " : ", ", fit->model,
                       ratio);
  }
  return error_of(chosen, by) > 0 ? out : "";
}

// Throws Refusal with each reason once, and the models that have it.
[[noreturn]] void refuse_all(const Report& report) {
  std::string all;
  for (std::size_t i = 0; i < report.fits.size(); ++i) {
    const std::string& reason = report.fits[i].refused;
    std::string models;
    bool told = false;
    for (std::size_t k = 0; k < report.fits.size(); ++k) {
      if (report.fits[k].refused != reason) continue;
      told |= k < i;
      models += (models.empty() ? "" : ", ") + report.fits[k].model;
    }
    if (!told) all += fmt::format("{}{} ({})", all.empty() ? "" : "; ", reason, models);
  }
  throw Refusal(report.subject, "no model that the data support: " + all,
                "data that determine the simplest of them", "");
}

}  // namespace

void Rows::add(std::span<const double> more_at, std::span<const double> more_measured,
               const std::string& name) {
  at.insert(at.end(), more_at.begin(), more_at.end());
  measured.insert(measured.end(), more_measured.begin(), more_measured.end());
  group.resize(at.size(), name);
}

const Estimate* Fit::estimate(std::string_view name) const {
  const auto at = std::ranges::find(parameters, name, &Estimate::name);
  return at == parameters.end() ? nullptr : &*at;
}

double choice_error(const Report& report, const Fit& fit) { return error_of(fit, measure(report)); }

void choose(Report& report, double tolerance, double negligible) {
  const By by = measure(report);
  std::vector<const Fit*> fits = eligible(report);
  if (fits.empty()) refuse_all(report);
  std::ranges::stable_sort(fits, {}, [&](const Fit* fit) { return error_of(*fit, by); });

  const double smallest = error_of(*fits.front(), by);
  const double near = (1 + tolerance) * smallest, limit = std::max(near, negligible);
  const Fit* chosen = fits.front();
  for (const Fit* fit : fits) {
    const bool is_near = error_of(*fit, by) <= limit;
    if (is_near && free_count(fit->parameters) < free_count(chosen->parameters) &&
        costs_no_kind(*fit, *fits.front(), by, tolerance, negligible))
      chosen = fit;
  }

  if (!chosen->not_chosen.empty())
    report.warnings.push_back(fmt::format("no law is free of a reason not to choose it; {}: {}",
                                          chosen->model, chosen->not_chosen));
  report.chosen = static_cast<std::size_t>(chosen - report.fits.data());
  report.rule = fmt::format(
      "fewest parameters among those whose {} is {}: {} has {} and {:.3g} %, the smallest is "
      "{:.3g} % ({}){}",
      by == By::cross_validation && !chosen->kinds.empty()
          ? "cross-validated error (geometric mean of all kinds of parts) and that of each kind"
      : by == By::cross_validation ? "cross-validated error"
      : by == By::held_out         ? "held-out error"
                                   : "fit error",
      near < negligible ? fmt::format("below {:.2g} %, where it decides nothing", negligible)
      : tolerance > 0   ? fmt::format("within {:.0f} % of the smallest", 100 * tolerance)
                        : "the smallest",
      chosen->model, free_count(chosen->parameters), error_of(*chosen, by), smallest,
      fits.front()->model, runners_up(fits, *chosen, by));
}

namespace {

// Returns whether a profile finds a smaller error than that of the solution. Not tested with robust
// loss or priors, which minimise another quantity.
bool finds_better(const FitProblem& problem, const std::optional<Profile>& profile) {
  constexpr double less = 0.99;
  return profile && problem.data == 0 && problem.options.outlier == 0 &&
         problem.constraints.empty() &&
         std::ranges::any_of(profile->error, [](double error) { return error < less; });
}

void add_profiles(Report& report) {
  Fit& fit = report.fits[report.chosen];
  if (fit.refit) {
    bool is_settled = fit.refit->solution.converged;
    if (!is_settled)
      report.warnings.push_back(
          fmt::format("the search for the values of {} ended after {} steps before it had settled: "
                      "better ones may exist",
                      fit.model, fit.refit->solution.steps));
    const std::vector<std::optional<Profile>> profiles =
        profiles_of(fit.refit->problem, fit.refit->solution);
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      const std::string& name = fit.refit->problem.parameters[i].name;
      const auto estimate = std::ranges::find(fit.parameters, name, &Estimate::name);
      if (estimate != fit.parameters.end()) estimate->profile = profiles[i];
      if (is_settled && finds_better(fit.refit->problem, profiles[i])) {
        is_settled = false;
        report.warnings.push_back(fmt::format(
            "with {} at another value the law misses the data less: the search has not found the "
            "best values",
            name));
      }
    }
  }
  for (Fit& each : report.fits) each.refit.reset();
}

// Writes the errors by group, in the order of their first rows, if there are at least two groups.
void add_errors_by_group(Report& report) {
  const std::vector<std::string>& group = report.rows.group;
  const std::vector<double>& residuals = report.best().residuals;
  if (!report.errors.empty() || group.empty() || residuals.size() != group.size()) return;
  std::vector<std::string> names;
  std::vector<int> part;
  for (const std::string& name : group) {
    const auto at = std::ranges::find(names, name);
    part.push_back(static_cast<int>(at - names.begin()));
    if (at == names.end()) names.push_back(name);
  }
  if (names.size() < 2) return;
  ErrorBy by =
      error_by("group", "", residuals, part, std::vector<double>(part.size()), report.full_scale);
  for (std::size_t i = 0; i < names.size(); ++i) by.parts[i].name = names[i];
  report.errors.push_back(std::move(by));
}

// Returns the laws whose error, by the measure of the choice, is at most a tenth larger
// than that of the chosen one.
std::vector<std::string> hardly_worse(const Report& report) {
  std::vector<std::string> out;
  const By by = measure(report);
  const double chosen = error_of(report.best(), by);
  for (const Fit* fit : eligible(report))
    if (fit != &report.best() && error_of(*fit, by) <= 1.1 * chosen) out.push_back(fit->model);
  return out;
}

}  // namespace

void conclude(Report& report, double tolerance, double negligible) {
  choose(report, tolerance, negligible);
  add_profiles(report);
  add_errors_by_group(report);
}

std::vector<std::string> not_pinned(const Report& report) {
  std::vector<std::string> out;
  for (const Estimate& e : report.best().parameters)
    if (e.profile ? !e.profile->pinned : e.at_bound && e.free) out.push_back(e.name);
  return out;
}

std::vector<std::string> does_not_show(const Report& report) {
  std::vector<std::string> out = report.not_shown;
  const Fit& best = report.best();
  std::vector<std::string> names, at_bounds;
  for (const Estimate& e : best.parameters)
    if (e.profile ? !e.profile->pinned : e.at_bound)
      (e.profile ? names : at_bounds).push_back(e.name);
  if (!at_bounds.empty())
    out.push_back(fmt::format("the value{} of {}, at the bound of {} range",
                              at_bounds.size() == 1 ? "" : "s", fmt::join(at_bounds, ", "),
                              at_bounds.size() == 1 ? "its" : "their"));
  if (!names.empty())
    out.push_back(fmt::format(
        "the value{} of {}: with half or twice of {} and all others fitted again the law misses "
        "the "
        "data hardly more",
        names.size() == 1 ? "" : "s", fmt::join(names, ", "), names.size() == 1 ? "it" : "each"));
  if (const std::vector<std::string> laws = hardly_worse(report); !laws.empty())
    out.push_back(fmt::format("whether {} is the true law, as {} {} at most a tenth more",
                              best.model, fmt::join(laws, ", "),
                              laws.size() == 1 ? "misses" : "miss"));
  if (!best.held_out && !best.cross_validated)
    out.emplace_back("how large errors are where nothing was measured, as no row was left out");
  if (!report.rows.at.empty() && report.rows.x_unit != "s") {
    const units::ShownUnits units = units::UnitSet::metric;
    std::vector<double> fitted;
    for (std::size_t i = 0; i < report.rows.size(); ++i)
      if (report.rows.held_out.empty() || !report.rows.held_out[i])
        fitted.push_back(report.rows.at[i]);
    const auto [least, most] = std::ranges::minmax(fitted.empty() ? report.rows.at : fitted);
    out.push_back(fmt::format("what happens outside the {} that was measured, {} to {}",
                              report.rows.x, units.text(least, report.rows.x_unit),
                              units.text(most, report.rows.x_unit)));
  }
  out.emplace_back("how other specimens differ, or the same one on another day");
  return out;
}

void keep_off_bounds(Fit& fit, std::span<const std::string_view> but_for) {
  std::string names;
  for (const Estimate& e : fit.parameters)
    if (e.at_bound && e.free && std::ranges::find(but_for, e.name) == but_for.end())
      names += (names.empty() ? "" : ", ") + e.name;
  if (!names.empty()) fit.not_chosen = names + " at the bound of its range";
}

void refuse_unexplained(const Report& report, double percent, const std::string& try_this) {
  const Fit& best = report.best();
  if (best.fit.rmse_percent <= percent) return;
  throw Refusal(report.subject,
                fmt::format("{:.0f} % of {} that the best model, {}, does not explain",
                            best.fit.rmse_percent, report.full_scale_is, best.model),
                fmt::format("at most {:.0f} %", percent), try_this);
}

// --- a report for programs ---

namespace {

Json to_json(const Score& score) {
  Json out{{"points", score.points},
           {"rmse", score.rmse},
           {"max", score.max},
           {"rmse_percent", score.rmse_percent},
           {"max_percent", score.max_percent}};
  if (std::isfinite(score.explained)) out["r_squared"] = score.explained;
  if (std::isfinite(score.nrmse)) out["nrmse"] = score.nrmse;
  if (std::isfinite(score.correlation)) out["correlation"] = score.correlation;
  return out;
}

Json to_json(const Estimate& e) {
  Json out{{"name", e.name}, {"unit", e.unit}, {"value", e.value}};
  out["low"] = e.at_bound ? Json() : finite_or_null(e.low);
  out["high"] = e.at_bound ? Json() : finite_or_null(e.high);
  out["identifiable"] = e.identifiable;
  if (e.at_bound) out["at_bound"] = true;
  if (!e.known.empty()) out["known"] = e.known;
  if (!e.profile) return out;
  out["pinned"] = e.profile->pinned;
  out["profile"] = Json::array();
  for (std::size_t i = 0; i < Profile::factors.size(); ++i)
    out["profile"].push_back(
        {{e.profile->near_zero ? "scales" : "times",
          e.profile->near_zero ? Profile::factors[i] - 1 : Profile::factors[i]},
         {"error", finite_or_null(e.profile->error[i])}});
  return out;
}

Json to_json(const Fit& fit) {
  Json out{{"model", fit.model}, {"law", fit.law}, {"source", fit.source}};
  if (!fit.refused.empty()) {
    out["refused"] = fit.refused;
    return out;
  }
  out["parameters"] = Json::array();
  for (const Estimate& e : fit.parameters) out["parameters"].push_back(to_json(e));
  if (fit.fit.points > 0) out["fit"] = to_json(fit.fit);
  if (fit.held_out) out["held_out"] = to_json(*fit.held_out);
  if (fit.cross_validated) out["cross_validated"] = to_json(*fit.cross_validated);
  if (fit.extrapolated) out["extrapolated"] = to_json(*fit.extrapolated);
  if (fit.band) {
    out["band"] = {{"half_68", fit.band->half_68}, {"half_95", fit.band->half_95}};
    if (!fit.band->where.empty()) out["band"]["where"] = fit.band->where;
  }
  if (!fit.not_chosen.empty()) out["not_chosen"] = fit.not_chosen;
  if (!fit.notes.empty()) out["notes"] = fit.notes;
  return out;
}

// Writes a part by its name, or by its value in ErrorBy::unit.
Json to_json(const ErrorBy& by) {
  Json out{{"by", by.what}};
  if (!by.unit.empty()) out["unit"] = by.unit;
  out["parts"] = Json::array();
  for (const PartError& part : by.parts) {
    Json one = part.name.empty() ? Json{{"value", part.value}} : Json{{"name", part.name}};
    one.update(to_json(part.score));
    out["parts"].push_back(std::move(one));
  }
  return out;
}

// Writes the number of omitted rows, and each row that has an explanation.
Json to_json(const Omitted& omitted, const Report& report) {
  Json out{{"reason", omitted.reason},
           {"told_by", omitted.criterion},
           {"count", omitted.count},
           {"shown", omitted.rows.size()}};
  for (const OmittedRow& row : omitted.rows)
    if (!row.why.empty())
      out["rows"].push_back({{report.rows.x, row.at},
                             {report.quantity, row.measured},
                             {"group", row.group},
                             {"why", row.why}});
  return out;
}

Json error_of(double rms, double half) {
  return {{"rms_percent", rms}, {"half_width_95_percent", half}};
}

Json to_json(const Further& further) {
  Json out = Json::object();
  if (!further.of.empty()) out["of"] = further.of;
  out["readings"] = further.readings;
  out["before"] = error_of(further.rms, further.half);
  out["mounts"] = Json::array();
  for (const FurtherMount& m : further.mounts)
    out["mounts"].push_back({{"length_m", m.length},
                             {"gauge_pressures_Pa", m.pressures},
                             {"readings", m.readings},
                             {"time_s", m.time},
                             {"after", error_of(m.rms, m.half)}});
  out["note"] = further.note;
  return out;
}

// Adds the parts beyond the models; a key that does not apply is absent.
void add_evidence(const Report& report, Json& out) {
  for (const ErrorBy& by : report.errors) out["errors"].push_back(to_json(by));
  for (const Omitted& omitted : report.left_out)
    out["left_out"].push_back(to_json(omitted, report));
  for (const Further& further : report.further) out["further"].push_back(to_json(further));
}

}  // namespace

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json to_json(const Report& report) {
  Json out{{"format", "sinew.identification/1"}, {"subject", report.subject}};
  out["quantity"] = report.quantity;
  out["unit"] = report.unit;
  out["full_scale"] = report.full_scale;
  out["full_scale_is"] = report.full_scale_is;
  if (!report.held_out_is.empty()) out["held_out_is"] = report.held_out_is;
  out["chosen"] = report.best().model;
  out["rule"] = report.rule;
  out["models"] = Json::array();
  for (const Fit& fit : report.fits) out["models"].push_back(to_json(fit));
  add_evidence(report, out);
  out["notes"] = report.notes;
  out["warnings"] = report.warnings;
  out["not_pinned"] = not_pinned(report);
  out["does_not_show"] = does_not_show(report);

  // The chosen model again at top level, where programs find it first.
  const Json best = to_json(report.best());
  for (const char* key :
       {"model", "parameters", "fit", "held_out", "cross_validated", "extrapolated", "band"})
    if (best.contains(key)) out[key] = best[key];
  return out;
}

}  // namespace sinew::identify
