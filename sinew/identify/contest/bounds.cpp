#include "sinew/identify/contest/bounds.h"

#include <algorithm>
#include <vector>

#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

// Returns the bound at which the estimate is, if it may be widened; null otherwise.
double* guessed_bound(const Estimate& e, Parameter& p) {
  if (!e.at_bound || !e.free || !p.may_widen) return nullptr;
  double& bound = e.value - p.low < p.high - e.value ? p.low : p.high;
  const bool limits_the_size = &bound == &p.high ? bound > 0 : bound < 0;
  return limits_the_size ? &bound : nullptr;
}

}  // namespace

Solution least_squares(const FitProblem& problem) {
  return least_squares(problem.residuals, problem.count, problem.parameters, problem.constraints,
                       problem.options);
}

std::vector<Solution> solutions_from(std::span<const std::vector<double>> starts,
                                     FitProblem problem) {
  std::vector<Solution> out;
  for (const std::vector<double>& start : starts) {
    start_at(start, problem);
    try {
      out.push_back(least_squares(problem));
    } catch (const Refusal&) {
      if (&start == &starts.back() && out.empty()) throw;
    }
  }
  return out;
}

const Solution& best_of(std::span<const Solution> solutions, const SolverOptions& options) {
  return *std::ranges::min_element(
      solutions, {}, [&](const Solution& s) { return loss_of(s.residuals, options); });
}

void start_at(std::span<const double> values, FitProblem& problem) {
  for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
    Parameter& p = problem.parameters[i];
    p.start = std::clamp(values[i], p.low, p.high);
    if (p.is_scaled_by_start) p.scale = p.start;
  }
}

Solution least_squares_within(FitProblem& problem) {
  return least_squares_within(problem, least_squares(problem));
}

Solution least_squares_within(FitProblem& problem, Solution found) {
  std::vector<const double*> widened;
  for (bool is_changed = true; is_changed;) {
    is_changed = false;
    for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
      Parameter& p = problem.parameters[i];
      double* bound = guessed_bound(found.estimates[i], p);
      const Constraint* known = problem.constraints.of(p.name);
      if (!bound || (known && known->kind == Constraint::Kind::prior)) continue;
      is_changed = true;
      if (std::ranges::count(widened, bound) == 0) {
        *bound *= 2;
        widened.push_back(bound);
        continue;
      }
      problem.constraints = problem.constraints.with_frozen(p.name, *bound, true);
    }
    if (!is_changed) break;
    start_at(found.values, problem);
    found = least_squares(problem);
  }
  return found;
}

}  // namespace sinew::identify
