// identify/pair/pair_air.h - the air that a sealed pair traps, from its pressures and the position.
//
//   P_i = P_0i exp(-+ s_i (x - x_0) - l_i (t - t_0)),   s_i = n A_i/V_i
//
//   P   absolute pressure [Pa]      s   its relative change with the position [1/m] or [1/rad]
//   n   polytropic exponent         A   -dV/dL of the muscle [m2]; of a joint with the arm: [m3]
//   V   its air, hoses included     l   leak [1/s]
//
// `alike` has one s for both muscles, `each` two, `leaking` two and leaks. Only the product n A/V
// is told: it is the first order of V^-n for strokes small against V/A, which a pressure does not
// take apart. With the area A from the effort the trapped air's stiffness is A (s_1 P_1 + s_2 P_2).
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
