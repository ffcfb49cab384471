#include "sinew/identify/valve/fill_trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

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
        for (const Estimate& other : report.fits[k].parameters) {
          if (other.name != e.name) continue;
          e.low = std::min(e.low, other.low);
          e.high = std::max(e.high, other.high);
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
