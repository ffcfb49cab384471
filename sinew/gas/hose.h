// gas/hose.h - flow through a hose in series with a muscle's valves, and the pressure between two
// restrictions in series. 3.4 attributes the efficiency of 85 % and the missing damping to the
// hoses.
//
//   iso6358   C, b_crit as for a valve: the data that makers give for a hose with its fittings
//   pipe      length L_h, inner diameter D_h, isothermal:
//               laminar    m_l = pi D_h^4 (P_a^2 - P_b^2)/(256 mu_air L_h R T) (Hagen-Poiseuille)
//               turbulent  P_a^2 - P_b^2 = f_D L_h R T m_t^2/(D_h A^2),  f_D = 0.3164/Re^(1/4)
//                          (Blasius)
//               m = m_l m_t/(m_l^8 + m_t^8)^(1/8)      smooth, the lesser of the two far from Re
//               1187 and no more than the choked flow of its area
//
//   mu_air  viscosity [Pa s]    A = pi D_h^2/4 [m^2]    Re = m D_h/(A mu_air)
//
// Blasius holds for smooth walls up to Re 1e5. Real pipes stay laminar up to Re 2300: in between
// the law is up to a quarter low. Entry, bends and the change of momentum are neglected (speeds
// below about 100 m/s). Flow is positive from a to b.
#pragma once

#include <cmath>
#include <numbers>

#include "sinew/gas/orifice.h"

namespace sinew::gas {

struct Hose {
  // Names the law: no hose; a conductance as for a valve; a pipe by length and diameter.
  enum class Law { none, iso6358, pipe };
  Law law = Law::none;

  double sonic_conductance = 0;        // iso6358: C [m^3/(s Pa)]
  double critical_pressure_ratio = 0;  // iso6358: b_crit [-]

  double length = 0;          // pipe: L [m]
  double inner_diameter = 0;  // pipe: D [m]

  double volume = 0;  // volume as a chamber of its own behind the valves; 0: no chamber [m^3]
};

inline constexpr double viscosity_of_air = 1.82e-5;  // at 293 K, Sutherland [Pa s]

// Returns Re at which m_l = m_t: (64/0.3164)^(4/3) [-].
inline double blasius_crossing() { return units::power(64.0 / 0.3164, 4.0 / 3.0); }

// Returns m_l per P_a^2 - P_b^2 [kg/(s Pa^2)].
inline double laminar_conductance(const Hose& hose, const Air& air) {
  const double d2 = hose.inner_diameter * hose.inner_diameter;
  return std::numbers::pi * d2 * d2 /
         (256.0 * viscosity_of_air * hose.length * air.gas_constant * air.temperature);
}

// Returns the factor k in m_t = k (P_a^2 - P_b^2)^(4/7).
inline double turbulent_conductance(const Hose& hose, const Air& air) {
  const double d = hose.inner_diameter, area = 0.25 * std::numbers::pi * d * d;
  const double friction = 0.3164 * units::power(area * viscosity_of_air / d, 0.25);
  return units::power(
      d * area * area / (friction * hose.length * air.gas_constant * air.temperature), 4.0 / 7.0);
}

// A hose's law with all constants multiplied out, for pressures in atmospheres.
struct HoseConstants {
  bool pipe = false;
  FlowConstants iso;
  double laminar = 0;    // [kg/s]
  double crossover = 0;  // m_l/m_t at a squared difference of one [-]
  double choked = 0;     // per upstream atmosphere [kg/s]
};

// Returns the hose's constants for this air.
inline HoseConstants hose_constants(const Hose& hose, const Air& air) {
  HoseConstants c;
  c.pipe = hose.law == Hose::Law::pipe;
  if (c.pipe) {
    const double square = air.atmosphere * air.atmosphere;
    const double area = 0.25 * std::numbers::pi * hose.inner_diameter * hose.inner_diameter;
    c.laminar = laminar_conductance(hose, air) * square;
    c.crossover = c.laminar / (turbulent_conductance(hose, air) * units::power(square, 4.0 / 7.0));
    c.choked =
        area * choked_parameter(air.gas_constant) * air.atmosphere / std::sqrt(air.temperature);
  } else {
    c.iso = flow_constants({.law = Flow::Law::iso6358,
                            .sonic_conductance = hose.sonic_conductance,
                            .critical_pressure_ratio = hose.critical_pressure_ratio},
                           air);
  }
  return c;
}

// Returns the flow from a to b, given y at both ends [kg/s].
inline double hose_flow_y(const HoseConstants& c, double y_a, double y_b) {
  if (!c.pipe) return flow_y(c.iso, y_a, y_b);
  const double up = y_a > y_b ? y_a : y_b, down = y_a > y_b ? y_b : y_a;
  const double up3 = up * up * up, down3 = down * down * down;
  const double p_up = up3 * up3 * up, p_down = down3 * down3 * down;
  const double squares = (p_up - p_down) * (p_up + p_down);
  if (!(squares > 0)) return 0.0;

  // m_l/(1 + (m_l/m_t)^8)^(1/8); the ratio is proportional to squares^(3/7).
  const double ratio = c.crossover * units::power(squares, 3.0 / 7.0);
  const double ratio2 = ratio * ratio, ratio4 = ratio2 * ratio2;
  const double blend = std::sqrt(std::sqrt(std::sqrt(1.0 + ratio4 * ratio4)));
  const double free = c.laminar * squares / blend, most = c.choked * p_up;
  const double size = free < most ? free : most;
  return y_a > y_b ? size : -size;
}

// Pressure between restrictions with no air volume between them.
//
// The node's balance is sum of inflows(y) = 0. Every restriction's flow into the node falls as the
// node's y rises, so there is one root, between the lowest and the highest of the outer pressures.

// Returns y where the falling function `surplus` is zero; requires surplus(low) >= 0 >=
// surplus(high). Uses the false position method with Illinois halving; stops at a zero or when two
// neighbouring numbers enclose it.
template <class Function>
double balance(const Function& surplus, double low, double high) noexcept {
  double f_low = surplus(low), f_high = surplus(high);
  if (!(f_low > 0)) return low;
  if (!(f_high < 0)) return high;
  int side = 0;
  for (int k = 0; k < 200 && high - low > 4e-16 * high; ++k) {
    // Every fourth guess bisects, which bounds the number of iterations for any function.
    double y = k % 4 == 3 ? 0.5 * (low + high) : low + (high - low) * (f_low / (f_low - f_high));
    if (!(y > low && y < high)) y = 0.5 * (low + high);
    const double f = surplus(y);
    if (f == 0) return y;
    if (f > 0) {
      low = y;
      f_low = f;
      if (side == 1) f_high *= 0.5;
      side = 1;
    } else {
      high = y;
      f_high = f;
      if (side == -1) f_low *= 0.5;
      side = -1;
    }
  }
  return 0.5 * (low + high);
}

}  // namespace sinew::gas
