// muscle/plumbing_setup.cpp - what a plumbing's state holds, how it starts, and how fast it can be.
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/actuator/tension.h"
#include "sinew/gas/heat.h"
#include "sinew/muscle/plumbing.h"

namespace sinew::muscle {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double stable = 2.5;  // step x rate of a decay that RK4 can bear, 2.78 at the limit

using Kind = gas::Valve::Kind;

bool regulates(const gas::Valve& valve) { return valve.kind == Kind::regulator; }

bool needs_pressures(const gas::Valve& v) {
  return v.fails_above > 0 || v.opening_delay_slope != 0 || v.closing_delay_slope != 0;
}

}  // namespace

bool needs_plumbing(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
                    const std::optional<Cylinder>& cylinder, std::span<const AirFault> faults) {
  bool any = cylinder.has_value() || air.wall_time > 0 ||
             supply.kind != gas::Supply::Kind::constant ||
             !std::ranges::all_of(faults, is_share_of_valve);
  for (const Muscle& m : muscles) {
    any = any || !lanes_hold(m);
    any = any || m.hose.law != gas::Hose::Law::none || m.leak.area > 0 || m.leak.conductance > 0;
    for (const gas::Valve* v : {&m.inlet, &m.exhaust})
      any = any || regulates(*v) || needs_pressures(*v);
  }
  return any;
}

Plumbing::Plumbing(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
                   const std::optional<Cylinder>& cylinder, std::span<const AirFault> faults)
    : size_(static_cast<int>(muscles.size())),
      air_(air),
      supply_(supply),
      supply_y_(gas::y_of(air, supply.pressure)),
      muscles_(muscles.begin(), muscles.end()),
      braids_(muscles, air),
      in_lanes_(!(air.wall_time > 0) && std::ranges::all_of(muscles, lanes_hold)),
      cylinder_(cylinder),
      faults_(faults) {
  for (const Muscle& m : muscles_) add_muscle(m);
  for (int i = 0; i < size_; ++i) lines_[static_cast<std::size_t>(i)].chamber.mass = states_++;
  if (air_.wall_time > 0)
    for (Line& l : lines_) l.chamber.energy = states_++;
  for (Line& l : lines_)
    if (l.resists && muscles_[static_cast<std::size_t>(&l - lines_.data())].hose.volume > 0)
      l.hose = add_chamber();
  if (cylinder_) add_cylinder();
  held_states_ = states_;
  for (Tap& tap : taps_)
    if (regulates(tap.valve) && tap.valve.regulator.time_constant > 0) tap.outlet = states_++;
  if (supply_.kind == gas::Supply::Kind::tank) tank_ = states_++;
  for (int i = 0; i < size_; ++i) add_memory(i);
  add_faults();

  // What flows, warms or creeps although every valve is shut.
  restless_ = air_.wall_time > 0 || (cylinder_ && cylinder_->mode == Cylinder::Mode::regulator);
  for (const Line& l : lines_) restless_ = restless_ || !l.leak.tight() || l.hose.mass != none;
  for (const Tap& tap : taps_) restless_ = restless_ || regulates(tap.valve);
  for (const Muscle& m : muscles_) restless_ = restless_ || actuator::has_creep(m.actuator.creep);
  for (const Tap& tap : taps_)
    ramping_ = ramping_ || tap.valve.profile == gas::Valve::Profile::ramp;
  limit_step();
}

Plumbing::Valves Plumbing::valves_at_rest() const {
  Valves valves;
  for (std::size_t v = 0; v < taps_.size(); ++v) {
    valves[v].shutter = gas::Shutter(taps_[v].valve);
    valves[v].set = air_.atmosphere;
    valves[v].next_set_at = never;
  }
  refresh(0.0, valves);
  return valves;
}

Plumbing::Slot Plumbing::add_chamber() {
  Slot slot{.mass = states_++};
  if (air_.wall_time > 0) slot.energy = states_++;
  return slot;
}

void Plumbing::add_tap(const gas::Valve& valve) {
  taps_.push_back({.valve = valve, .flow = gas::flow_constants(valve.flow, air_)});
}

