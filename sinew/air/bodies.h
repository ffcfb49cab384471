// air/bodies.h - the bodies of air of a machine: chambers of muscles and of a cylinder, hoses and a
// tank. Computes their initial state, their content and how fast they settle.
//
// The state of a body of air is its mass, [40], and its energy where walls are warm. The muscles'
// masses form an array of their own; all other states are numbered in AirState::other.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "sinew/actuator/body.h"
#include "sinew/actuator/braid.h"
#include "sinew/actuator/creep.h"
#include "sinew/actuator/hysteresis.h"
#include "sinew/air/braid_lanes.h"
#include "sinew/air/cylinder.h"
#include "sinew/air/failure.h"
#include "sinew/air/muscle.h"
#include "sinew/air/regulator_lanes.h"
#include "sinew/air/valve_bank.h"
#include "sinew/gas/heat.h"
#include "sinew/gas/hose.h"
#include "sinew/gas/supply.h"

namespace sinew::air {

// Largest product of step and decay rate that is used with RK4, which is stable up to 2.78.
inline constexpr double stable_decay = 2.5;

namespace quick {
inline constexpr double from_rate = 2.5;  // rate times step from which a body is integrated ahead
}

// All bodies of air of a machine (of its muscles, hoses and cylinder) with the valves that join
// them.
template <int Most>
class BodiesOfAir : public ValveBank<Most> {
 public:
  using Lanes = air::Lanes<Most>;
  using Ends = air::Ends<Most>;
  using typename ValveBank<Most>::Evaluation, typename ValveBank<Most>::Memory,
      typename ValveBank<Most>::State, typename ValveBank<Most>::Valves;

  // Return the number of muscles, and the number of states other than their masses.
  int muscles() const noexcept { return size_; }
  int others() const noexcept { return others_; }
  double atmosphere() const noexcept { return air_.atmosphere; }  // [Pa]

  // Selects a table for densities outside the series' range, for steps that often leave that range.
  void use_power_table() { braids_.use_power_table(); }

  // plain() returns whether the machine has only muscles between narrow valves on a constant
  // supply. stays_plain() also excludes later faults and valves that open gradually: plain_air.h
  // integrates such machines in lanes, with the values below.
  bool plain() const noexcept { return plain_; }
  bool stays_plain() const noexcept { return plain_ && !ramping_ && faults_.empty(); }
  const BraidLanes& braids() const noexcept { return braids_; }
  double supply_y() const noexcept { return supply_y_; }  // (P/P_atm)^(1/7) of the supply [-]

  // Return the volume of the air in muscle i [m^3], and its mass at this pressure and length [kg].
  double volume(int i, double length) const noexcept;
  double mass_at(int i, double pressure, double length) const noexcept {
    return density(pressure) * volume(i, length);
  }

  // Returns the state with all muscles at rest at one absolute pressure, air at the wall's
  // temperature.
  State initial(double pressure, const Lanes& length, double travel) const;

  // Returns the memory after a long rest at this pressure and length, before the series have a
  // base.
  Memory memory_at_rest(double pressure, const Lanes& length) const;

  // Sets chambers and hoses of the muscles, and of a single-acting cylinder, to one absolute
  // pressure with air at the wall's temperature, as an ideal regulator would.
  void impose_pressure(double pressure, const Lanes& length, double travel,
                       State& state) const noexcept;

  // Sets the rates of the states that impose_pressure() sets to 0.
  void clear_imposed_rates(Evaluation& evaluation) const noexcept;

  // Returns the mass of the air in chambers, hoses and tank [kg]. It decreases only by what leaves
  // through exhausts and leaks.
  double total_mass(const State& state, double travel) const noexcept;

  // Returns whether air flows, warms or creeps, or can start to do so without a change of a valve.
  bool flowing(const Valves& valves) const noexcept {
    return active_when_shut_ || ramping_ || valves.open_count > 0 || valves.leaking;
  }

  // Updates the memory at a node from the evaluation there: the references of the series and the
  // plays of the hysteresis. Evaluations between two nodes use the memory of the last one, which is
  // exact as long as no pressure reverses between them. Returns the first part of the air that is
  // not finite or not physical.
  Failure update_memory(const Evaluation& evaluation, const State& state,
                        Memory& memory) const noexcept;

