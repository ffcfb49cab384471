// air/network_setup.h - members of AirNetwork: what its state holds, how it starts, and how fast
// it can be.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/air/network.h"
#include "sinew/gas/heat.h"

namespace sinew::air {

inline constexpr double never = std::numeric_limits<double>::infinity();

// Step times rate of a decay that RK4 can bear: 2.78 at the limit.
inline constexpr double stable = 2.5;

namespace quick {
inline constexpr double from_rate = 2.5;  // rate times step from which a body of air goes ahead
}

// Is the valve a regulator, which follows a set point?
inline bool regulates(const gas::Valve& valve) { return valve.kind == gas::Valve::Kind::regulator; }

template <int Most>
AirNetwork<Most>::AirNetwork(std::span<const Muscle> muscles, const gas::Air& air,
                             const gas::Supply& supply, const std::optional<Cylinder>& cylinder,
                             std::span<const AirFault> faults)
    : size_(static_cast<int>(muscles.size())),
      air_(air),
      supply_(supply),
      supply_y_(gas::y_of(air, supply.pressure)),
      muscles_(muscles.begin(), muscles.end()),
      braids_(muscles, air),
      in_lanes_(!(air.wall_time > 0) && std::ranges::all_of(muscles, lanes_hold)),
      cylinder_(cylinder),
      faults_(faults) {
  if (size_ > Most) throw std::invalid_argument("more muscles than the network is compiled for");
  for (const Muscle& m : muscles_) add_muscle(m);
  for (Line& l : lines_) {
    const auto i = static_cast<std::size_t>(&l - lines_.data());
    if (air_.wall_time > 0) held_.push_back(l.energy = others_++);
    if (!l.resists || !(muscles_[i].hose.volume > 0)) continue;
    held_.push_back(l.hose = others_++);
    if (air_.wall_time > 0) held_.push_back(l.hose_energy = others_++);
  }
  if (cylinder_) add_cylinder();
  for (Tap& tap : taps_)
    if (regulates(tap.valve) && tap.valve.regulator.time_constant > 0) {
      lagging_.push_back(static_cast<int>(&tap - taps_.data()));
      tap.outlet = others_++;
    }
  if (supply_.kind == gas::Supply::Kind::tank) tank_ = others_++;
  for (int i = 0; i < size_; ++i) add_memory(i);
  add_faults();
  classify();
  limit_step();
}

template <int Most>
void AirNetwork<Most>::add_tap(const gas::Valve& valve) {
  taps_.push_back({.valve = valve, .flow = gas::flow_constants(valve.flow, air_)});
}

// A 3-way valve and a regulator serve both ways; no other valve stands beside them.
template <int Most>
void AirNetwork<Most>::add_muscle(const Muscle& m) {
  add_tap(m.inlet);
  add_tap(m.inlet.kind == gas::Valve::Kind::two_way ? m.exhaust : m.inlet);
  if (regulates(m.inlet)) taps_.back() = {};

  Line line;
  line.resists = m.hose.law != gas::Hose::Law::none;
  line.hose_flow = gas::hose_constants(m.hose, air_);
  line.leak = gas::leak_constants(m.leak, air_);
  line.more = line.resists || !line.leak.tight() || regulates(m.inlet) || air_.wall_time > 0;
  lines_.push_back(line);
}

// Makes room for what the mesh of muscle i remembers.
template <int Most>
void AirNetwork<Most>::add_memory(int i) {
  const actuator::Actuator& a = muscle(i).actuator;
  Line& l = lines_[static_cast<std::size_t>(i)];
  l.plays = actuator::has_hysteresis(a.hysteresis);
  for (std::size_t k = 0; k < l.late.size(); ++k)
    if (a.creep.share[k] != 0) l.late[k] = others_++;
}

template <int Most>
void AirNetwork<Most>::add_cylinder() {
  for (const Side side : {up, down}) {
    add_tap(cylinder_->inlet[side]);
    add_tap(cylinder_->exhaust[side]);
    const bool open = cylinder_->mode == Cylinder::Mode::single_acting && side == down;
    if (cylinder_->mode == Cylinder::Mode::regulator || open) continue;
    if (!(cylinder_->dead_volume[side] > 0))
      throw std::invalid_argument("a cylinder's chambers need a dead volume");
    Slot& slot = sides_[side];
    slot.mass = others_++;
    if (air_.wall_time > 0) slot.energy = others_++;
    if (cylinder_->mode != Cylinder::Mode::single_acting) continue;
    held_.push_back(slot.mass);
    if (slot.energy != none) held_.push_back(slot.energy);
  }
}

// Finds what flows, warms or creeps although every valve is shut, and the lines with more than
// valves.
template <int Most>
void AirNetwork<Most>::classify() {
  restless_ = air_.wall_time > 0 || (cylinder_ && cylinder_->mode == Cylinder::Mode::regulator);
  plain_ = !cylinder_ && tank_ == none && in_lanes_;
  for (int i = 0; i < size_; ++i) {
    const Line& l = line(i);
    const auto inlet = static_cast<std::size_t>(2 * i);
    restless_ = restless_ || !l.leak.tight() || l.hose != none || regulates(taps_[inlet].valve);
    restless_ = restless_ || actuator::has_creep(muscle(i).actuator.creep);
    plain_ = plain_ && !l.more;
    if (l.more) more_.push_back(i);
    if (l.hose != none && l.energy == none) behind_hoses_ |= std::uint64_t{1} << i;
    taps_[inlet].listed = taps_[inlet + 1].listed = !l.more;
    if (in_lanes_ && regulates(taps_[inlet].valve) && !l.resists && l.leak.tight())
      beside_ |= std::uint64_t{1} << i;
  }
  if (beside_ != 0) {
    std::vector<gas::Valve> inlets;
    for (const Muscle& m : muscles_) inlets.push_back(m.inlet);
    regulators_ = RegulatorLanes(braids_, inlets, air_);
  }
  for (const Tap& tap : taps_)
    ramping_ = ramping_ || tap.valve.profile == gas::Valve::Profile::ramp;
}

template <int Most>
double AirNetwork<Most>::volume(int i, double length) const noexcept {
  const Muscle& m = muscle(i);
  return m.count * actuator::volume(m.actuator, length) + m.external_volume;
}

// Returns the slope of the flow through a pair of valves, at nearly equal pressures  [kg/(s Pa)].
template <int Most>
double AirNetwork<Most>::fastest_slope(int inlet) const {
  const auto v = static_cast<std::size_t>(inlet);
  return (taps_[v].flow.linear_gain + taps_[v + 1].flow.linear_gain) / air_.atmosphere;
}

// Returns the slope of the flow through a hose  [kg/(s Pa)].
template <int Most>
double AirNetwork<Most>::hose_slope(const Line& line) const {
  const double p = supply_.pressure, y = gas::y_of(air_, p), y_less = gas::y_of(air_, 0.999 * p);
  return gas::hose_flow_y(line.hose_flow, y, y_less) / (1e-3 * p);
}

// A chamber of volume V whose flow has the slope G decays at n R T G/V.
template <int Most>
void AirNetwork<Most>::limit_step() {
  double rate = air_.wall_time > 0 ? 1.0 / air_.wall_time : 0.0;
  const auto faster = [&](double one) { rate = one > rate ? one : rate; };
  for (const int v : lagging_)
    faster(1.0 / taps_[static_cast<std::size_t>(v)].valve.regulator.time_constant);
  for (const Muscle& m : muscles_)
    for (std::size_t k = 0; k < m.actuator.creep.share.size(); ++k)
      if (m.actuator.creep.share[k] != 0) faster(1.0 / m.actuator.creep.time[k]);
  lag_rate_ = rate;
  const double exponent = air_.wall_time > 0 ? gas::heat_capacity_ratio : air_.polytropic_exponent;
  spring_ = exponent * air_.gas_constant * air_.temperature;
  for (int i = 0; i < size_; ++i) {
    Line& l = lines_[static_cast<std::size_t>(i)];
    double slope = (l.leak.hole.linear_gain + l.leak.slope) / air_.atmosphere;
    if (l.hose != none)
      slope += hose_slope(l);
    else if (regulates(taps_[static_cast<std::size_t>(2 * i)].valve))
      slope += fastest_slope(2 * i);
    l.settling = spring_ * slope;
    settles_ = settles_ || l.settling > 0;
    if (always_quick(i)) behind_regulators_ |= std::uint64_t{1} << i;
    if (l.hose != none)
      faster(spring_ * (fastest_slope(2 * i) + hose_slope(l)) / muscle(i).hose.volume);
  }
  for (const Side side : {up, down})
    if (sides_[side].mass != none)
      side_settling_[side] = spring_ * fastest_slope(2 * (size_ + side));
  longest_step_ = rate > 0 ? stable / rate : never;
}

// Is muscle i, behind a regulator alone, quick for a step of a millisecond even where it holds most
// air?
template <int Most>
bool AirNetwork<Most>::always_quick(int i) const {
  const bool regulated = regulates(taps_[static_cast<std::size_t>(2 * i)].valve);
  if (!regulated || line(i).resists || air_.wall_time > 0) return false;
  const double most = volume(i, actuator::shortest_length(muscle(i).actuator));
  return line(i).settling * 1e-3 > quick::from_rate * most;
}

// With the piston at the end of its stroke a chamber is the dead volume alone.
template <int Most>
double AirNetwork<Most>::longest_step() const noexcept {
  double fastest = stable / longest_step_;
  for (const Side side : {up, down})
    if (sides_[side].mass != none)
      fastest = std::max(fastest, side_settling_[side] / cylinder_->dead_volume[side]);
  return fastest > 0 ? stable / fastest : never;
}

// Rates of a hose's chamber and of the muscle behind it add up, at most. A cylinder's chamber with
// its valves shut has none. A fault that leaks may leak from either chamber of a muscle.
template <int Most>
double AirNetwork<Most>::longest_step(const Ends& ends, const Valves& valves) const noexcept {
  if (plain_ && !valves.leaking) return never;
  double fastest = 0;
  for (int i = 0; i < size_ && (settles_ || valves.leaking); ++i) {
    double one = line(i).settling / volume(i, ends.length[i]);
    if (valves.leaking) {
      const double broken = spring_ * slope_of_faults(i, valves.faults);
      one += broken / volume(i, ends.length[i]);
      if (line(i).hose != none) one += broken / muscle(i).hose.volume;
    }
    fastest = std::max(fastest, one);
  }
  fastest += stable / longest_step_;
  for (const Side side : {up, down}) {
    if (sides_[side].mass == none) continue;
    const auto inlet = static_cast<std::size_t>(2 * (size_ + side));
    const bool open = ramping_ || valves[inlet].share > 0 || valves[inlet + 1].share > 0;
    const double broken =
        valves.leaking ? spring_ * slope_of_faults(size_ + side, valves.faults) : 0.0;
    if (!open && !(broken > 0)) continue;
    fastest = std::max(
        fastest, (side_settling_[side] + broken) / air::volume(*cylinder_, side, ends.travel));
  }
  return fastest > 0 ? stable / fastest : never;
}

template <int Most>
double AirNetwork<Most>::longest_step_of_rest(const Ends& ends,
                                              const Valves& valves) const noexcept {
  if (air_.wall_time > 0) return longest_step(ends, valves);
  double fastest = lag_rate_;
  for (int i = 0; i < size_ && (settles_ || valves.leaking); ++i) {
    const bool held_back = line(i).hose == none && (line(i).resists || blocked(i, valves));
    if (!held_back) continue;
    const double slope = line(i).settling + spring_ * slope_of_faults(i, valves.faults);
    fastest = std::max(fastest, slope / volume(i, ends.length[i]));
  }
  return fastest > 0 ? stable / fastest : never;
}

template <int Most>
double AirNetwork<Most>::longest_step_of_piston(const Ends& ends, const Answer& look,
                                                double lift_per_force) const noexcept {
  double longest = never;
  for (const Side side : {up, down}) {
    if (sides_[side].mass == none) continue;
    const double room = air::volume(*cylinder_, side, ends.travel), face = area(*cylinder_, side);
    const double spring =
        gas::heat_capacity_ratio * look.cylinder_pressure[side] * face * face / room;
    longest = std::min(longest, 0.5 / std::sqrt(spring * lift_per_force));
    longest = std::min(longest, 0.125 * room / (face * std::abs(ends.travel_rate)));
  }
  return longest;
}

// Returns the density of air at rest, by the chamber's law  [kg/m^3].
template <int Most>
double AirNetwork<Most>::density(double pressure) const noexcept {
  return air_.wall_time > 0 ? pressure / (air_.gas_constant * air_.temperature)
                            : gas::density(air_, pressure);
}

template <int Most>
void AirNetwork<Most>::fill(const Slot& slot, double mass, State& state) const noexcept {
  other(state, slot.mass) = mass;
  if (slot.energy != none) other(state, slot.energy) = gas::energy_at_rest(air_, mass);
}

template <int Most>
void AirNetwork<Most>::hold(double pressure, const Lanes& length, double travel,
                            State& state) const noexcept {
  const double rho = density(pressure);
  for (int i = 0; i < size_; ++i) {
    const Line& l = line(i);
    state.mass[i] = rho * volume(i, length[i]);
    if (l.energy != none) other(state, l.energy) = gas::energy_at_rest(air_, state.mass[i]);
    if (l.hose != none) fill({l.hose, l.hose_energy}, rho * muscle(i).hose.volume, state);
  }
  for (int i = size_; i < braids_.padded(); ++i) state.mass[i] = state.mass[size_ - 1];
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::single_acting)
    fill(sides_[up], rho * air::volume(*cylinder_, up, travel), state);
}

