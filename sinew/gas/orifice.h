// gas/orifice.h - mass flow through an open valve, [42]-[44] and ISO 6358.
//
//   orifice    m' = A C_m P_up / sqrt(T)                                             [42]-[44]
//              choked, r_P <= b_crit    C_m = sqrt(g/R (2/(g+1))^((g+1)/(g-1)))
//              free                     C_m = sqrt(2g/(R(g-1)) (r_P^(2/g) - r_P^((g+1)/g)))
//   ISO 6358   m' = C rho_0 P_up sqrt(T_0/T) sqrt(1 - ((r_P - b_crit)/(1 - b_crit))^2)
//              choked for r_P <= b_crit, the standard's b
//
//   A    effective area A_p C_q [m2]     g  heat capacity ratio gamma, 1.4     C  sonic conductance
//   r_P  P_down/P_up [-]                 T  upstream [K]                          [m3/(s Pa)]
//
// Flow is from the higher to the lower port and is linear in P_a - P_b below a pressure
// difference of `linear_below` times the upstream pressure: the true slope at zero is infinite, and
// a chamber that settles at its supply would be arbitrarily stiff. The law is continuous there,
// with a kink (slope 1/2).
//
// The integrator's form has neither power nor division. With y = (P/P_atm)^(1/7), [44] for g = 1.4
// is
//
//   m' = C_y P_atm d^5 u sqrt(u^2 - d^2),   u = y_up, d = max(y_down, sqrt(5/6) u)
//
// and the maximum is the choking. y does not depend on the exponent of the chamber's air (air.h).
//
// Departures: C_m is exact, in SI. The thesis's R = 53.34 in [44] lacks g_c (wrong by 5.67 if taken
// as printed). Its code rounds to .0165 and .064, which jump by .38 % at the limit 1.89, and uses a
// factor of 83.66 instead of 83.62; Law::appendix_a reproduces these values. The upstream
// temperature is the constant `air.temperature`, also for flow out of a chamber, as in appendix A.
#pragma once

#include <cmath>
#include <type_traits>

#include "sinew/gas/air.h"
#include "sinew/gas/valve.h"
#include "sinew/units/constants.h"
#include "sinew/units/pack.h"

