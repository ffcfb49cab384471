#include "sinew/air/regulator_lanes.h"

#include "sinew/air/stiff/quick.h"
#include "sinew/gas/slopes.h"
#include "sinew/units/wide.h"

namespace sinew::air {
namespace {

using S = units::Pack<lanes>;
using Mask = units::PackMask<lanes>;

[[gnu::always_inline]] inline S load(const double* lane) {
  return S(reinterpret_cast<const Four&>(*lane));
}
[[gnu::always_inline]] inline void store(double* lane, const S& x) {
  reinterpret_cast<Four&>(*lane) = x.lanes;
}

// Returns y by a series about a base; clears `near` in lanes outside its range.
[[gnu::always_inline]] inline S root(const gas::PowerSeries& series, const S& base, const S& x,
                                     Mask& near) {
  near = near & (x < gas::PowerSeries::reach) & (x > -gas::PowerSeries::reach);
  S power;
  series.raise(x, power);
  return base * power;
}

// Returns e^-x of a lag for a small part of its time; clears `near` in other lanes.
[[gnu::always_inline]] inline S decay(const S& x, Mask& near) {
  near = near & (x < quick::short_lag);
  return 1.0 - x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0)))));
}

}  // namespace

RegulatorLanes::RegulatorLanes(const BraidLanes& braids, std::span<const gas::Valve> valves,
                               const gas::Air& air)
    : of_density_(braids.series()), constants_(static_cast<std::size_t>(braids.padded() / lanes)) {
  for (int i = 0; i < braids.padded(); i += lanes) {
    Constants& k = constants_[static_cast<std::size_t>(i / lanes)];
    std::array<BraidConstants<double>, lanes> braid;
    std::array<gas::FlowConstants, lanes> flow;
    for (int at = 0; at < lanes; ++at) {
      const int of = i + at < braids.size() ? i + at : braids.size() - 1;
      const gas::Valve& valve = valves[static_cast<std::size_t>(of)];
      const double lag = valve.regulator.time_constant;
      braid[static_cast<std::size_t>(at)] = braids.constants(of);
      flow[static_cast<std::size_t>(at)] = gas::flow_constants(valve.flow, air);
      k.inverse_lag.set(at, lag > 0 ? 1.0 / lag : 0.0);
    }
    k.braid = units::side_by_side<BraidConstants<S>>(braid);
    k.flow = units::side_by_side<gas::FlowConstantsOf<S>>(flow);
  }
}

SINEW_WIDE void RegulatorLanes::integrate(int first, double h, double y_supply, const Inputs& in,
                                          Outputs& out) const noexcept {
  const Constants& k = constants_[static_cast<std::size_t>(first / lanes)];
  const gas::PowerSeries of_pressure(1.0 / 7.0);
  const double n7 = of_density_.exponent(), inverse_h = 1.0 / h;
  const S start = load(in.mass), base = load(in.y_ref), inverse = load(in.inverse_sigma);
  Mask good = start > 0.0;

  // Volumes and outlets at both ends of the step.
  const S length = load(in.length);
  const S volume = braid_volume(k.braid, length);
  const S slope = k.braid.linear - 3.0 * (k.braid.cubic * (length * length));
  const S grows = units::select(volume > k.braid.external, slope * load(in.rate), 0.0);
  const S by_volume[2] = {inverse / volume, inverse / (volume + h * grows)};
  const S set = load(in.set), off = load(in.off);
  const S outlet_base = load(in.outlet_y), outlet_inverse = load(in.outlet_inverse);
  const S supply = y_supply, at_node = set + off;
  const S later = set + off * decay(h * k.inverse_lag, good);
  S outlet[2] = {root(of_pressure, outlet_base, at_node * outlet_inverse - 1.0, good),
                 root(of_pressure, outlet_base, later * outlet_inverse - 1.0, good)};
  const S follows = -off * k.inverse_lag * outlet[0] / (7.0 * at_node);
  const S outlet_rate = units::select(outlet[0] > supply, 0.0, follows);
  for (S& y : outlet) y = units::min(y, supply);

  // One step of RODAS3.
  const S y = root(of_density_, base, start * by_volume[0] - 1.0, good);
  const gas::SlopedFlowOf<S> f = gas::sloped_flow_side_by_side(k.flow, outlet[0], y);
  const S by_mass = f.by_b * (n7 * y / start);
  const S by_time = f.by_a * outlet_rate - f.by_b * (n7 * y * grows / volume);
  const auto rate_at_end = [&](const S& mass) __attribute__((always_inline)) {
    return gas::sloped_flow_side_by_side(k.flow, outlet[1],
                                         root(of_density_, base, mass * by_volume[1] - 1.0, good))
        .flow;
  };
  const S solve = 1.0 / (2.0 * inverse_h - by_mass);
  const S k0 = solve * (f.flow + (0.5 * h) * by_time);
  const S k1 = solve * (f.flow + (1.5 * h) * by_time + (4.0 * inverse_h) * k0);
  const S there = start + 2.0 * k0;
  const S third = rate_at_end(there);
  const S k2 = solve * (third + inverse_h * (k0 - k1));
  const S there_too = there + k2;
  const S last = rate_at_end(there_too);
  const S k3 = solve * (last + inverse_h * (k0 - k1 - (8.0 / 3.0) * k2));
  const S full = there_too + k3, curvature = (0.125 * h) * (f.flow - last);

  // Mass that came in; the mass that left follows from the gain.
  const S gain = full - start;
  const Mask gives = f.flow > 0.0;
  const S in_by_mass = units::select(gives, by_mass, 0.0);
  const S in_by_time = units::select(gives, by_time, 0.0);
  const S in1 = units::max(f.flow, 0.0), in3 = units::max(third, 0.0), in4 = units::max(last, 0.0);
  const S q0 = (0.5 * h) * (in1 + (0.5 * h) * in_by_time + in_by_mass * k0);
  const S q1 =
      (0.5 * h) * (in1 + (1.5 * h) * in_by_time + (4.0 * inverse_h) * q0 + in_by_mass * k1);
  const S q2 = (0.5 * h) * (in3 + inverse_h * (q0 - q1) + in_by_mass * k2);
  const S q3 = (0.5 * h) * (in4 + inverse_h * (q0 - q1 - (8.0 / 3.0) * q2) + in_by_mass * k3);
  const Mask always = gives & (third > 0.0) & (last > 0.0);
  const Mask closed_for_good = !(gives | (third > 0.0) | (last > 0.0));
  const S came =
      units::select(always, gain, units::select(closed_for_good, 0.0, 2.0 * q0 + q2 + q3));

  store(out.half, 0.5 * (start + full) + curvature);
  store(out.full, full);
  store(out.in, came);
  store(out.out, came - gain);
  good = good & (units::abs(curvature) < quick::calm_curvature * start) &
         (units::abs(k3) < quick::muscle_error * start);
  out.calm = 0;
  for (int lane = 0; lane < lanes; ++lane)
    out.calm |= good[lane] ? std::uint64_t{1} << lane : std::uint64_t{0};
}

}  // namespace sinew::air
