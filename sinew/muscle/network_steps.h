// muscle/network_steps.h - members of AirNetwork: how its state moves on.
#pragma once

#include "sinew/muscle/network.h"
#include "sinew/muscle/network_flows.h"

namespace sinew::muscle {

template <int Most>
Failure AirNetwork<Most>::remember(const Answer& look, const State& state,
                                   Memory& memory) const noexcept {
  const int failed = braids_.follow(look.drift, memory.reference);
  if (failed >= 0) return {.of = Failure::Of::air, .muscle = failed};
  if (plain_) return {};
  const double at_one = gas::density_at_atmosphere(air_);
  for (int i = 0; i < size_; ++i) {
    const Line& l = line(i);
    if (!is_pressure(look.pressure[i])) return {.of = Failure::Of::air, .muscle = i};
    if (l.plays) memory.play[i] = look.play[i];
    if (l.hose != none && l.hose_energy == none)
      gas::follow(braids_.series(), memory.hose[static_cast<std::size_t>(i)],
                  other(state, l.hose) / muscle(i).hose.volume, at_one);
  }
  for (const Side side : {up, down}) {
    if (!cylinder_) break;
    const double p = look.cylinder_pressure[side];
    if (!(p >= 0 && p < most_pressure)) return {.of = Failure::Of::cylinder};
    if (sides_[side].mass != none && sides_[side].energy == none)
      gas::follow(braids_.series(), memory.side[side], look.cylinder_density[side], at_one);
  }
  for (const int valve : lagging_) {
    const auto v = static_cast<std::size_t>(valve);
    gas::follow(of_pressure_, memory.outlet[v], other(state, taps_[v].outlet), air_.atmosphere);
  }
  if (tank_ != none) gas::follow(of_pressure_, memory.line, look.supply_pressure, air_.atmosphere);
  return {};
}

// Only the masses: what has passed is summed where the step ends.
template <int Most>
void AirNetwork<Most>::move(State& out, const State& from, double h, const Answer& look,
                            const Valves& valves) const noexcept {
  const bool flows = flowing(valves);
  for (int i = 0; i < braids_.padded(); i += lanes) {
    Four mass = from.mass.four(i);
    if (flows) mass += h * (look.inflow.four(i) - look.outflow.four(i));
    out.mass.four(i) = mass;
  }
  if (plain_ && !valves.broken) return;
  each_line(valves, [&](int i) { out.mass[i] = from.mass[i] + h * look.gain[i]; });
  for (std::size_t k = 0; k < static_cast<std::size_t>(others_); ++k)
    out.other[k] = from.other[k] + h * look.rate[k];
}

template <int Most>
void AirNetwork<Most>::finish(State& state, double h, const Answer* const (&look)[4],
                              const Valves& valves) const noexcept {
  const double sixth = h / 6.0;
  const auto mean = [&](auto&& of) {
    return sixth * (of(*look[0]) + 2.0 * of(*look[1]) + 2.0 * of(*look[2]) + of(*look[3]));
  };
  add(state, state, mean, valves);
}

template <int Most>
void AirNetwork<Most>::correct(State& out, const State& from, double h, const Answer& before,
                               const Answer& after, const Valves& valves) const noexcept {
  const double half = 0.5 * h;
  add(
      out, from, [&](auto&& of) { return half * (of(before) + of(after)); }, valves);
}

// Adds the mean of every rate: mean(of) is the step's length times the mean of of(look).
template <int Most>
template <class Mean>
void AirNetwork<Most>::add(State& out, const State& from, Mean mean,
                           const Valves& valves) const noexcept {
  const bool options = !plain_ || valves.broken;
  for (int i = 0; i < size_ && flowing(valves); ++i) {
    const double in = mean([&](const Answer& a) { return a.inflow[i]; });
    const double gone = mean([&](const Answer& a) { return a.outflow[i]; });
    out.in[i] = from.in[i] + in;
    out.out[i] = from.out[i] + gone;
    if (options && (line(i).more || valves.broken)) {
      out.mass[i] = from.mass[i] + mean([&](const Answer& a) { return a.gain[i]; });
      out.leak[i] = from.leak[i] + mean([&](const Answer& a) { return a.leak[i]; });
    } else {
      out.mass[i] = from.mass[i] + (in - gone);
    }
  }
  if (!options) return;
  for (std::size_t k = 0; k < static_cast<std::size_t>(others_); ++k)
    out.other[k] = from.other[k] + mean([&](const Answer& a) { return a.rate[k]; });
  for (std::size_t c = 0; c < 2 && cylinder_; ++c) {
    out.piston_in[c] =
        from.piston_in[c] + mean([&](const Answer& a) { return a.cylinder_inflow[c]; });
    out.piston_out[c] =
        from.piston_out[c] + mean([&](const Answer& a) { return a.cylinder_outflow[c]; });
  }
}

}  // namespace sinew::muscle