namespace sinew::gas {

// Reference air of ISO 6358, "ANR": 20 degC, 1 bar, 65 % humidity.
inline constexpr double iso_density = 1.185;       // rho_0 [kg/m^3]
inline constexpr double iso_temperature = 293.15;  // T_0 [K]

// Returns the pressure ratio at and below which the orifice is choked: 0.528282 for air [-].
constexpr double critical_pressure_ratio(double gamma = heat_capacity_ratio) {
  return units::power(2.0 / (gamma + 1.0), gamma / (gamma - 1.0));
}

// Returns C_m of the choked orifice, [44] upper line [sqrt(kg K/J)].
inline double choked_parameter(double gas_constant, double gamma = heat_capacity_ratio) {
  const double exponent = (gamma + 1.0) / (gamma - 1.0);
  return std::sqrt(gamma / gas_constant * units::power(2.0 / (gamma + 1.0), exponent));
}

// Returns C_m of the free orifice without the root of the pressure ratio, [44] lower line
// [sqrt(kg K/J)].
inline double free_parameter(double gas_constant, double gamma = heat_capacity_ratio) {
  return std::sqrt(2.0 * gamma / (gas_constant * (gamma - 1.0)));
}

// Constants of the orifice in appendix A's code: flow in in3/s of its standard air per C_m and psi,
// at the upstream temperature of 528 degR; density of that air; A_p C_q; P_up/P_down from which it
// is choked; C_m, choked and free, in sqrt(slug degR/(ft lbf)).
inline constexpr double appendix_factor = 83.66, appendix_density = 1.349e-6;  // [slug/in^3]
inline constexpr double appendix_area = 1.8e-5, appendix_limit = 1.89;         // [ft^2], [-]
inline constexpr double appendix_choked = 0.0165, appendix_free = 0.064;

// Returns m'/(A P_up) for one of these coefficients [s/m].
constexpr double appendix_gain(double coefficient) {
  return appendix_factor * coefficient * (appendix_density * units::slug / units::psi) /
         (appendix_area * (units::foot * units::foot));
}

// Returns the flow by Law::appendix_a for P_down <= P_up, without a linear part [kg/s].
inline double mass_flow_appendix_a(double effective_area, double upstream, double downstream) {
  const double scale = effective_area * upstream, ratio = downstream / upstream;
  if (upstream >= appendix_limit * downstream) return scale * appendix_gain(appendix_choked);
  return scale * appendix_gain(appendix_free) *
         std::sqrt(units::power(ratio, 2.0 / 1.4) - units::power(ratio, 2.4 / 1.4));
}

// Returns [42]-[44] as printed for P_down <= P_up and any gamma, without a linear part [kg/s].
inline double mass_flow(double effective_area, double upstream, double upstream_temperature,
                        double downstream, const Air& air, double gamma = heat_capacity_ratio) {
  const double ratio = downstream / upstream;
  const double scale = effective_area * upstream / std::sqrt(upstream_temperature);
  if (ratio <= critical_pressure_ratio(gamma)) {
    return scale * choked_parameter(air.gas_constant, gamma);
  }
  const double inside =
      units::power(ratio, 2.0 / gamma) - units::power(ratio, (gamma + 1.0) / gamma);
  return scale * free_parameter(air.gas_constant, gamma) * std::sqrt(inside > 0 ? inside : 0.0);
}

// Returns ISO 6358-1 for P_down <= P_up, without a linear part [kg/s].
inline double mass_flow_iso6358(double sonic_conductance, double critical_ratio, double upstream,
                                double upstream_temperature, double downstream) {
  const double above = downstream / upstream - critical_ratio;
  const double share = above > 0 ? above / (1.0 - critical_ratio) : 0.0;
  return sonic_conductance * iso_density * upstream *
         std::sqrt(iso_temperature / upstream_temperature) * std::sqrt(1.0 - share * share);
}

// Convert between effective area and the C with the same choked flow. The free parts differ: an
// orifice is nearest to b_crit = 0.528, a real valve's b_crit is 0.2 to 0.45.
inline double sonic_conductance_of(double effective_area, const Air& air) {
  return effective_area * choked_parameter(air.gas_constant) /
         (iso_density * std::sqrt(iso_temperature));  // [m^3/(s Pa)]
}
inline double effective_area_of(double sonic_conductance, const Air& air) {
  return sonic_conductance / sonic_conductance_of(1.0, air);  // [m^2]
}

// Returns P_down/P_up at and below which the flow is choked, by the valve's law [-].
constexpr double critical_ratio(const Flow& flow) {
  if (flow.law == Flow::Law::iso6358) return flow.critical_pressure_ratio;
  return flow.law == Flow::Law::appendix_a ? 1.0 / appendix_limit : critical_pressure_ratio();
}

// Returns whether the pressures are so close that the flow is in the linear part.
constexpr bool in_linear_part(const Flow& flow, double pressure_a, double pressure_b) {
  const double up = pressure_a > pressure_b ? pressure_a : pressure_b;
  const double down = pressure_a > pressure_b ? pressure_b : pressure_a;
  return up - down < flow.linear_below * up;
}

// Returns the flow between two ports by the valve's law, positive from a to b [kg/s]. It uses
// pressures and is the reference for flow_y.
inline double mass_flow(const Flow& flow, const Air& air, double pressure_a, double pressure_b) {
  const bool forward = pressure_a >= pressure_b;
  const double up = forward ? pressure_a : pressure_b;
  const double down = forward ? pressure_b : pressure_a;
  const auto law = [&](double lower) {
    if (flow.law == Flow::Law::iso6358)
      return mass_flow_iso6358(flow.sonic_conductance, flow.critical_pressure_ratio, up,
                               air.temperature, lower);
    if (flow.law == Flow::Law::appendix_a)
      return mass_flow_appendix_a(flow.area * flow.efficiency, up, lower);
    return mass_flow(flow.area * flow.efficiency, up, air.temperature, lower, air);
  };

  const double linear = flow.linear_below * up;
  const double size = up - down < linear ? law(up - linear) * ((up - down) / linear) : law(down);
  return forward ? size : -size;
}

// Return y = (P/P_atm)^(1/7) and its inverse [-], [Pa].
constexpr double y_of(const Air& air, double absolute_pressure) {
  return units::power(absolute_pressure / air.atmosphere, 1.0 / 7.0);
}
constexpr double pressure_of_y(const Air& air, double y) {
  const double y3 = y * y * y;
  return air.atmosphere * (y3 * y3 * y);
}

// A valve's law with all constants multiplied out. S is a double, or a pack of doubles
// (units/pack.h) over several machines.
template <class S>
struct FlowConstantsOf {
  S gain = 0;         // factor of the root [kg/s]
  S choked_gain = 0;  // factor if choked; differs only in appendix A [kg/s]
  S choke = 1;        // orifice: b_crit^(1/7) = sqrt(5/6); ISO: b_crit [-]
  S spread = 0;       // ISO: 1/(1 - b_crit) [-]
  S linear_gain = 0;  // factor of y_a^7 - y_b^7 [kg/s]
  S linear_from = 1;  // y_down/y_up above which the law is linear [-]
  S iso = 0;          // 1: ISO 6358 (a double, since a bool per lane prevents vectorisation)
};
using FlowConstants = FlowConstantsOf<double>;

// Returns `a` where the mask is set, else `b`.
template <class Mask, class S>
inline FlowConstantsOf<S> select(const Mask& mask, const FlowConstantsOf<S>& a,
                                 const FlowConstantsOf<S>& b) {
  return {units::select(mask, a.gain, b.gain),
          units::select(mask, a.choked_gain, b.choked_gain),
          units::select(mask, a.choke, b.choke),
          units::select(mask, a.spread, b.spread),
          units::select(mask, a.linear_gain, b.linear_gain),
          units::select(mask, a.linear_from, b.linear_from),
          units::select(mask, a.iso, b.iso)};
}

// Returns whether a part of the law has to be computed: always for a double, so that loops
// vectorise; for a pack, if a lane uses it.
constexpr bool needed(bool) { return true; }
template <int W>
[[gnu::always_inline]] inline bool needed(const units::PackMask<W>& mask) {
  return units::any(mask);
}

// Returns the flow from a to b, given y at both ports [kg/s]. Uses only + - x sqrt and selections,
// with one root, so that loops over lanes with constants in arrays vectorise, and every lane has
// the scalar's bits.
template <class S>
inline S flow_y(const FlowConstantsOf<S>& c, const std::type_identity_t<S>& y_a,
                const std::type_identity_t<S>& y_b) {
  const S up = units::select(y_a > y_b, y_a, y_b);
  const S down = units::select(y_a > y_b, y_b, y_a);
  const auto iso = c.iso > 0.0, near = down > c.linear_from * up;

  // Orifice: d^5 u sqrt(u^2 - d^2).
  const S up2 = up * up, limit = c.choke * up;
  const S d = units::select(down > limit, down, limit);
  const S d2 = d * d;
  S factor = d2 * d2 * d * up, inside = up2 - d2;

  S p_up = 0, p_down = 0;  // P/P_atm of both ports
  if (needed(iso | near)) {
    const S down2 = down * down;
    p_up = up2 * up2 * up2 * up;
    p_down = down2 * down2 * down2 * down;
  }

  // ISO 6358: sqrt(p_up^2 - ((p_down - b_crit p_up)/(1 - b_crit))^2), p = y^7.
  if (needed(iso)) {
    const S over = p_down - c.choke * p_up;
    const S share = units::select(over > 0.0, over, 0.0) * c.spread;
    factor = units::select(iso, 1.0, factor);
    inside = units::select(iso, p_up * p_up - share * share, inside);
  }

  const S gain = units::select(down > limit, c.gain, c.choked_gain);
  S size = gain * factor * units::sqrt(units::select(inside > 0.0, inside, 0.0));
  if (needed(near)) size = units::select(near, c.linear_gain * (p_up - p_down), size);
  return units::select(y_a >= y_b, size, -size);
}

// Returns the constants of a valve's flow for this air.
inline FlowConstants flow_constants(const Flow& flow, const Air& air) {
  FlowConstants c;
  c.iso = flow.law == Flow::Law::iso6358 ? 1 : 0;
  if (c.iso > 0) {
    c.gain = flow.sonic_conductance * iso_density * air.atmosphere *
             std::sqrt(iso_temperature / air.temperature);
    c.choke = flow.critical_pressure_ratio;
    c.spread = 1.0 / (1.0 - flow.critical_pressure_ratio);
  } else if (flow.law == Flow::Law::appendix_a) {
    const double scale = flow.area * flow.efficiency * air.atmosphere;
    c.gain = scale * appendix_gain(appendix_free);
    c.choke = units::power(1.0 / appendix_limit, 1.0 / 7.0);
    // When choked, the root keeps its value at the limit; with .064 that flow is not the one of
    // .0165.
    const double d2 = c.choke * c.choke;
    c.choked_gain =
        scale * appendix_gain(appendix_choked) / (d2 * d2 * c.choke * std::sqrt(1.0 - d2));
  } else {
    c.gain = flow.area * flow.efficiency * air.atmosphere * free_parameter(air.gas_constant) /
             std::sqrt(air.temperature);
    c.choke = std::sqrt(2.0 / (heat_capacity_ratio + 1.0));
  }
  if (flow.law != Flow::Law::appendix_a) c.choked_gain = c.gain;

  // The linear part passes through zero and through the law at linear_below.
  if (flow.linear_below > 0) {
    const double edge = units::power(1.0 - flow.linear_below, 1.0 / 7.0);
    FlowConstants bare = c;
    c.linear_gain = flow_y(bare, 1.0, edge) / flow.linear_below;
    c.linear_from = edge;
  }
  return c;
}

// Returns appendix A's law on one side of its jump, continued beyond it: the choked flow whatever
// the lower pressure, or the free flow also below the limit. The free flow is the larger one there,
// so a chamber that has passed the limit is not driven back.
inline FlowConstants on_one_side(FlowConstants c, bool choked) {
  if (choked) {
    const double d2 = c.choke * c.choke;
    c.gain = c.choked_gain *= d2 * d2 * c.choke * std::sqrt(1.0 - d2);
    c.iso = 1, c.choke = 1, c.spread = 0;  // the root is then y_up^7
  } else {
    c.choke = 0;
  }
  return c;
}

}  // namespace sinew::gas
