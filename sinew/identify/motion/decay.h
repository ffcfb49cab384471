// identify/motion/decay.h - viscous and dry damping from the decrease of the turns of a free decay,
// 3.4.
//
//   d x = X (1 - b) + 4 Q                    as printed, [45]
//   d x = X (1 - b) + Q (1 + sqrt b)^2       exactly, for a linear spring
//
//   X    amplitude about the rest, of one side [m]      d x  its decrease over one period [m]
//   b    share that viscous damping leaves in a period, exp(-zeta w_n T_d) [-], [51]
//   Q    dry friction per stiffness of the sealed muscle, mu N/k [m]
//   c = 2 m/T_d ln(1/b)  [N s/m], [52]       zeta_eq = ln(X/(X - d x))/(2 pi), [53]
//
// Between two turns the friction moves the center by Q: with s = sqrt b an amplitude A becomes s
// A - Q (1 + s), and twice this gives the exact form. [45] sets b = 1 in its friction; then [49]
// underestimates Q by a factor (1 + sqrt b)^2/4, 10 % at zeta = 0.035. Both forms assume a linear
// spring, which a muscle is not.
#pragma once

#include "sinew/identify/contest/least_squares.h"
#include "sinew/identify/motion/turns.h"

namespace sinew::identify {

// Form of the decay: the thesis's approximation, or exact.
enum class DecayForm { printed, exact };

struct Damping {
  double kept = 1;            // b [-]
  double coulomb_length = 0;  // Q [m]
  double viscous = 0;         // c [N s/m]
  double ratio = 0;           // zeta_eq, of viscous and dry damping together [-]
};

// Returns [46]-[49], [52], [53] from two amplitudes and their decreases; `mass` [kg], `period` [s].
// The exact form computes zeta_eq as d/sqrt(4 pi^2 + d^2), d = ln(X/(X - d x)). Values that are
// impossible for a decay (b > 1, Q < 0) are returned unchanged. Throws std::invalid_argument if X1
// = X2.
Damping two_point(double x1, double dx1, double x2, double dx2, double mass, double period,
                  DecayForm form);

// Input of the two-point method, from the turns on the side of the first one: the first amplitude,
// and as the "later" one the last that is above a fifth of the first.
struct TwoPoints {
  double x1 = 0, dx1 = 0, x2 = 0, dx2 = 0;  // [m]
};
// Returns the two points; `rest` [m]. Throws Refusal if there are fewer than three turns on that
// side, or they do not decrease.
TwoPoints two_points(const Oscillation& oscillation, double rest, const std::string& subject);

// Least squares fit to all turns on both sides:
//
//   turn_k = center + bend A_k^2 +- A_k,   A_k+1 = s A_k - Q (1 + s)
//
// `bend` [1/m] is the shift of the center due to a nonlinear spring; omitted below seven turns.
struct DecayFit {
  Damping damping;
  Solution solution;  // center [m], amplitude [m], decrement -ln s [1], coulomb_length [m], bend
};
DecayFit decay_fit(const Oscillation& oscillation, double mass);

}  // namespace sinew::identify
