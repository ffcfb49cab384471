// identify/fit/profile.h - whether the data pin a parameter: how much more a law misses them by
// with another value of that parameter, when all the others are fitted again.
//
//   error at x   sqrt(S(x)/S)            S(x): smallest sum of squares with the parameter at x,
//                                        S: the smallest of all
//   pinned       S(x) > S + t^2 s^2 i    at half and at twice the value
//
//   t            quantile 0.975 of Student's t
//   s, i         standard deviation of the residuals and inflation of its square by correlation,
//                as in least_squares.h
//
// So a parameter is pinned if its 95 % interval holds neither half nor twice its value. The
// interval of least_squares.h takes the law for a straight line, and this one does not. A side on
// which a bound leaves less than a quarter of that way is not judged: at a bound near zero, such as
// that of a friction, the other side counts. At another bound nothing is pinned, as the data would
// have the value beyond it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sinew/identify/fit/least_squares.h"
#include "sinew/identify/fit/wish.h"

namespace sinew::identify {

// A problem of least squares that can be solved again.
struct FitProblem {
  Residuals residuals;  // each thread calls a copy; what it refers to lives until conclude()
  std::size_t count = 0;
  std::vector<Parameter> parameters;
  SolverOptions options;
  Wishes wishes;
  std::size_t data = 0;  // as many residuals are of data, the rest of what was known; 0: all are
};

// Returns the profile of each parameter of a solution; nothing for those that are frozen or
// tied, and where there are no more residuals than parameters. All cores work on it.
std::vector<std::optional<Profile>> profiles_of(const FitProblem& problem,
                                                const Solution& solution);

}  // namespace sinew::identify
