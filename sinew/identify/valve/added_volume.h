// identify/valve/added_volume.h - conductance and volume told apart: the same valve fills the same
// chamber, once as it is and once with a known volume joined to it.
//
//   k_V,i = C/(V + dV_i)      1/k_V,2 - 1/k_V,1 = (dV_2 - dV_1)/C        V = C/k_V,1 - dV_1
//
// One curve has k_V alone. All curves are fitted at once: C, V, b_crit and the exponent are common
// to them, the port's pressure and the opening instant each curve's own. V does not depend on an
// error of all k_V alike, such as that of an exponent; C does.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/identify/valve/fill_trust.h"
#include "sinew/identify/valve/valve.h"

namespace sinew::identify {

// One filling, and the volume that was joined to the chamber for it.
struct AddedFill {
  Measured data;
  double added = 0;  // [m3]
};

// Half-widths of 95 % intervals, of the value  [-].
struct Separation {
  double conductance = 0, volume = 0;
};

// Returns how well two fillings tell conductance and volume where each knows its C/V to `half` of
// the value, at random, and the second has `ratio` times the chamber's volume joined to it.
Separation expected_separation(double half, double ratio);

// Returns the fillings of a table whose column added_volume says which row is of which: by its
// values, one after the other. Throws Refusal where there is no such column.
std::vector<AddedFill> fills_by_column(const Measured& data);

// Fits one model to all of them: its first two parameters are C and V.
Tried try_added(const FillModel& model, std::span<const AddedFill> fills,
                const ValveOptions& options);

// Returns what these fillings tell. Throws Refusal for fewer than two different volumes.
ValveResult identify_added(std::span<const AddedFill> fills, const ValveOptions& options);

// Returns what further measurement would tell C from V, and how well, in sentences: for a curve
// that knows C/V to `half` of its value by its noise, and to `over_models` whatever the chamber is
// taken for  [-].
std::vector<std::string> ways_to_separate(double half, double over_models);

}  // namespace sinew::identify
