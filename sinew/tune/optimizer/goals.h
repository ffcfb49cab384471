// tune/optimizer/goals.h - evaluation of a candidate's runs: its goals, and its distance from the
// limits. Pure.
//
// A candidate has a run in each circumstance: each case, seed and draw of uncertain values. A run
// violates a limit by (value - limit) / |limit|, or by the difference itself if the limit is 0; a
// run without figures violates every limit by `without_figures`.
//
//   holds      the share of the runs' weights for which all limits hold
//   violation  the mean of the runs' violations, the least first, over the share `hold`; it is 0 if
//              all limits hold for that share: the candidate is then feasible
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/tune/figure.h"

namespace sinew::tune {

// A figure that is minimised or maximised.
struct Goal {
  Figure figure;
  bool maximize = false;
};

// A limit for a figure.
struct Limit {
  Figure figure;
  Condition::Is is = Condition::Is::at_most;
  double limit = 0;  // in the figure's unit
  std::string text;  // as written
  double si = 0;     // `limit` in SI
};

struct Goals {
  // mean: weighted mean of the runs; worst: the worst run.
  enum class Over { mean, worst };

  std::vector<Goal> goals;
  std::vector<Limit> limits;
  Over over = Over::mean;
  double hold = 1;  // share of the runs for which all limits must hold, above 0, at most 1
};

// The figures of one run, in the units of the goals and limits.
struct Figures {
  double weight = 1;
  bool ok = false;  // has all figures
  std::vector<double> goals, limits;
};

inline constexpr double without_figures = 1000;  // a violation larger than that of any figure

// The evaluation of a candidate's runs.
struct CandidateEvaluation {
  std::vector<double> goals;   // over the runs with figures; NaN without such runs
  std::vector<double> limits;  // the worst of those runs
  double violation = 0;
  double holds = 1;

  // Returns whether all limits hold.
  bool feasible() const { return violation == 0; }
};

// Evaluates at least one run. Does not throw.
CandidateEvaluation evaluate(const Goals& goals, std::span<const Figures> runs);

// Returns the costs that an optimiser minimises, one per goal. An infeasible candidate costs more
// than any feasible one, increasing with its violation.
std::vector<double> costs(const Goals& goals, const CandidateEvaluation& evaluation);

// Returns whether `a` is as good as `b` in every goal and better in one, or feasible while `b` is
// not, or less infeasible than `b`.
bool dominates(const Goals& goals, const CandidateEvaluation& a, const CandidateEvaluation& b);

// Returns the indices of those that no other dominates, the best in the first goal first; of equal
// ones the first. Empty if none is feasible.
std::vector<std::size_t> front(const Goals& goals, std::span<const CandidateEvaluation> evaluation);

}  // namespace sinew::tune
