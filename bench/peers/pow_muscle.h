// bench/peers/pow_muscle.h - straightforward implementation of a muscle between two valves: the
// laws in scalar double with the C library's pow, RK4 with a fixed step. Sinew is compared with it.
//
//   P = P_atm (m/(V rho_atm))^n                                            [40]
//   m' = A C_m P_up/sqrt(T), C_m by the ratio of pressures                 [42]-[44]
//   F = P_g b^2/(4 pi n^2) (3 L^2/b^2 - 1) Eff(P_g) + ends + bladder + c v [31]-[35]
//
// For a fair comparison, constants are precomputed, a closed valve costs nothing, and the tension
// is computed only on request, not in every stage.
#pragma once

#include "sinew/air/muscle.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"

namespace sinew::bench {

class PowMuscle {
 public:
  // For muscles with a plain braid between two orifices by [42]-[44].
  PowMuscle(const air::Muscle& muscle, const gas::Air& air, const gas::Supply& supply);

  void fill(double pressure, double length) noexcept;  // absolute [Pa], [m]

  // Advances by a step. Lengths at its beginning, middle and end [m]; open shares of the valves'
  // areas [-].
  struct Lengths {
    double begin, middle, end;
  };
  void step(double h, const Lengths& lengths, double inlet, double exhaust) noexcept;

  double pressure(double length) const noexcept { return pressure(mass_, length); }  // [Pa]

  // Returns the bundle's tension at this length, rate and pressure, and the bound of its dry
  // friction [N].
  struct Pull {
    double tension, friction_bound;
  };
  Pull pull(double length, double rate, double pressure) const noexcept;

 private:
  struct Orifice {
    double choked = 0, free = 0, linear = 0;  // times P_up, or the difference  [kg/(s Pa)]
    double linear_below = 0;                  // [-]
  };
  static Orifice orifice(const gas::Flow& flow, const gas::Air& air);
  static double flow(const Orifice& orifice, double from, double to) noexcept;  // [kg/s]
  double volume(double length) const noexcept;
  double pressure(double mass, double length) const noexcept;
  double gain(double mass, double length, double inlet, double exhaust) const noexcept;

  const air::Muscle muscle_;
  double atmosphere_, supply_, exponent_, density_;
  double factor_, shortest_;
  Orifice inlet_, exhaust_;
  double mass_ = 0;
};

}  // namespace sinew::bench