// A 3-way valve and a regulator serve both ways; no other valve stands beside them.
void Plumbing::add_muscle(const Muscle& m) {
  add_tap(m.inlet);
  add_tap(m.inlet.kind == Kind::two_way ? m.exhaust : m.inlet);
  if (regulates(m.inlet)) taps_.back() = {};

  Line line;
  line.resists = m.hose.law != gas::Hose::Law::none;
  line.hose_flow = gas::hose_constants(m.hose, air_);
  line.leak = gas::leak_constants(m.leak, air_);
  lines_.push_back(line);
}

// What the mesh of muscle i remembers.
void Plumbing::add_memory(int i) {
  const actuator::Actuator& a = muscles_[static_cast<std::size_t>(i)].actuator;
  Line& l = lines_[static_cast<std::size_t>(i)];
  if (actuator::has_hysteresis(a.hysteresis)) l.play = states_++;
  plays_ = plays_ || l.play != none;
  for (std::size_t k = 0; k < l.late.size(); ++k)
    if (a.creep.share[k] != 0) l.late[k] = states_++;
}

void Plumbing::add_cylinder() {
  for (const Side side : {up, down}) {
    add_tap(cylinder_->inlet[side]);
    add_tap(cylinder_->exhaust[side]);
    const bool open = cylinder_->mode == Cylinder::Mode::single_acting && side == down;
    if (cylinder_->mode == Cylinder::Mode::regulator || open) continue;
    if (!(cylinder_->dead_volume[side] > 0))
      throw std::invalid_argument("a cylinder's chambers need a dead volume");
    sides_[side] = add_chamber();
  }
}

// Of the flow through a pair of valves, at nearly equal pressures  [kg/(s Pa)].
double Plumbing::fastest_slope(int inlet) const {
  const auto v = static_cast<std::size_t>(inlet);
  return (taps_[v].flow.linear_gain + taps_[v + 1].flow.linear_gain) / air_.atmosphere;
}

// The same through a hose  [kg/(s Pa)].
double Plumbing::hose_slope(const Line& line) const {
  const double p = supply_.pressure, y = gas::y_of(air_, p), y_less = gas::y_of(air_, 0.999 * p);
  return gas::hose_flow_y(line.hose_flow, y, y_less) / (1e-3 * p);
}

// A chamber of volume V whose flow has the slope G decays at n R T G/V.
void Plumbing::limit_step() {
  double rate = air_.wall_time > 0 ? 1.0 / air_.wall_time : 0.0;
  const auto faster = [&](double one) { rate = one > rate ? one : rate; };
  for (const Tap& tap : taps_)
    if (tap.outlet != none) faster(1.0 / tap.valve.regulator.time_constant);
  for (int i = 0; i < size_; ++i) {
    const auto m = static_cast<std::size_t>(i);
    for (std::size_t k = 0; k < lines_[m].late.size(); ++k)
      if (lines_[m].late[k] != none) faster(1.0 / muscles_[m].actuator.creep.time[k]);
  }
  const double exponent = air_.wall_time > 0 ? gas::heat_capacity_ratio : air_.polytropic_exponent;
  const double spring = spring_ = exponent * air_.gas_constant * air_.temperature;
  for (int i = 0; i < size_; ++i) {
    Line& l = lines_[static_cast<std::size_t>(i)];
    double slope = (l.leak.hole.linear_gain + l.leak.slope) / air_.atmosphere;
    if (l.hose.mass != none)
      slope += hose_slope(l);
    else if (regulates(taps_[static_cast<std::size_t>(2 * i)].valve))
      slope += fastest_slope(2 * i);
    l.settling = spring * slope;
    settles_ = settles_ || l.settling > 0;
    if (l.hose.mass == none) continue;
    faster(spring * (fastest_slope(2 * i) + hose_slope(l)) /
           muscles_[static_cast<std::size_t>(i)].hose.volume);
  }
  for (const Side side : {up, down})
    if (sides_[side].mass != none)
      side_settling_[side] = spring * fastest_slope(2 * (size_ + side));
  longest_step_ = rate > 0 ? stable / rate : never;
}

// With the piston at the end of its stroke a chamber is the dead volume alone.
double Plumbing::longest_step() const noexcept {
  double fastest = stable / longest_step_;
  for (const Side side : {up, down})
    if (sides_[side].mass != none)
      fastest = std::max(fastest, side_settling_[side] / cylinder_->dead_volume[side]);
  return fastest > 0 ? stable / fastest : never;
}

