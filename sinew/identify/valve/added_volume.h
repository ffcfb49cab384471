// identify/valve/added_volume.h - separation of conductance and volume: the same valve fills the
// same chamber with different known volumes joined to it.
//
//   k_V,i = C/(V + dV_i)      1/k_V,2 - 1/k_V,1 = (dV_2 - dV_1)/C        V = C/k_V,1 - dV_1
//
// A single curve determines k_V only. All curves are fitted together: C, V, b_crit and the
// exponent are common, the port's pressure and the opening instant are each curve's own. A common
// relative error of all k_V, such as that of an exponent, affects C but not V.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/identify/valve/fill.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

// One filling, with the volume that was joined to the chamber.
struct AddedFill {
  Measured data;
  double added = 0;  // [m3]
};

// Relative half-widths of 95 % intervals [-].
struct Separation {
  double conductance = 0, volume = 0;
};

// Returns the accuracy of conductance and volume from two fillings, each with a random relative
// uncertainty `half` of C/V; the second has `ratio` times the chamber's volume joined to it.
Separation expected_separation(double half, double ratio);

// Returns the fillings of a table, divided by the values of its column added_volume. Throws Refusal
// if there is no such column.
std::vector<AddedFill> fills_by_column(const Measured& data);

// Fits each model to all fillings, whose curves are given: the first two parameters are C and V.
// All arguments must live until the report is concluded.
void fit_added(std::span<const AddedFill> fills, std::span<const Curve> curves,
               const ValveOptions& options, Report& report,
               std::span<const FillModel> models = fill_models());

// Identifies the valve from these fillings. Throws Refusal for fewer than two different volumes.
ValveResult identify_added(std::span<const AddedFill> fills, const ValveOptions& options);

// Returns sentences about further measurements that separate C from V, and their accuracy. The
// curve's C/V has a relative uncertainty `half` due to noise, and `over_models` over all models of
// the chamber [-].
std::vector<std::string> ways_to_separate(double half, double over_models);

}  // namespace sinew::identify