  // Returns the muscles, a bit each, that are always integrated ahead while air flows: those behind
  // hoses that hold air and, while nothing is broken, behind regulators that are quick at any
  // length.
  std::uint64_t always_quick_muscles(const Valves& valves) const noexcept {
    return valves.broken ? behind_hoses_ : behind_hoses_ | behind_regulators_;
  }

  // Returns the air in muscle i, and the masses that have passed its valves and leaks so far [kg].
  Account account(const State& s, int i) const noexcept {
    return {.mass = s.mass[i], .in = s.in[i], .out = s.out[i], .leak = s.leak[i]};
  }
  // Returns the pressure behind the valves of muscle i: its own, or that before a hose [Pa].
  double manifold(const Evaluation& a, int i, const Valves& valves) const noexcept {
    return line(i).has_options || valves.broken ? a.manifold[i] : a.pressure[i];
  }
  double leak(const Evaluation& a, int i, const Valves& valves) const noexcept {  // [kg/s]
    return line(i).has_options || valves.broken ? a.leak[i] : 0.0;
  }
  Account cylinder_account(const State& s, int side) const noexcept {
    const auto c = static_cast<std::size_t>(side);
    const int mass = sides_[c].mass;
    return {
        .mass = mass != none ? other(s, mass) : 0.0, .in = s.piston_in[c], .out = s.piston_out[c]};
  }
  double cylinder_pressure(const Evaluation& a, int side) const noexcept {  // [Pa]
    return a.cylinder_pressure[static_cast<std::size_t>(side)];
  }
  // Returns the supply's state. `past_tank` is the mass that the supply has delivered while a fault
  // had cut it from its tank; it is negative if air has flowed back.
  SupplyState supply_state(const State& s, const Evaluation& a) const noexcept {
    return {a.supply_pressure, a.tank_pressure, cut_ == none ? 0.0 : other(s, cut_)};
  }

  // Returns the longest step for which RK4 is stable: by the fastest chamber, lag or wall that an
  // option adds, or infinity [s]. The first overload holds for every position of the piston. The
  // second is for given positions and includes muscles that never seal (behind a regulator or a
  // hose's chamber, or with a leak) or whose wide valve is open.
  double longest_step() const noexcept;
  double longest_step(const Ends& ends, const Valves& valves) const noexcept;

  // Returns the longest stable step of all that is never integrated ahead of the body: warm walls,
  // lags, creep, leaks behind a hose that holds no air, and a tank that open valves empty [s].
  double longest_step_of_rest(const Ends& ends, const Valves& valves) const noexcept;

  // Returns the longest step in which the air of the cylinder's chambers changes little [s]: its
  // spring, gamma P A^2/V, moves the body by half a radian at most, and the piston covers at most
  // an eighth of the remaining volume. Both rates grow without bound as a chamber vanishes. Returns
  // infinity without chambers. `lift_per_force`: acceleration of the body per force of the piston
  // [1/kg].
  double longest_step_of_piston(const Ends& ends, const Evaluation& evaluation,
                                double lift_per_force) const noexcept;

 protected:
  using Bank = ValveBank<Most>;
  // These members of the valves are used without their class's name.
  using Bank::air_, Bank::blocked, Bank::failed_line, Bank::faults_, Bank::none, Bank::of_pressure_,
      Bank::other, Bank::ramping_, Bank::rate_of, Bank::slope_of_faults, Bank::taps_;
  using typename Bank::Flows, typename Bank::FlowInputs, typename Bank::Tap;

  // The parts between a muscle's valves and its air, with the indices of their states; none: no
  // state.
  struct AirLine {
    int energy = none, hose = none, hose_energy = none;  // a hose without volume has no mass
    bool has_hose = false, has_options = false;  // it has a hose; it has more than narrow valves
    gas::HoseConstants hose_flow;
    gas::LeakConstants leak;
    bool plays = false;                                          // has hysteresis
    std::array<int, actuator::Creep::most> late = {none, none};  // states of the creep
    double settling = 0;  // n R T times the slope of the flow that never shuts, else 0 [m^3/s]
    std::array<double, 2> by_valve{};  // n R T times the slope of a wide inlet, exhaust, else 0;
                                       // with a hose without volume, of both in series
  };
  struct Slot {
    int mass = none, energy = none;
  };
  // A volume that changes steadily within a step.
  struct LinearVolume {
    double volume = 0, rate = 0;  // [m^3], [m^3/s]
  };
  // The line to the inlets: y = (P/P_atm)^(1/7).
  struct SupplyLine {
    double y = 1;
    bool cut = false;  // a fault has cut it from its tank
  };

