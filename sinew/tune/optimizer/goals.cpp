#include "sinew/tune/optimizer/goals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew::tune {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Cost of an infeasible candidate: far above all goals, and small enough to distinguish violations.
constexpr double infeasible = 1e12;

bool upper(Condition::Is is) { return is == Condition::Is::below || is == Condition::Is::at_most; }

bool holds(const Limit& limit, double value) {
  switch (limit.is) {
    case Condition::Is::below:
      return value < limit.limit;
    case Condition::Is::at_most:
      return value <= limit.limit;
    case Condition::Is::above:
      return value > limit.limit;
    case Condition::Is::at_least:
      return value >= limit.limit;
  }
  return false;
}

double violation(const Limit& limit, double value) {
  if (holds(limit, value)) return 0;
  const double scale = limit.limit != 0 ? std::fabs(limit.limit) : 1;
  return std::clamp(std::fabs(value - limit.limit) / scale, 1e-9, without_figures);
}

double violation(const Goals& goals, const Figures& run) {
  if (!run.ok) return without_figures * static_cast<double>(goals.limits.size() + 1);
  double out = 0;
  for (std::size_t i = 0; i < goals.limits.size(); ++i)
    out += violation(goals.limits[i], run.limits[i]);
  return out;
}

// Returns the worse of two values, by the goal's direction, ignoring NaN.
double worse(double a, double b, bool more_is_better) {
  if (std::isnan(a)) return b;
  return more_is_better ? std::min(a, b) : std::max(a, b);
}

double goal_over(const Goals& goals, std::size_t i, std::span<const Figures> runs) {
  double sum = 0, weight = 0, worst = nan;
  for (const Figures& run : runs) {
    if (!run.ok) continue;
    sum += run.weight * run.goals[i];
    weight += run.weight;
    worst = worse(worst, run.goals[i], goals.goals[i].maximize);
  }
  if (weight == 0) return nan;
  return goals.over == Goals::Over::mean ? sum / weight : worst;
}

double worst_of(const Limit& limit, std::size_t i, std::span<const Figures> runs) {
  double out = nan;
  for (const Figures& run : runs)
    if (run.ok) out = worse(out, run.limits[i], !upper(limit.is));
  return out;
}

// A run's violation and weight. mean_up_to() returns the mean of the smallest violations, up
// to that share of the weights.
struct Weighed {
  double violation = 0, weight = 0;
};
double mean_up_to(double share, std::vector<Weighed> runs) {
  std::ranges::stable_sort(runs, {}, &Weighed::violation);
  double left = 0, sum = 0;
  for (const Weighed& run : runs) left += run.weight;
  left *= share;
  const double all = left;
  // A rest such as that of a share of 0.95 after nineteen of twenty runs is a rounding error.
  for (const Weighed& run : runs) {
    if (left <= 1e-9 * all) break;
    sum += run.violation * std::min(left, run.weight);
    left -= run.weight;
  }
  return sum / all;
}

double cost(const Goal& goal, double value) { return goal.maximize ? -value : value; }

}  // namespace

CandidateEvaluation evaluate(const Goals& goals, std::span<const Figures> runs) {
  CandidateEvaluation out;
  for (std::size_t i = 0; i < goals.goals.size(); ++i)
    out.goals.push_back(goal_over(goals, i, runs));
  for (std::size_t i = 0; i < goals.limits.size(); ++i)
    out.limits.push_back(worst_of(goals.limits[i], i, runs));
  std::vector<Weighed> weighed;
  double all = 0, good = 0;
  for (const Figures& run : runs) {
    weighed.push_back({violation(goals, run), run.weight});
    all += run.weight;
    if (weighed.back().violation == 0) good += run.weight;
  }
  out.holds = good / all;
  out.violation = mean_up_to(goals.hold, std::move(weighed));
  return out;
}

std::vector<double> costs(const Goals& goals, const CandidateEvaluation& evaluation) {
  std::vector<double> out;
  for (std::size_t i = 0; i < goals.goals.size(); ++i)
    out.push_back(evaluation.feasible() ? std::clamp(cost(goals.goals[i], evaluation.goals[i]),
                                                     -0.5 * infeasible, 0.5 * infeasible)
                                        : infeasible * (1 + evaluation.violation));
  return out;
}

bool dominates(const Goals& goals, const CandidateEvaluation& a, const CandidateEvaluation& b) {
  if (!a.feasible() || !b.feasible()) return a.violation < b.violation;
  bool better = false;
  for (std::size_t i = 0; i < goals.goals.size(); ++i) {
    const double of_a = cost(goals.goals[i], a.goals[i]), of_b = cost(goals.goals[i], b.goals[i]);
    if (of_a > of_b) return false;
    better = better || of_a < of_b;
  }
  return better;
}

std::vector<std::size_t> front(const Goals& goals,
                               std::span<const CandidateEvaluation> evaluation) {
  const auto before = [&](std::size_t a, std::size_t b) {
    for (std::size_t i = 0; i < goals.goals.size(); ++i) {
      const double of_a = cost(goals.goals[i], evaluation[a].goals[i]);
      const double of_b = cost(goals.goals[i], evaluation[b].goals[i]);
      if (of_a != of_b) return of_a < of_b;
    }
    return a < b;
  };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < evaluation.size(); ++i)
    if (evaluation[i].feasible()) order.push_back(i);
  std::ranges::sort(order, before);
  // A later candidate in this order cannot dominate an earlier one.
  std::vector<std::size_t> out;
  for (const std::size_t i : order) {
    const bool beaten = std::ranges::any_of(out, [&](std::size_t j) {
      return dominates(goals, evaluation[j], evaluation[i]) ||
             evaluation[j].goals == evaluation[i].goals;
    });
    if (!beaten) out.push_back(i);
  }
  return out;
}

}  // namespace sinew::tune
