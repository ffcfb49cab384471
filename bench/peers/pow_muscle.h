// bench/peers/pow_muscle.h - a muscle between two valves as one writes it down first: the laws in
// scalar double with the C library's pow, RK4 at a fixed step. What we are held against.
//
//   P = P_atm (m/(V rho_atm))^n                                            [40]
//   m' = A C_m P_up/sqrt(T), C_m by the ratio of pressures                 [42]-[44]
//   F = P_g b^2/(4 pi n^2) (3 L^2/b^2 - 1) Eff(P_g) + ends + bladder + c v [31]-[35]
//
// All that is constant is multiplied out beforehand, a shut valve costs nothing, and the tension is
// worked out where it is asked for and not in every stage: it is to be a good one of its kind.
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

  // Lengths at a step's beginning, middle and end [m]; open shares of the valves' areas [-].
  struct Lengths {
    double begin, middle, end;
  };
  void step(double h, const Lengths& lengths, double inlet, double exhaust) noexcept;

  double pressure(double length) const noexcept { return pressure(mass_, length); }  // [Pa]

  // The bundle's tension, by its length, its rate and its pressure, and the bound of its dry
  // friction  [N].
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
