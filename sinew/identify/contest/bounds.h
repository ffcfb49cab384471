// identify/contest/bounds.h - parameters that end at a bound which is only a guess of their size.
//
//   high > 0   ->   2 high           low < 0   ->   2 low
//
// Such a bound is widened once where the optimum is beyond it. Where the optimum is beyond the
// wider bound too, the parameter is frozen there and the others are fitted again: the data
// determine that it is large and not how large, and the law competes with one parameter less. A
// bound that limits the value towards zero stays: it is a matter of sign, of geometry, or the limit
// at which the law becomes a simpler one. The bounds of a parameter with a user's prior stay too.
#pragma once

#include "sinew/identify/contest/profile.h"

namespace sinew::identify {

// Minimises the residuals of the problem. Writes widened bounds (Parameter::may_widen) and frozen
// parameters into it, so that cross-validation and profiles search the same ranges.
Solution least_squares_within(FitProblem& problem);
// Widens and freezes the parameters that a solution has at guessed bounds, and solves again.
Solution least_squares_within(FitProblem& problem, Solution found);

// Returns the solution within the bounds as they are.
Solution least_squares(const FitProblem& problem);

// Returns the solutions from these starts, each with one value per parameter. A start at which the
// law is undefined has none; throws Refusal if all are of this kind.
std::vector<Solution> solutions_from(std::span<const std::vector<double>> starts,
                                     FitProblem problem);
// Returns the solution with the smallest loss, the earlier of equal ones.
const Solution& best_of(std::span<const Solution> solutions, const SolverOptions& options);

// Moves the starts of the problem's parameters to these values, within their bounds.
void start_at(std::span<const double> values, FitProblem& problem);

}  // namespace sinew::identify
