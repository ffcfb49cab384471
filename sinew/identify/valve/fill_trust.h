// identify/valve/fill_trust.h - uncertainty of C/V from a filling, in addition to one model's
// interval. All reports have a fit for each of fill_models(), whose first parameter is C/V, or C.
#pragma once

#include <span>
#include <string>

#include "sinew/identify/contest/fit.h"
#include "sinew/identify/valve/fill.h"

namespace sinew::identify {

// Sums of squared residuals of a fit [Pa2].
struct FillSquares {
  double found = 0;
  double acceptable = 0;  // largest that is compatible with the best, at 95 %
};

// Returns the sums of each fit that was not refused, before the choice.
std::vector<FillSquares> squares_of(const Report& report);

constexpr double well_known = 0.25;  // half of the interval of C/V, relative to its value
// Returns half of an estimate's interval, relative to its value.
inline double half_of(const Estimate& e) { return 0.5 * (e.high - e.low) / e.value; }

// Throw Refusal for a curve that still moves at its end, and for one that no model fits.
void refuse_unsettled(const Measured& data, const Curve& curve, const ValveOptions& options);
void refuse_poor_fit(const Measured& data, const Report& report, double worst);

// Widens the intervals of free exponents to fixed exponents that fit as well as the best: a
// curve is strongly nonlinear in the exponent.
void reach_for_fixed(std::span<const FillSquares> squares, Report& report);

// Refuses models that leave C/V undetermined if another one fits the curve and determines it.
void refuse_undetermined_models(Report& report, double worst_fit);

// Widens the chosen model's intervals of its first `count` parameters to those of every model that
// the curve cannot distinguish from the best, or that fits no worse than the chosen one: the
// assumed chamber matters more than the noise. Returns the names of these models; of one parameter,
// those that widen its interval.
std::string reach_over_models(std::span<const FillSquares> squares, std::size_t count,
                              Report& report);

}  // namespace sinew::identify
