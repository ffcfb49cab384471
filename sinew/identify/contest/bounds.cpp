#include "sinew/identify/contest/bounds.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sinew::identify {

namespace {

// Returns the bound at which the estimate is, if it may be widened; null otherwise.
double* guessed_bound(const Estimate& e, Parameter& p) {
  if (!e.at_bound || !p.may_widen) return nullptr;
  double& bound = e.value - p.low < p.high - e.value ? p.low : p.high;
  const bool limits_the_size = &bound == &p.high ? bound > 0 : bound < 0;
  return limits_the_size ? &bound : nullptr;
}

Solution solved(const FitProblem& problem) {
  return least_squares(problem.residuals, problem.count, problem.parameters, problem.constraints,
                       problem.options);
}

}  // namespace

void start_at(std::span<const double> values, FitProblem& problem) {
  for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
    Parameter& p = problem.parameters[i];
    p.start = std::clamp(values[i], p.low, p.high);
  }
}

Solution least_squares_within(FitProblem& problem) {
  Solution found = solved(problem);
  std::vector<const double*> widened;
  std::vector<std::size_t> frozen;
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
      Parameter& p = problem.parameters[i];
      double* bound = guessed_bound(found.estimates[i], p);
      if (!bound || std::ranges::count(frozen, i) > 0) continue;
      is_changed = true;
      if (std::ranges::count(widened, bound) == 0) {
        *bound *= 2;
        widened.push_back(bound);
        continue;
      }
      problem.constraints = problem.constraints.with_frozen(p.name, *bound);
      frozen.push_back(i);
    }
    if (!is_changed) break;
    start_at(found.values, problem);
    found = solved(problem);
  }
  for (const std::size_t i : frozen) found.estimates[i].known = "frozen at its bound";
  return found;
}

}  // namespace sinew::identify
