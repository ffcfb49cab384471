// tune/optimizer/goals.h - what the runs of a candidate say together: its goals, and how far it is
// from what must hold. Pure.
//
// A candidate has a run in each circumstance: each case, seed and draw of what is not known. A run
// violates a limit by (value - limit) / |limit|, or by the difference itself where the limit is 0;
// a run without figures violates everything by `without_figures`.
//
//   holds      the share of the runs' weights in which every limit holds
//   violation  the mean of the runs' violations, least first, as far as `hold` reaches; 0 where
//              every limit holds in that share of them: then the candidate is feasible
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/tune/figure.h"

namespace sinew::tune {

// A figure that is to become small, or large.
struct Goal {
  Figure figure;
  bool maximize = false;
};

// A figure that has to keep to one side of a value.
struct Limit {
  Figure figure;
  Condition::Is is = Condition::Is::at_most;
  double limit = 0;  // in the figure's unit
  std::string text;  // as written
  double si = 0;     // the same in SI
};

struct Goals {
  // mean: of the runs' weights; worst: of the runs.
  enum class Over { mean, worst };

  std::vector<Goal> goals;
  std::vector<Limit> limits;
  Over over = Over::mean;
  double hold = 1;  // the share of the runs in which every limit must hold, above 0, at most 1
};

// The figures of one run, in the units of the goals and limits.
struct Figures {
  double weight = 1;
  bool ok = false;  // has all of them
  std::vector<double> goals, limits;
};

inline constexpr double without_figures = 1000;  // a violation that no figure reaches

// Holds what a candidate's runs come to.
struct Judgement {
  std::vector<double> goals;   // over the runs that have figures; not a number where none has
  std::vector<double> limits;  // the worst of those runs
  double violation = 0;
  double holds = 1;

  // Are all limits kept?
  bool feasible() const { return violation == 0; }
};

// Throws nothing; `runs` has one at least.
Judgement judge(const Goals& goals, std::span<const Figures> runs);

// Returns what an optimiser is to make small, a number for each goal. One that is not feasible
// costs more than any that is, the more the farther it is from that.
std::vector<double> costs(const Goals& goals, const Judgement& judged);

// Is `a` as good as `b` in every goal and better in one, or feasible where b is not, or closer to
// that?
bool dominates(const Goals& goals, const Judgement& a, const Judgement& b);

// Returns the numbers of those that no other dominates, the best in the first goal first; of equal
// ones the first. None where nothing is feasible.
std::vector<std::size_t> front(const Goals& goals, std::span<const Judgement> judged);

}  // namespace sinew::tune
