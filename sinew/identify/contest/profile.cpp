#include "sinew/identify/contest/profile.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/contest/bounds.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify {

namespace {

constexpr std::size_t middle = 2;  // index of the factor 1

// A value smaller than this share of its scale is near zero, if its range contains zero.
constexpr double smallest_share = 0.05;

bool is_near_zero(const Parameter& p, double value) {
  return p.low <= 0 && p.high >= 0 && std::abs(value) < smallest_share * p.scale;
}

// A parameter's value moved by a factor, within its bounds, and whether it reaches a quarter of the
// way.
struct Moved {
  double to = 0;
  bool is_far = false;
};
Moved moved(const Parameter& p, double value, double factor) {
  const double wanted = is_near_zero(p, value) ? value + (factor - 1) * p.scale : factor * value;
  const double to = std::clamp(wanted, p.low, p.high);
  return {to, std::abs(to - value) > 0.25 * std::abs(wanted - value)};
}

// Returns the loss of all readings, those within averages included.
double loss_of(const FitProblem& problem, std::span<const double> residuals) {
  const std::size_t data = problem.data > 0 ? problem.data : problem.count;
  const std::vector<double>&weights = problem.options.weights,
        &variances = problem.options.variances;
  double out = loss_of(residuals, problem.options, data);
  for (std::size_t i = 0; i < std::min(data, variances.size()); ++i)
    out += weights[i] * variances[i];
  return out;
}

// The first steps show whether a loss is far beyond the limit, where its size is irrelevant.
constexpr double far_beyond = Profile::most * Profile::most;
constexpr int first_steps = 8, more_steps = 60;

// Fits the other parameters from `values` with one held at `value`, and writes the result to
// `values`. `held` is a copy of the problem for this thread. Returns the loss, or an upper bound if
// it is far beyond `limit`; infinite if the law is undefined.
double loss_with(const FitProblem& problem, std::size_t which, double value, double limit,
                 std::vector<double>& values, FitProblem& held) {
  held.constraints = problem.constraints.with_frozen(problem.parameters[which].name, value);
  double loss = unbounded;
  const auto improve = [&](int steps, double tolerance) {
    start_at(values, held);
    held.options.most_steps = std::min(problem.options.most_steps, steps);
    held.options.tolerance = tolerance;
    Solution s = least_squares(held);
    values = std::move(s.values);
    loss = loss_of(problem, s.residuals);
  };
  try {
    improve(first_steps, 1e-3);
    if (loss < far_beyond * limit) improve(more_steps, 1e-6);
  } catch (const Refusal&) {
    return unbounded;
  }
  return loss;
}

}  // namespace

std::vector<std::optional<Profile>> profiles_of(const FitProblem& problem,
                                                const Solution& solution) {
  const std::size_t n = solution.estimates.size();
  std::vector<std::optional<Profile>> out(n);
  if (solution.freedom < 1) return out;
  const double best = loss_of(problem, solution.residuals);
  const double t = t_quantile(solution.freedom), s = solution.standard_deviation;
  const double limit = best + t * t * s * s * solution.inflation;
  for (std::size_t i = 0; i < n; ++i)
    if (solution.estimates[i].free)
      out[i] = {.error = {1, 1, 1, 1, 1},
                .near_zero = is_near_zero(problem.parameters[i], solution.values[i])};
  constexpr double cannot_move = -1;
  std::vector<double> ends(2 * n, cannot_move);
  host::side_by_side(2 * n, [&](std::size_t k) {
    const std::size_t i = k / 2;
    if (!out[i]) return;
    // The value moves in two steps; the other parameters start from those of the step before.
    FitProblem held = problem;
    held.options.correlated = false;
    for (Parameter& p : held.parameters) p.is_scaled_by_start = false;
    std::vector<double> values = solution.values;
    for (std::size_t step = 1; step <= 2; ++step) {
      const std::size_t at = k % 2 == 0 ? middle - step : middle + step;
      const auto [to, is_far] =
          moved(problem.parameters[i], solution.values[i], Profile::factors[at]);
      if (!is_far) {
        out[i]->error[at] = std::nan("");
        continue;
      }
      ends[k] = loss_with(problem, i, to, limit, values, held);
      const double ratio = best > 0 ? std::sqrt(ends[k] / best) : ends[k] > 0 ? unbounded : 1;
      out[i]->error[at] = std::min(ratio, Profile::most);
    }
  });
  for (std::size_t i = 0; i < n; ++i) {
    if (!out[i]) continue;
    const auto excluded = [&](double loss) { return loss == cannot_move || loss > limit; };
    const bool moves = ends[2 * i] != cannot_move || ends[2 * i + 1] != cannot_move;
    const bool is_cut = solution.estimates[i].at_bound && !out[i]->near_zero;
    out[i]->pinned = moves && !is_cut && excluded(ends[2 * i]) && excluded(ends[2 * i + 1]);
  }
  return out;
}

}  // namespace sinew::identify
