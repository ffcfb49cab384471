// gas/slopes.h - the flows of orifice.h, hose.h and leak.h with their slopes, for implicit
// integration.
//
//   dm'/dy_a, dm'/dy_b   of the flow from a to b, y = (P/P_atm)^(1/7)
//
// The slopes are exact on each piece of a law; at a kink (choking, the linear part) the slope
// is that of one side.
#pragma once

#include "sinew/gas/hose.h"
#include "sinew/gas/leak.h"
#include "sinew/gas/orifice.h"

namespace sinew::gas {

// S is a double, or a pack of doubles (units/pack.h).
template <class S>
struct SlopedFlowOf {
  S flow = 0;            // positive from a to b [kg/s]
  S by_a = 0, by_b = 0;  // its slopes over y_a and y_b [kg/s]
};
using SlopedFlow = SlopedFlowOf<double>;

namespace slopes {

// Applies a law that requires the higher port first to ports in any order.
template <class Law>
SlopedFlow with_higher_port_first(double y_a, double y_b, const Law& law) {
  if (y_a >= y_b) return law(y_a, y_b);
  const SlopedFlow back = law(y_b, y_a);
  return {-back.flow, -back.by_b, -back.by_a};
}

// Returns y^7.
inline double seventh(double y) {
  const double y3 = y * y * y;
  return y3 * y3 * y;
}

// Returns the flow through a valve from the higher port `up` to the lower port `down`.
inline SlopedFlow forward_flow(const FlowConstants& c, double up, double down) {
  const double up6 = up * up * up * up * up * up, down6 = down * down * down * down * down * down;
  const double p_up = up6 * up, p_down = down6 * down;
  if (down > c.linear_from * up)
    return {c.linear_gain * (p_up - p_down), 7 * c.linear_gain * up6, -7 * c.linear_gain * down6};
  if (c.iso > 0) {
    const double over = p_down - c.choke * p_up, share = (over > 0 ? over : 0.0) * c.spread;
    const double root = std::sqrt(p_up * p_up - share * share);
    const double gain = over > 0 ? c.gain : c.choked_gain;
    if (!(root > 0)) return {};
    const double by_up = gain * (p_up + share * c.choke * c.spread) / root;
    const double by_down = -gain * share * c.spread / root;
    return {gain * root, by_up * 7 * up6, by_down * 7 * down6};
  }
  const double limit = c.choke * up;
  if (down <= limit) {
    const double flow = flow_y(c, up, down);
    return {flow, 7 * flow / up, 0.0};
  }
  const double inside = up * up - down * down, flow = flow_y(c, up, down);
  if (!(inside > 0)) return {};  // without a linear part the law is infinitely steep there
  return {flow, flow * (1 / up + up / inside), flow * (5 / down - down / inside)};
}

// Returns the flow through a pipe from the higher port `up` to the lower port `down`.
inline SlopedFlow forward_pipe_flow(const HoseConstants& c, double up, double down) {
  const double p_up = seventh(up), p_down = seventh(down);
  const double squares = (p_up - p_down) * (p_up + p_down);
  const double of_up = 7 * p_up / up, of_down = 7 * p_down / down;  // dP/dy [-]
  if (!(squares > 0)) return {0.0, c.laminar * 2 * p_up * of_up, -c.laminar * 2 * p_down * of_down};
  const double ratio = c.crossover * units::power(squares, 3.0 / 7.0);
  const double ratio2 = ratio * ratio, ratio4 = ratio2 * ratio2, ratio8 = ratio4 * ratio4;
  const double blend = std::sqrt(std::sqrt(std::sqrt(1.0 + ratio8)));
  const double free = c.laminar * squares / blend, most = c.choked * p_up;
  if (free >= most) return {most, c.choked * of_up, 0.0};
  const double slope = c.laminar / blend * (1.0 - 3.0 / 7.0 * ratio8 / (1.0 + ratio8));
  return {free, slope * 2 * p_up * of_up, -slope * 2 * p_down * of_down};
}

}  // namespace slopes

// Returns flow_y with its slopes.
inline SlopedFlow sloped_flow_y(const FlowConstants& c, double y_a, double y_b) {
  return slopes::with_higher_port_first(
      y_a, y_b, [&](double up, double down) { return slopes::forward_flow(c, up, down); });
}

// Returns flow_y with its slopes for lanes. Branches that no lane needs are skipped.
template <class S>
[[gnu::always_inline]] inline SlopedFlowOf<S> sloped_flow_side_by_side(const FlowConstantsOf<S>& c,
                                                                       const S& y_a, const S& y_b) {
  const auto forward = y_a >= y_b, iso = c.iso > 0.0;
  const S up = units::select(forward, y_a, y_b), down = units::select(forward, y_b, y_a);
  const S up2 = up * up, down2 = down * down;
  const S up6 = up2 * up2 * up2, down6 = down2 * down2 * down2;
  const S p_up = up6 * up, p_down = down6 * down;
  S flow = c.linear_gain * (p_up - p_down);
  S by_up = (7.0 * c.linear_gain) * up6, by_down = (-7.0 * c.linear_gain) * down6;
  const auto by_law = !(down > c.linear_from * up);
  if (const auto of_iso = by_law & iso; units::any(of_iso)) {
    const S over = p_down - c.choke * p_up, share = units::max(over, 0.0) * c.spread;
    const S inside = p_up * p_up - share * share;
    const S root = units::sqrt(units::max(inside, 0.0));
    const S gain = units::select(over > 0.0, c.gain, c.choked_gain);
    const S steep = units::select(root > 0.0, 7.0 * gain / root, 0.0);
    flow = units::select(of_iso, gain * root, flow);
    by_up = units::select(of_iso, steep * (p_up + share * c.choke * c.spread) * up6, by_up);
    by_down = units::select(of_iso, -steep * share * c.spread * down6, by_down);
  }
  if (const auto of_orifice = by_law & !iso; units::any(of_orifice)) {
    const S limit = c.choke * up, d = units::max(limit, down), d2 = d * d;
    const auto free = down > limit;
    const S inside = up2 - d2, root = units::sqrt(units::max(inside, 0.0));
    const S one = units::select(free, c.gain, c.choked_gain) * (d2 * d2 * d * up) * root;
    const S less = units::select(free & (inside > 0.0), one / inside, 0.0);
    flow = units::select(of_orifice, one, flow);
    const S scaled = one / up;
    by_up = units::select(of_orifice, units::select(free, scaled + less * up, 7.0 * scaled), by_up);
    by_down = units::select(of_orifice, units::select(free, 5.0 * one / down - less * down, 0.0),
                            by_down);
  }
  return {units::select(forward, flow, -flow), units::select(forward, by_up, -by_down),
          units::select(forward, by_down, -by_up)};
}

// Returns hose_flow_y with its slopes.
inline SlopedFlow sloped_hose_flow_y(const HoseConstants& c, double y_a, double y_b) {
  if (!c.pipe) return sloped_flow_y(c.iso, y_a, y_b);
  return slopes::with_higher_port_first(
      y_a, y_b, [&](double up, double down) { return slopes::forward_pipe_flow(c, up, down); });
}

// Returns leak_flow_y with its slopes.
inline SlopedFlow sloped_leak_flow_y(const LeakConstants& c, double y_a, double y_b) {
  SlopedFlow f = c.hole.gain > 0 ? sloped_flow_y(c.hole, y_a, y_b) : SlopedFlow{};
  const double p_a = slopes::seventh(y_a), p_b = slopes::seventh(y_b);
  f.flow += c.slope * (p_a - p_b);
  f.by_a += 7 * c.slope * p_a / y_a;
  f.by_b -= 7 * c.slope * p_b / y_b;
  return f;
}

}  // namespace sinew::gas
