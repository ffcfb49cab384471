#include "sinew/identify/valve/fill_trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

void refuse_undetermined(const Solution& s) {
  const Estimate& k = s["conductance_per_volume"];
  if (k.at_bound) throw Refusal(k.name, "a fit at the bound of its range", "one within it", "");
  if (!std::isfinite(k.high))
    throw Refusal(k.name, "nothing in the curve that depends on it alone", "an interval", "");
}

void reach_for_fixed(std::span<FittedFill> tried) {
  const std::span<const FillModel> models = fill_models();
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t k = 0; k < models.size(); ++k) {
      const FillModel &free = models[i], &fixed = models[k];
      if (free.exponent != 0 || fixed.exponent == 0 || free.shape != fixed.shape ||
          free.flow != fixed.flow || !tried[i].fit.refused.empty() ||
          !tried[k].fit.refused.empty() || tried[k].squares > tried[i].acceptable)
        continue;
      for (Estimate& e : tried[i].fit.parameters) {
        if (e.at_bound) continue;
        if (e.name == "polytropic_exponent") {
          e.low = std::min(e.low, fixed.exponent);
          e.high = std::max(e.high, fixed.exponent);
          e.identifiable = false;
        }
        for (const Estimate& other : tried[k].fit.parameters) {
          if (other.name != e.name) continue;
          e.low = std::min(e.low, other.low);
          e.high = std::max(e.high, other.high);
          e.identifiable &= half_of(e) <= well_known;
        }
      }
    }
}

void refuse_undetermined_models(std::span<FittedFill> tried, double worst_fit) {
  const auto open = [](const Fit& fit) { return !(half_of(fit.parameters.front()) <= 1); };
  const bool others = std::any_of(tried.begin(), tried.end(), [&](const FittedFill& t) {
    return t.fit.refused.empty() && t.fit.fit.rmse_percent <= worst_fit && !open(t.fit);
  });
  if (!others) return;
  for (FittedFill& t : tried)
    if (t.fit.refused.empty() && open(t.fit))
      t.fit.refused =
          fmt::format("leaves C/V open by +- {:.0f} %", 100 * half_of(t.fit.parameters.front()));
}

void reach_over_models(std::span<const FittedFill> tried, Report& report) {
  const FittedFill* best = &tried[report.chosen];
  for (const FittedFill& t : tried)
    if (t.fit.refused.empty() && t.squares < best->squares) best = &t;
  const double acceptable = std::max(best->acceptable, tried[report.chosen].squares);

  Fit& chosen = report.fits[report.chosen];
  Estimate& k = chosen.parameters.front();
  std::string names;
  for (const FittedFill& t : tried) {
    if (!t.fit.refused.empty() || t.squares > acceptable) continue;
    const Estimate& other = t.fit.parameters.front();
    if (t.fit.model != chosen.model && (other.low < k.low || other.high > k.high))
      names += (names.empty() ? "" : ", ") + t.fit.model;
    k.low = std::min(k.low, other.low);
    k.high = std::max(k.high, other.high);
  }
  if (names.empty()) return;
  k.standard_error = 0.25 * (k.high - k.low);
  k.identifiable = half_of(k) <= well_known;
  chosen.notes.push_back(
      "the curve does not distinguish the chamber from others, and the interval of C/V covers "
      "them: " +
      names);
}

}  // namespace sinew::identify
