// air/network_steps.h - members of AirNetwork: how its state moves on.
#pragma once

#include "sinew/air/network.h"
#include "sinew/air/network_flows.h"

namespace sinew::air {

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
                            const Valves& valves, const Course& course) const noexcept {
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

  const bool end = !(h < course.step);
  for (std::size_t k = 0; k < static_cast<std::size_t>(course.count); ++k) {
    const Cell& cell = course.cells[k];
    const double mass = end ? cell.full : cell.half;
    if (cell.of >= size_) {
      other(out, sides_[static_cast<std::size_t>(cell.of - size_)].mass) = mass;
      continue;
    }
    out.mass[cell.of] = mass;
    if (const int hose = line(cell.of).hose; hose != none) other(out, hose) = cell.hose;
  }
}

template <int Most>
void AirNetwork<Most>::finish(State& state, double h, const Answer* const (&look)[4],
                              const Valves& valves, const Course& course) const noexcept {
  const double sixth = h / 6.0;
  const auto mean = [&](auto&& of) {
    return sixth * (of(*look[0]) + 2.0 * of(*look[1]) + 2.0 * of(*look[2]) + of(*look[3]));
  };
  add(state, state, mean, valves, course);
}

template <int Most>
void AirNetwork<Most>::correct(State& out, const State& from, double h, const Answer& before,
                               const Answer& after, const Valves& valves,
                               const Course& course) const noexcept {
  const double half = 0.5 * h;
  add(
      out, from, [&](auto&& of) { return half * (of(before) + of(after)); }, valves, course);
}

// Adds the mean of every rate: mean(of) is the step's length times the mean of of(look). `out` may
// be `from`.
template <int Most>
template <class Mean>
void AirNetwork<Most>::add(State& out, const State& from, Mean mean, const Valves& valves,
                           const Course& course) const noexcept {
  const bool options = !plain_ || valves.broken;
  const int moved = flowing(valves) ? size_ : 0;
  for (int i = 0; i < moved; ++i) {
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
  if (course.count > 0) add_course(out, mean, course);
}

// Puts in the place of what the looks said of a body what its course says. The supply has given
// that, too.
template <int Most>
template <class Mean>
void AirNetwork<Most>::add_course(State& out, Mean mean, const Course& course) const noexcept {
  for (std::size_t k = 0; k < static_cast<std::size_t>(course.count); ++k) {
    const Cell& cell = course.cells[k];
    const bool muscle = cell.of < size_;
    const auto c = static_cast<std::size_t>(muscle ? 0 : cell.of - size_);
    const auto said = [&](auto&& of_muscle, auto&& of_cylinder) {
      return mean(
          [&](const Answer& a) { return muscle ? of_muscle(a)[cell.of] : of_cylinder(a)[c]; });
    };
    const double in =
        cell.in - said([](const Answer& a) -> const Lanes& { return a.inflow; },
                       [](const Answer& a) -> const auto& { return a.cylinder_inflow; });
    const double gone =
        cell.out - said([](const Answer& a) -> const Lanes& { return a.outflow; },
                        [](const Answer& a) -> const auto& { return a.cylinder_outflow; });
    (muscle ? out.in[cell.of] : out.piston_in[c]) += in;
    (muscle ? out.out[cell.of] : out.piston_out[c]) += gone;
    if (muscle) {
      out.leak[cell.of] += cell.leak - mean([&](const Answer& a) { return a.leak[cell.of]; });
      out.mass[cell.of] = cell.full;
      if (const int hose = line(cell.of).hose; hose != none) other(out, hose) = cell.hose;
    } else {
      other(out, sides_[c].mass) = cell.full;
    }
    if (tank_ == none) continue;
    // The rates of tank and of a cut line are those of all inlets: one of them is nothing.
    const bool cut = course.cut;
    other(out, cut ? cut_ : tank_) += cut ? in : -in;
  }
}

}  // namespace sinew::air
