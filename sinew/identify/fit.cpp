#include "sinew/identify/fit.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/identify/refusal.h"

namespace sinew::identify {

Score score(std::span<const double> residuals, double full_scale) {
  Score out{.points = residuals.size()};
  double sum = 0;
  for (const double r : residuals) {
    sum += r * r;
    out.max = std::max(out.max, std::abs(r));
  }
  if (!residuals.empty()) out.rmse = std::sqrt(sum / static_cast<double>(residuals.size()));
  if (full_scale > 0) {
    out.rmse_percent = 100 * out.rmse / full_scale;
    out.max_percent = 100 * out.max / full_scale;
  }
  return out;
}

namespace {

bool usable(const Fit& fit) { return fit.refused.empty(); }

enum class By { cross_validation, held_out, fit };

double error_of(const Fit& fit, By by) {
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

[[noreturn]] void refuse_all(const Report& report) {
  std::string reasons;
  for (const Fit& fit : report.fits)
    reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", fit.model, fit.refused);
  throw Refusal(report.subject, "no model that the data support (" + reasons + ")",
                "data that determine the simplest of them", "");
}

}  // namespace

void choose(Report& report, double tolerance, double negligible) {
  const By by = measure(report);
  const Fit* smallest = nullptr;
  for (const Fit& fit : report.fits)
    if (usable(fit) && (!smallest || error_of(fit, by) < error_of(*smallest, by))) smallest = &fit;
  if (!smallest) refuse_all(report);

  const double near = (1 + tolerance) * error_of(*smallest, by);
  const double limit = std::max(near, negligible);
  const Fit* chosen = smallest;
  for (const Fit& fit : report.fits)
    if (usable(fit) && error_of(fit, by) <= limit &&
        fit.parameters.size() < chosen->parameters.size())
      chosen = &fit;

  report.chosen = static_cast<std::size_t>(chosen - report.fits.data());
  report.rule = fmt::format(
      "fewest parameters among those whose {} error is {}: {} has {} and {:.3g} %, the smallest is "
      "{:.3g} % ({})",
      by == By::cross_validation ? "cross-validated"
      : by == By::held_out       ? "held-out"
                                 : "fit",
      near < negligible ? fmt::format("below {:.2g} %, where it says nothing", negligible)
                        : fmt::format("within {:.0f} % of the smallest", 100 * tolerance),
      chosen->model, chosen->parameters.size(), error_of(*chosen, by), error_of(*smallest, by),
      smallest->model);
}

}  // namespace sinew::identify
