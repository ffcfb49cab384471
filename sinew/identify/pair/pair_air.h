// identify/pair/pair_air.h - the air that a sealed pair traps, from its pressures and the position.
//
//   P_j = P_start,j exp(-+ a_j (x - x_0) - omega_j (t - t_0)),   a_j = n_p A_j/V_j,   j = a, b
//
//   P     absolute pressure [Pa]     a      its relative change with the position [1/m] or [1/rad]
//   n_p   polytropic exponent        A      -dV/dL of the muscle [m2]; of a joint times the arm
//   V     its air, hoses included    omega  leak [1/s]
//
// `alike` has one a for both muscles, `each` two, `leaking` two and leaks. Only the product
// n_p A/V is determined: it is the first order of V^-n_p for strokes small against V/A, which a
// pressure does not take apart. With the area A from the effort the trapped air's stiffness is A
// (a_a P_a + a_b P_b).
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/fit/fit.h"
#include "sinew/identify/fit/wish.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// What the pressures say.
struct PairAir {
  Report report;                 // of the pressures
  std::vector<double> slope;     // s of each muscle, > 0  [1/m] or [1/rad]
  std::vector<double> pressure;  // P_0 of each, mean over the recordings [Pa]
  std::vector<bool> falls;       // does it fall as the position grows?
  double per_position = 0;       // change of P_b - P_a with the position [Pa/m] or [Pa/rad]
};

// Only samples of `fitted` are seen, one list for each recording. Throws Refusal where no recording
// has a pressure, or not all have the same.
PairAir identify_pair_air(std::span<const PairRecord> records,
                          std::span<const std::vector<std::size_t>> fitted, const Wishes& wishes);

// Returns the parameters that the laws of the air have, for Wishes::check().
std::vector<Parameter> pair_air_parameters(std::span<const PairRecord> records);

}  // namespace sinew::identify
