// identify/contest/profile.h - profiles of parameters: growth of a law's error when one parameter
// is held at another value and all others are fitted again.
//
//   error at x   sqrt(S(x)/S)            S(x): smallest sum of squares of all readings with the
//                                        parameter at x, S: the smallest of all
//   pinned       S(x) > S + t^2 s^2 i    at half and at twice the value; if bounds exclude
//                                        these, at 0.8 and 1.25 times the value
//
//   t            quantile 0.975 of Student's t
//   s, i         standard deviation of the residuals and inflation of its square by correlation,
//                as in least_squares.h
//
// So a parameter is pinned if its 95 % interval contains neither half nor twice its value. The
// interval of least_squares.h linearises the law; this one does not. A side on which a bound leaves
// less than a quarter of the way is not judged: at a bound near zero, such as that of a friction,
// only the other side counts. At any other bound nothing is pinned, as the optimum is beyond it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/contest/least_squares.h"

namespace sinew::identify {

// A least squares problem that can be solved again.
struct FitProblem {
  Residuals residuals;  // each thread calls a copy; its references live until conclude()
  std::size_t count = 0;
  std::vector<Parameter> parameters;
  SolverOptions options;
  Constraints constraints;
  std::size_t data = 0;  // number of residuals of data, the rest are priors; 0: all are data
};

// Returns the profile of each parameter of a solution; empty for frozen and tied ones, and if
// there are no more residuals than parameters. Uses all cores.
std::vector<std::optional<Profile>> profiles_of(const FitProblem& problem,
                                                const Solution& solution);

}  // namespace sinew::identify