template <int Most>
void AirNetwork<Most>::hold_still(Answer& look) const noexcept {
  for (int i = 0; i < size_; ++i)
    look.inflow[i] = look.outflow[i] = look.gain[i] = look.leak[i] = 0;
  for (const int held : held_) rate(look, held) = 0;
  look.cylinder_inflow = look.cylinder_outflow = {};
}

template <int Most>
auto AirNetwork<Most>::initial(double pressure, const Lanes& length, double travel) const -> State {
  State state{};
  hold(pressure, length, travel, state);
  for (const Line& l : lines_)
    for (const int late : l.late)
      if (late != none) other(state, late) = pressure - air_.atmosphere;
  for (const Side side : {up, down}) {
    if (sides_[side].mass == none) continue;
    const double given = cylinder_->initial_pressure[side];
    fill(sides_[side],
         density(given > 0 ? given : air_.atmosphere) * air::volume(*cylinder_, side, travel),
         state);
  }
  for (const int v : lagging_)
    other(state, taps_[static_cast<std::size_t>(v)].outlet) = air_.atmosphere;
  if (tank_ != none) other(state, tank_) = gas::tank_mass(supply_, air_, supply_.initial_pressure);
  return state;
}

template <int Most>
auto AirNetwork<Most>::valves_at_rest() const -> Valves {
  Valves valves{};
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    // In its place, so that what lies between its members stays 0 (driven_muscle.h).
    std::construct_at(&valves[v].shutter, taps_[v].valve);
    valves[v].set = air_.atmosphere;
    valves[v].set_y = 1;
    valves[v].next_set_at = never;
  }
  refresh(0.0, valves);
  return valves;
}

template <int Most>
auto AirNetwork<Most>::memory_at_rest(double pressure, const Lanes& length) const -> Memory {
  Memory memory{};
  memory.reference = braids_.template reference<Most>();
  for (int i = 0; i < size_; ++i)
    if (line(i).plays)
      memory.play[i] =
          actuator::play_at_rest(muscle(i).actuator, length[i], pressure - air_.atmosphere);
  return memory;
}

template <int Most>
double AirNetwork<Most>::total_mass(const State& state, double travel) const noexcept {
  double sum = 0;
  for (int i = 0; i < size_; ++i) {
    sum += state.mass[i];
    if (line(i).hose != none) sum += other(state, line(i).hose);
  }
  if (tank_ != none) sum += other(state, tank_);
  for (const Slot& side : sides_)
    if (side.mass != none) sum += other(state, side.mass);
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::regulator)
    sum += gas::density(air_, cylinder_->pressure) * air::volume(*cylinder_, down, travel);
  return sum;
}

}  // namespace sinew::air
