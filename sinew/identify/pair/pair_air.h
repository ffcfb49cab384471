// identify/pair/pair_air.h - trapped air of a sealed pair, identified from pressures and position.
//
//   P_j = P_start,j exp(-+ a_j (x - x_0) - omega_j (t - t_0)),   a_j = n_p A_j/V_j,   j = a, b
//
//   P     absolute pressure [Pa]     a      its relative change with the position [1/m] or [1/rad]
//   n_p   polytropic exponent        A      -dV/dL of the muscle [m2]; of a joint times the arm
//   V     its air, hoses included    omega  leak [1/s]
//
// `alike` has a common a for both muscles, `each` has two, `leaking` has two and leaks. Only
// the product n_p A/V is determined: it is the first order of V^-n_p for strokes that are small
// compared with V/A, and a pressure does not separate its factors. With the area A from the effort,
// the trapped air's stiffness is A (a_a P_a + a_b P_b).
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/contest/constraint.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// Result from the pressures.
struct PairAir {
  Report report;                 // report on the pressures
  std::vector<double> slope;     // a of each muscle, > 0 [1/m] or [1/rad]
  std::vector<double> pressure;  // P_start of each muscle, mean over the recordings [Pa]
  std::vector<bool> falls;       // for each muscle: falls with the position
  double per_position = 0;       // change of P_b - P_a with the position [Pa/m] or [Pa/rad]
};

// Identifies the air from the samples of `fitted`, one list for each recording. Throws Refusal if
// no recording has a pressure, or they have different ones.
PairAir identify_pair_air(std::span<const PairRecord> records,
                          std::span<const std::vector<std::size_t>> fitted,
                          const Constraints& constraints);

// Returns the parameters of all laws of the air, for Constraints::check().
std::vector<Parameter> pair_air_parameters(std::span<const PairRecord> records);

}  // namespace sinew::identify