  // Builds the bodies of a machine, with its list of faults, for steps of the body of at most
  // `step` [s].
  BodiesOfAir(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
              const std::optional<Cylinder>& cylinder, std::span<const AirFault> faults,
              double step);

  // Return a muscle, and its line.
  const Muscle& muscle(int i) const noexcept { return muscles_[static_cast<std::size_t>(i)]; }
  const AirLine& line(int i) const noexcept { return lines_[static_cast<std::size_t>(i)]; }

  // Returns n R T times the slope of the wide valves of muscle i that are open [m^3/s].
  double settling_of_open(int i, const Valves& valves) const noexcept {
    double sum = 0;
    for (std::size_t v = 0; v < 2; ++v)
      if (ramping_ || valves[2 * static_cast<std::size_t>(i) + v].share > 0)
        sum += line(i).by_valve[v];
    return sum;
  }

  // Calls visit(i) for the muscles whose lines are evaluated one by one: those with more than
  // valves, and all of them while something is broken.
  template <class Visit>
  void each_line(const Valves& valves, Visit visit) const noexcept;
  SupplyLine supply_line(const State& state, const Valves& valves, const Memory& memory,
                         Evaluation& out) const noexcept;

  int size_ = 0, others_ = 0;
  gas::Supply supply_;
  double supply_y_ = 0;  // at its set pressure
  std::vector<Muscle> muscles_;
  BraidLanes braids_;
  RegulatorLanes regulators_;
  bool in_lanes_ = false;  // all muscles are evaluated by braids_
  bool plain_ = false;     // the machine has only muscles between valves on a constant supply
  std::optional<Cylinder> cylinder_;

  std::vector<AirLine> lines_;
  std::vector<int> with_options_;  // muscles whose line has more than valves
  std::array<Slot, 2> sides_;      // the cylinder's
  std::vector<int> lagging_;       // valves of the regulators whose outlet pressure is a state
  std::vector<int> imposed_;       // indices of the other states that impose_pressure() sets
  int tank_ = none;
  std::vector<double> tank_rates_;  // of each pair's inlet, with a tank [1/s]
  bool active_when_shut_ = false;
  int cut_ = none;           // index of the state: mass from a line that is cut from its tank
  double spring_ = 0;        // n R T: a chamber of volume V behind a slope G settles at n R T G/V
  double lag_rate_ = 0;      // rate of the quickest lag or creep [1/s]
  double longest_step_ = 0;  // for all parts whose rate does not depend on the position [s]
  std::array<double, 2> side_settling_{};  // `settling` of the cylinder's chambers [m^3/s]
  std::uint64_t behind_hoses_ = 0, behind_regulators_ = 0;  // always integrated ahead
  std::uint64_t by_regulators_ = 0;                         // integrated ahead by regulators_
  bool settles_ = false;                                    // a line has a `settling` above 0