// Rates of a hose's chamber and of the muscle behind it add up, at most. A cylinder's chamber with
// its valves shut has none. A fault that leaks may leak from either chamber of a muscle.
double Plumbing::longest_step(const Lanes& length, double travel,
                              const Valves& valves) const noexcept {
  double fastest = 0;
  for (int i = 0; i < size_ && (settles_ || valves.leaking); ++i) {
    const auto m = static_cast<std::size_t>(i);
    double rate = lines_[m].settling / volume(i, length[i]);
    if (valves.leaking) {
      const double broken = spring_ * slope_of_faults(i, valves.faults);
      rate += broken / volume(i, length[i]);
      if (lines_[m].hose.mass != none) rate += broken / muscles_[m].hose.volume;
    }
    fastest = std::max(fastest, rate);
  }
  fastest += stable / longest_step_;
  for (const Side side : {up, down}) {
    if (sides_[side].mass == none) continue;
    const auto inlet = static_cast<std::size_t>(2 * (size_ + side));
    const bool open = ramping_ || valves[inlet].share > 0 || valves[inlet + 1].share > 0;
    const double broken =
        valves.leaking ? spring_ * slope_of_faults(size_ + side, valves.faults) : 0.0;
    if (!open && !(broken > 0)) continue;
    fastest = std::max(fastest,
                       (side_settling_[side] + broken) / muscle::volume(*cylinder_, side, travel));
  }
  return fastest > 0 ? stable / fastest : never;
}

// A mesh that has stood at this pressure and length for long.
void Plumbing::rest(int i, double gauge, double length, AirState& state) const {
  const Line& l = lines_[static_cast<std::size_t>(i)];
  const actuator::Actuator& a = muscles_[static_cast<std::size_t>(i)].actuator;
  if (l.play != none) state[l.play] = actuator::play_at_rest(a, length, gauge);
  for (const int late : l.late)
    if (late != none) state[late] = gauge;
}

void Plumbing::fill(const Slot& slot, double mass, AirState& state) const noexcept {
  state[slot.mass] = mass;
  if (slot.energy != none) state[slot.energy] = gas::energy_at_rest(air_, mass);
}

// Density of air at rest, by the chamber's law  [kg/m^3].
double Plumbing::density(double pressure) const noexcept {
  return air_.wall_time > 0 ? pressure / (air_.gas_constant * air_.temperature)
                            : gas::density(air_, pressure);
}

void Plumbing::hold(double pressure, const Lanes& length, double travel,
                    AirState& state) const noexcept {
  const double rho = density(pressure);
  for (int i = 0; i < size_; ++i) {
    const Line& l = lines_[static_cast<std::size_t>(i)];
    const Muscle& m = muscles_[static_cast<std::size_t>(i)];
    fill(l.chamber, rho * volume(i, length[i]), state);
    if (l.hose.mass != none) fill(l.hose, rho * m.hose.volume, state);
  }
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::single_acting)
    fill(sides_[up], rho * muscle::volume(*cylinder_, up, travel), state);
}

AirState Plumbing::initial(double pressure, const Lanes& length, double travel) const {
  AirState state{};
  state.reference = braids_.reference();
  hold(pressure, length, travel, state);
  for (int i = 0; i < size_; ++i) rest(i, pressure - air_.atmosphere, length[i], state);
  for (const Side side : {up, down}) {
    if (sides_[side].mass == none) continue;
    const double given = cylinder_->initial_pressure[side];
    fill(sides_[side],
         density(given > 0 ? given : air_.atmosphere) * muscle::volume(*cylinder_, side, travel),
         state);
  }
  for (const Tap& tap : taps_)
    if (tap.outlet != none) state[tap.outlet] = air_.atmosphere;
  if (tank_ != none) state[tank_] = gas::tank_mass(supply_, air_, supply_.initial_pressure);
  return state;
}

double Plumbing::total_mass(const AirState& state, double travel) const {
  double sum = tank_ != none ? state[tank_] : 0.0;
  for (const Line& l : lines_) {
    sum += state[l.chamber.mass];
    if (l.hose.mass != none) sum += state[l.hose.mass];
  }
  for (const Slot& side : sides_)
    if (side.mass != none) sum += state[side.mass];
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::regulator)
    sum += gas::density(air_, cylinder_->pressure) * muscle::volume(*cylinder_, down, travel);
  return sum;
}

}  // namespace sinew::muscle
