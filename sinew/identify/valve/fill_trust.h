// identify/valve/fill_trust.h - how far the C/V of a filling can be trusted, beyond one model's
// interval.
#pragma once

#include <span>

#include "sinew/identify/fit/fit.h"
#include "sinew/identify/valve/fill.h"

namespace sinew::identify {

// One of fill_models(), fitted; its first parameter is C/V.
struct Tried {
  Fit fit;
  double squares = 0;     // sum of the residuals' [Pa2]
  double acceptable = 0;  // of which other values are as good, at 95 %
};

constexpr double well_known = 0.25;  // half an interval of C/V, of its value
// Returns half an estimate's interval, as a share of its value.
inline double half_of(const Estimate& e) { return 0.5 * (e.high - e.low) / e.value; }

// Fits one model to a curve; `other` scores it where there is one.
Tried try_fill(const FillModel& model, const Curve& curve, const ValveOptions& options,
               const Curve* other);

// Throw Refusal for a curve that still moves at its end, and for one that no model meets.
void refuse_unsettled(const Measured& data, const Curve& curve, const ValveOptions& options);
void refuse_poor_fit(const Measured& data, const Report& report, double worst);

// Throws Refusal where the curve does not tell C/V at all.
void refuse_undetermined(const Solution& solution);

// A curve's exponent is far from linear in its parameters: where a fixed exponent fits as well as
// the best, the intervals of the free one reach there. `tried` is in the order of fill_models().
void reach_for_fixed(std::span<Tried> tried);

// A model that leaves C/V open is no use where another meets the curve and does not.
void refuse_open(std::span<Tried> tried, double worst_fit);

// What the chamber is taken for matters more than the noise: the chosen model's C/V reaches over
// every model that the curve cannot tell from the best, or that fits no worse than the chosen.
void reach_over_models(std::span<const Tried> tried, Report& report);

}  // namespace sinew::identify