 private:
  void add_muscle(const Muscle& muscle);
  void add_memory(int i);
  void add_cylinder();
  void add_tank();
  double rate_of_tank(const Valves& valves) const noexcept;
  void classify();
  void limit_step();
  double fastest_slope(int inlet) const;
  double steepest(const gas::FlowConstants& flow) const;
  void find_wide_valves(int i, double step);
  double hose_slope(const AirLine& line) const;
  bool is_always_quick(int i) const;
  double density(double pressure) const noexcept;
  void fill(const Slot& slot, double mass, State& state) const noexcept;
  double line_of_tank(const State& state, const Memory& memory, Evaluation& out) const noexcept;
};

template <int Most>
BodiesOfAir<Most>::BodiesOfAir(std::span<const Muscle> muscles, const gas::Air& air,
                               const gas::Supply& supply, const std::optional<Cylinder>& cylinder,
                               std::span<const AirFault> faults, double step)
    : ValveBank<Most>(air, faults),
      size_(static_cast<int>(muscles.size())),
      supply_(supply),
      supply_y_(gas::y_of(air, supply.pressure)),
      muscles_(muscles.begin(), muscles.end()),
      braids_(muscles, air),
      in_lanes_(!(air.wall_time > 0) && std::ranges::all_of(muscles, lanes_support)),
      cylinder_(cylinder) {
  if (size_ > Most) throw std::invalid_argument("more muscles than the network is compiled for");
  for (const Muscle& m : muscles_) add_muscle(m);
  for (AirLine& l : lines_) {
    const auto i = static_cast<std::size_t>(&l - lines_.data());
    if (air_.wall_time > 0) imposed_.push_back(l.energy = others_++);
    if (!l.has_hose || !(muscles_[i].hose.volume > 0)) continue;
    imposed_.push_back(l.hose = others_++);
    if (air_.wall_time > 0) imposed_.push_back(l.hose_energy = others_++);
  }
  if (cylinder_) add_cylinder();
  for (Tap& tap : taps_)
    if (regulates(tap.valve) && tap.valve.regulator.time_constant > 0) {
      lagging_.push_back(static_cast<int>(&tap - taps_.data()));
      tap.outlet = others_++;
    }
  // A filling from a vacuum makes air gamma times as hot as the wall.
  constexpr double of_hot_air = gas::heat_capacity_ratio * gas::heat_capacity_ratio;
  spring_ = (air_.wall_time > 0 ? of_hot_air : air_.polytropic_exponent) * air_.gas_constant *
            air_.temperature;
  for (int i = 0; i < size_; ++i) find_wide_valves(i, step);
  if (supply_.kind == gas::Supply::Kind::tank) add_tank();
  for (int i = 0; i < size_; ++i) add_memory(i);
  const auto fails = [](const AirFault& f) { return f.what == AirFault::What::supply; };
  if (tank_ != none && std::ranges::any_of(faults_.all(), fails)) cut_ = others_++;
  classify();
  limit_step();
}

// Adds a muscle with its valves. A 3-way valve and a regulator serve both ways and have no exhaust
// valve.
template <int Most>
void BodiesOfAir<Most>::add_muscle(const Muscle& m) {
  this->add_tap(m.inlet);
  this->add_tap(m.inlet.kind == gas::Valve::Kind::two_way ? m.exhaust : m.inlet);
  if (regulates(m.inlet)) taps_.back() = {};

  AirLine line;
  line.has_hose = m.hose.law != gas::Hose::Law::none;
  line.hose_flow = gas::hose_constants(m.hose, air_);
  line.leak = gas::leak_constants(m.leak, air_);
  line.has_options =
      line.has_hose || !line.leak.tight() || regulates(m.inlet) || air_.wall_time > 0;
  lines_.push_back(line);
}

// Returns the slope of a flow over the pressure where the pressures are nearly equal [kg/(s Pa)]. A
// law without a linear part is infinitely steep there: it has the slope of a thousandth.
template <int Most>
double BodiesOfAir<Most>::steepest(const gas::FlowConstants& flow) const {
  if (flow.linear_gain > 0) return flow.linear_gain / air_.atmosphere;
  constexpr double rest = 1e-3;
  return gas::flow_y(flow, 1.0, gas::y_of(air_, (1.0 - rest) * air_.atmosphere)) /
         (rest * air_.atmosphere);
}

// Notes the slopes of the on/off valves of muscle i if one of them is wide: if the muscle at
// `long_end.length` settles too quickly for RK4 in steps of the body where its pressure is still
// 0.6 % from that behind the valve. A narrower valve is too quick only nearer to that pressure, and
// then swings about it without effect; but with warm walls the air that swings exchanges heat with
// the supply, so that no valve may be too quick. A hose without volume is in series with the valve.
template <int Most>
void BodiesOfAir<Most>::find_wide_valves(int i, double step) {
  constexpr double rest = 0.006;  // difference of the pressures, over the larger one
  AirLine& l = lines_[static_cast<std::size_t>(i)];
  const auto inlet = static_cast<std::size_t>(2 * i);
  if (l.hose != none || regulates(taps_[inlet].valve)) return;
  const double least = volume(i, muscle(i).actuator.long_end.length);
  const double near = gas::y_of(air_, (1.0 - rest) * air_.atmosphere);
  const double hose = l.has_hose ? gas::hose_flow_y(l.hose_flow, 1.0, near) : 0.0;  // [kg/s]
  bool wide = false;
  std::array<double, 2> rates{};
  for (std::size_t v = 0; v < 2; ++v) {
    const gas::FlowConstants& flow = taps_[inlet + v].flow;
    double slope = steepest(flow), through = gas::flow_y(flow, 1.0, near);
    if (hose > 0 && through > 0) {
      slope = 1.0 / (1.0 / slope + 1.0 / hose_slope(l));
      through *= hose / std::hypot(through, hose);
    }
    rates[v] = spring_ * slope;
    wide = wide || spring_ * through * step > quick::from_rate * least * rest * air_.atmosphere ||
           (air_.wall_time > 0 && rates[v] * step > stable_decay * least);
  }
  if (!wide) return;
  l.by_valve = rates;
  l.has_options = settles_ = true;
}

// Allocates the tank's state, and notes the rates at which open inlets settle it.
template <int Most>
void BodiesOfAir<Most>::add_tank() {
  tank_ = others_++;
  const double spring = air_.gas_constant * air_.temperature / supply_.volume;
  for (std::size_t inlet = 0; inlet < taps_.size(); inlet += 2)
    tank_rates_.push_back(spring * steepest(taps_[inlet].flow));
}

// Returns the rate at which the open inlets settle the tank [1/s].
template <int Most>
double BodiesOfAir<Most>::rate_of_tank(const Valves& valves) const noexcept {
  double rate = 0;
  for (std::size_t i = 0; i < tank_rates_.size(); ++i)
    if (ramping_ || valves[2 * i].share > 0) rate += tank_rates_[i];
  return rate;
}

// Allocates the states of hysteresis and creep of muscle i.
template <int Most>
void BodiesOfAir<Most>::add_memory(int i) {
  const actuator::Actuator& a = muscle(i).actuator;
  AirLine& l = lines_[static_cast<std::size_t>(i)];
  l.plays = actuator::has_hysteresis(a.hysteresis);
  for (std::size_t k = 0; k < l.late.size(); ++k)
    if (a.creep.share[k] != 0) l.late[k] = others_++;
}

template <int Most>
void BodiesOfAir<Most>::add_cylinder() {
  for (const Side side : {up, down}) {
    this->add_tap(cylinder_->inlet[side]);
    this->add_tap(cylinder_->exhaust[side]);
    const bool open = cylinder_->mode == Cylinder::Mode::single_acting && side == down;
    if (cylinder_->mode == Cylinder::Mode::regulator || open) continue;
    if (!(cylinder_->dead_volume[side] > 0))
      throw std::invalid_argument("a cylinder's chambers need a dead volume");
    Slot& slot = sides_[side];
    slot.mass = others_++;
    if (air_.wall_time > 0) slot.energy = others_++;
    if (cylinder_->mode != Cylinder::Mode::single_acting) continue;
    imposed_.push_back(slot.mass);
    if (slot.energy != none) imposed_.push_back(slot.energy);
  }
}

// Determines whether anything flows, warms or creeps although every valve is shut, and which lines
// have more than valves.
template <int Most>
void BodiesOfAir<Most>::classify() {
  active_when_shut_ =
      air_.wall_time > 0 || (cylinder_ && cylinder_->mode == Cylinder::Mode::regulator);
  plain_ = !cylinder_ && tank_ == none && in_lanes_;
  for (int i = 0; i < size_; ++i) {
    const AirLine& l = line(i);
    const auto inlet = static_cast<std::size_t>(2 * i);
    active_when_shut_ =
        active_when_shut_ || !l.leak.tight() || l.hose != none || regulates(taps_[inlet].valve);
    active_when_shut_ = active_when_shut_ || actuator::has_creep(muscle(i).actuator.creep);
    plain_ = plain_ && !l.has_options;
    if (l.has_options) with_options_.push_back(i);
    if (l.hose != none && l.energy == none) behind_hoses_ |= std::uint64_t{1} << i;
    taps_[inlet].listed = taps_[inlet + 1].listed = !l.has_options;
    if (in_lanes_ && regulates(taps_[inlet].valve) && !l.has_hose && l.leak.tight())
      by_regulators_ |= std::uint64_t{1} << i;
  }
  if (by_regulators_ != 0) {
    std::vector<gas::Valve> inlets;
    for (const Muscle& m : muscles_) inlets.push_back(m.inlet);
    regulators_ = RegulatorLanes(braids_, inlets, air_);
  }
}

template <int Most>
double BodiesOfAir<Most>::volume(int i, double length) const noexcept {
  const Muscle& m = muscle(i);
  return m.count * actuator::volume(m.actuator, length) + m.external_volume;
}

// Returns the slope of the flow through a pair of valves, at nearly equal pressures  [kg/(s Pa)].
template <int Most>
double BodiesOfAir<Most>::fastest_slope(int inlet) const {
  const auto v = static_cast<std::size_t>(inlet);
  return steepest(taps_[v].flow) + steepest(taps_[v + 1].flow);
}

// Returns the slope of the flow through a hose  [kg/(s Pa)].
template <int Most>
double BodiesOfAir<Most>::hose_slope(const AirLine& line) const {
  const double p = supply_.pressure, y = gas::y_of(air_, p), y_less = gas::y_of(air_, 0.999 * p);
  return gas::hose_flow_y(line.hose_flow, y, y_less) / (1e-3 * p);
}

// Sets the longest step. A chamber of volume V whose flow has the slope G settles at n R T G/V.
template <int Most>
void BodiesOfAir<Most>::limit_step() {
  double rate = air_.wall_time > 0 ? 1.0 / air_.wall_time : 0.0;
  const auto faster = [&](double one) { rate = one > rate ? one : rate; };
  for (const int v : lagging_)
    faster(1.0 / taps_[static_cast<std::size_t>(v)].valve.regulator.time_constant);
  for (const Muscle& m : muscles_)
    for (std::size_t k = 0; k < m.actuator.creep.share.size(); ++k)
      if (m.actuator.creep.share[k] != 0) faster(1.0 / m.actuator.creep.time[k]);
  lag_rate_ = rate;
  for (int i = 0; i < size_; ++i) {
    AirLine& l = lines_[static_cast<std::size_t>(i)];
    double slope = (l.leak.hole.linear_gain + l.leak.slope) / air_.atmosphere;
    if (l.hose != none)
      slope += hose_slope(l);
    else if (regulates(taps_[static_cast<std::size_t>(2 * i)].valve))
      slope += fastest_slope(2 * i);
    l.settling = spring_ * slope;
    settles_ = settles_ || l.settling > 0;
    if (is_always_quick(i)) behind_regulators_ |= std::uint64_t{1} << i;
    if (l.hose != none)
      faster(spring_ * (fastest_slope(2 * i) + hose_slope(l)) / muscle(i).hose.volume);
  }
  for (const Side side : {up, down})
    if (sides_[side].mass != none)
      side_settling_[side] = spring_ * fastest_slope(2 * (size_ + side));
  longest_step_ = rate > 0 ? stable_decay / rate : never;
}

// Returns whether muscle i, behind a regulator alone, is quick for a step of a millisecond even at
// its largest volume.
template <int Most>
bool BodiesOfAir<Most>::is_always_quick(int i) const {
  const bool regulated = regulates(taps_[static_cast<std::size_t>(2 * i)].valve);
  if (!regulated || line(i).has_hose || air_.wall_time > 0) return false;
  const double most = volume(i, actuator::shortest_length(muscle(i).actuator));
  return line(i).settling * 1e-3 > quick::from_rate * most;
}

// With the piston at the end of its stroke a chamber consists of the dead volume alone.
template <int Most>
double BodiesOfAir<Most>::longest_step() const noexcept {
  double fastest = stable_decay / longest_step_;
  for (const Side side : {up, down})
    if (sides_[side].mass != none)
      fastest = std::max(fastest, side_settling_[side] / cylinder_->dead_volume[side]);
  return fastest > 0 ? stable_decay / fastest : never;
}

// The rates of a hose's chamber and of the muscle behind it add up, at most. A cylinder's chamber
// with its valves shut has no rate. A leak by a fault may be in either chamber of a muscle.
template <int Most>
double BodiesOfAir<Most>::longest_step(const Ends& ends, const Valves& valves) const noexcept {
  if (plain_ && !valves.leaking) return never;
  double fastest = 0;
  for (int i = 0; i < size_ && (settles_ || valves.leaking); ++i) {
    double one = (line(i).settling + settling_of_open(i, valves)) / volume(i, ends.length[i]);
    if (valves.leaking) {
      const double broken = spring_ * slope_of_faults(i, valves.faults);
      one += broken / volume(i, ends.length[i]);
      if (line(i).hose != none) one += broken / muscle(i).hose.volume;
    }
    fastest = std::max(fastest, one);
  }
  fastest += stable_decay / longest_step_;
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
  return fastest > 0 ? stable_decay / fastest : never;
}

// Bodies that are integrated ahead take the tank's pressure as constant through a step, in which
// the tank may therefore give at most what it has above the lowest pressure behind its valves.
template <int Most>
double BodiesOfAir<Most>::longest_step_of_rest(const Ends& ends,
                                               const Valves& valves) const noexcept {
  const double of_tank = rate_of_tank(valves);
  const double longest = of_tank > 0 ? 1.0 / of_tank : never;
  if (air_.wall_time > 0) return std::min(longest, longest_step(ends, valves));
  double fastest = lag_rate_;
  for (int i = 0; i < size_ && (settles_ || valves.leaking); ++i) {
    const bool held_back = line(i).hose == none && blocked(i, valves);
    if (!held_back) continue;
    const double slope = line(i).settling + spring_ * slope_of_faults(i, valves.faults);
    fastest = std::max(fastest, slope / volume(i, ends.length[i]));
  }
  return fastest > 0 ? std::min(longest, stable_decay / fastest) : longest;
}

template <int Most>
double BodiesOfAir<Most>::longest_step_of_piston(const Ends& ends, const Evaluation& evaluation,
                                                 double lift_per_force) const noexcept {
  double longest = never;
  for (const Side side : {up, down}) {
    if (sides_[side].mass == none) continue;
    const double room = air::volume(*cylinder_, side, ends.travel), face = area(*cylinder_, side);
    const double spring =
        gas::heat_capacity_ratio * evaluation.cylinder_pressure[side] * face * face / room;
    longest = std::min(longest, 0.5 / std::sqrt(spring * lift_per_force));
    longest = std::min(longest, 0.125 * room / (face * std::abs(ends.travel_rate)));
  }
  return longest;
}

// Returns the density of air at rest, by the chamber's law [kg/m^3].
template <int Most>
double BodiesOfAir<Most>::density(double pressure) const noexcept {
  return air_.wall_time > 0 ? pressure / (air_.gas_constant * air_.temperature)
                            : gas::density(air_, pressure);
}

template <int Most>
void BodiesOfAir<Most>::fill(const Slot& slot, double mass, State& state) const noexcept {
  other(state, slot.mass) = mass;
  if (slot.energy != none) other(state, slot.energy) = gas::energy_at_rest(air_, mass);
}

template <int Most>
void BodiesOfAir<Most>::impose_pressure(double pressure, const Lanes& length, double travel,
                                        State& state) const noexcept {
  const double rho = density(pressure);
  for (int i = 0; i < size_; ++i) {
    const AirLine& l = line(i);
    state.mass[i] = rho * volume(i, length[i]);
    if (l.energy != none) other(state, l.energy) = gas::energy_at_rest(air_, state.mass[i]);
    if (l.hose != none) fill({l.hose, l.hose_energy}, rho * muscle(i).hose.volume, state);
  }
  for (int i = size_; i < braids_.padded(); ++i) state.mass[i] = state.mass[size_ - 1];
  if (cylinder_ && cylinder_->mode == Cylinder::Mode::single_acting)
    fill(sides_[up], rho * air::volume(*cylinder_, up, travel), state);
}

template <int Most>
void BodiesOfAir<Most>::clear_imposed_rates(Evaluation& evaluation) const noexcept {
  for (int i = 0; i < size_; ++i)
    evaluation.inflow[i] = evaluation.outflow[i] = evaluation.gain[i] = evaluation.leak[i] = 0;
  for (const int index : imposed_) rate_of(evaluation, index) = 0;
  evaluation.cylinder_inflow = evaluation.cylinder_outflow = {};
}

template <int Most>
auto BodiesOfAir<Most>::initial(double pressure, const Lanes& length, double travel) const
    -> State {
  State state{};
  impose_pressure(pressure, length, travel, state);
  for (const AirLine& l : lines_)
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
auto BodiesOfAir<Most>::memory_at_rest(double pressure, const Lanes& length) const -> Memory {
  Memory memory{};
  memory.reference = braids_.template reference<Most>();
  for (int i = 0; i < size_; ++i)
    if (line(i).plays)
      memory.play[i] =
          actuator::play_at_rest(muscle(i).actuator, length[i], pressure - air_.atmosphere);
  return memory;
}

template <int Most>
double BodiesOfAir<Most>::total_mass(const State& state, double travel) const noexcept {
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

template <int Most>
template <class Visit>
void BodiesOfAir<Most>::each_line(const Valves& valves, Visit visit) const noexcept {
  if (valves.broken)
    for (int i = 0; i < size_; ++i) visit(i);
  else
    for (const int i : with_options_) visit(i);
}

// Returns y of the line to the inlets behind a tank [-].
template <int Most>
double BodiesOfAir<Most>::line_of_tank(const State& state, const Memory& memory,
                                       Evaluation& out) const noexcept {
  out.tank_pressure = gas::tank_pressure(supply_, air_, other(state, tank_));
  out.supply_pressure = gas::line_pressure(supply_, out.tank_pressure);
  return out.supply_pressure < supply_.pressure
             ? gas::root(of_pressure_, memory.line, out.supply_pressure, air_.atmosphere)
             : supply_y_;
}

// Returns the line before the inlets, which depends on tank and faults.
template <int Most>
auto BodiesOfAir<Most>::supply_line(const State& state, const Valves& valves, const Memory& memory,
                                    Evaluation& out) const noexcept -> SupplyLine {
  out.supply_pressure = out.tank_pressure = supply_.pressure;
  const double y = tank_ != none ? line_of_tank(state, memory, out) : supply_y_;
  const double failed = valves.broken ? failed_line(valves, out) : 0.0;
  return failed > 0 ? SupplyLine{failed, true} : SupplyLine{y, false};
}

template <int Most>
Failure BodiesOfAir<Most>::update_memory(const Evaluation& evaluation, const State& state,
                                         Memory& memory) const noexcept {
  const int failed = braids_.update_references(evaluation.drift, memory.reference);
  if (failed >= 0) return {.of = Failure::Of::air, .muscle = failed};
  if (plain_) return {};
  const double at_one = gas::density_at_atmosphere(air_);
  for (int i = 0; i < size_; ++i) {
    const AirLine& l = line(i);
    if (!is_pressure(evaluation.pressure[i])) return {.of = Failure::Of::air, .muscle = i};
    if (l.plays) memory.play[i] = evaluation.play[i];
    if (l.hose != none && l.hose_energy == none)
      gas::update_base(braids_.series(), memory.hose[static_cast<std::size_t>(i)],
                       other(state, l.hose) / muscle(i).hose.volume, at_one);
  }
  for (const Side side : {up, down}) {
    if (!cylinder_) break;
    const double p = evaluation.cylinder_pressure[side];
    if (!(p >= 0 && p < most_pressure)) return {.of = Failure::Of::cylinder};
    if (sides_[side].mass != none && sides_[side].energy == none)
      gas::update_base(braids_.series(), memory.side[side], evaluation.cylinder_density[side],
                       at_one);
  }
  for (const int valve : lagging_) {
    const auto v = static_cast<std::size_t>(valve);
    gas::update_base(of_pressure_, memory.outlet[v], other(state, taps_[v].outlet),
                     air_.atmosphere);
  }
  if (tank_ != none)
    gas::update_base(of_pressure_, memory.line, evaluation.supply_pressure, air_.atmosphere);
  return {};
}

extern template class BodiesOfAir<4>;
extern template class BodiesOfAir<8>;
extern template class BodiesOfAir<48>;

}  // namespace sinew::air
