#include "sinew/identify/fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/fit/refusal.h"

namespace sinew::identify {

namespace {

std::size_t free_in(const Fit& fit) {
  return static_cast<std::size_t>(std::ranges::count_if(fit.parameters, &Estimate::free));
}

bool usable(const Fit& fit) { return fit.refused.empty(); }

enum class By { cross_validation, held_out, fit };

// Errors below this are one, so that a kind that a law meets exactly does not decide alone  [%].
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

// What all usable fits have.
By measure(const Report& report) {
  bool cross = true, held_out = true;
  for (const Fit& fit : report.fits) {
    if (!usable(fit)) continue;
    cross &= fit.cross_validated.has_value();
    held_out &= fit.held_out.has_value();
  }
  return cross ? By::cross_validation : held_out ? By::held_out : By::fit;
}

// Returns the fits that may be chosen; all that are usable where each has a reason not to be.
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

// Is it about as good as the best one at every kind of parts?
bool costs_no_kind(const Fit& fit, const Fit& best, By by, double tolerance, double negligible) {
  if (by != By::cross_validation) return true;
  for (std::size_t k = 0; k < std::min(fit.kinds.size(), best.kinds.size()); ++k)
    if (fit.kinds[k] > std::max({(1 + tolerance) * best.kinds[k], negligible, exact})) return false;
  return true;
}

// Says how close the fits behind the chosen one are; `fits` are in ascending order of their errors.
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

// Each reason once, with the models that it stands for.
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
    if (is_near && free_in(*fit) < free_in(*chosen) &&
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
      near < negligible ? fmt::format("below {:.2g} %, where it says nothing", negligible)
                        : fmt::format("within {:.0f} % of the smallest", 100 * tolerance),
      chosen->model, free_in(*chosen), error_of(*chosen, by), smallest, fits.front()->model,
      runners_up(fits, *chosen, by));
}

void keep_off_bounds(Fit& fit, std::span<const std::string_view> but_for) {
  std::string names;
  for (const Estimate& e : fit.parameters)
    if (e.at_bound && std::ranges::find(but_for, e.name) == but_for.end())
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

}  // namespace sinew::identify
