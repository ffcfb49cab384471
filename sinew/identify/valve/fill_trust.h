// identify/valve/fill_trust.h - uncertainty of C/V from a filling, in addition to one model's
// interval.
#pragma once

#include <span>

#include "sinew/identify/contest/fit.h"
#include "sinew/identify/valve/fill.h"

namespace sinew::identify {

// One of fill_models(), fitted; its first parameter is C/V.
struct FittedFill {
  Fit fit;
  double squares = 0;     // sum of squared residuals [Pa2]
  double acceptable = 0;  // largest sum that is compatible with the best, at 95 % [Pa2]
};

constexpr double well_known = 0.25;  // half of the interval of C/V, relative to its value
// Returns half of an estimate's interval, relative to its value.
inline double half_of(const Estimate& e) { return 0.5 * (e.high - e.low) / e.value; }

// Fits one model to a curve; `other`, if not null, scores it.
FittedFill try_fill(const FillModel& model, const Curve& curve, const ValveOptions& options,
                    const Curve* other);

// Throw Refusal for a curve that still moves at its end, and for one that no model fits.
void refuse_unsettled(const Measured& data, const Curve& curve, const ValveOptions& options);
void refuse_poor_fit(const Measured& data, const Report& report, double worst);

// Throws Refusal if the curve does not determine C/V.
void refuse_undetermined(const Solution& solution);

// Widens the intervals of free exponents to fixed exponents that fit as well as the best: a
// curve is strongly nonlinear in the exponent. `tried` is in the order of fill_models().
void reach_for_fixed(std::span<FittedFill> tried);

// Refuses models that leave C/V undetermined if another one fits the curve and determines it.
void refuse_undetermined_models(std::span<FittedFill> tried, double worst_fit);

// Widens the chosen model's interval of C/V to those of every model that the curve cannot
// distinguish from the best, or that fits no worse than the chosen one: the assumed chamber matters
// more than the noise.
void reach_over_models(std::span<const FittedFill> tried, Report& report);

}  // namespace sinew::identify
