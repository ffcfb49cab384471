// air/network.h - the air of a machine: bodies of air (chambers of muscles and of a cylinder,
// hoses, a tank, the room) joined by restrictions (valves, regulators, hoses, leaks), with the
// muscles that they fill. The air half of one ODE; world/world.h integrates it with a body:
//
//   lengths, rates, state, valves, memory  ->  tensions, pressures, flows
//
//   State    what is integrated, and what has passed the valves since the start
//   Valves   until the next node: where valves, set points and faults stand
//   Memory   until the next node: what the series stand on, where hysteresis stands
//   Answer   all that one evaluation yields
//
//   order    command() at t, from the look at the last node
//            move_valves(t) at next_change() and wherever the integrator wants a node, then
//            evaluate, and remember what the look at the node says
//
// A network itself is constant: whoever integrates owns the state.
//
// The state of a body of air is its mass, [40], and its energy where walls are warm. Muscles go
// side by side by braid_lanes.h where it holds them and no wall is warm, else one after the other
// by actuator/tension.h. What a machine does not have costs nothing: a muscle between two valves is
// lanes and a flow per open valve; only lines with more (a hose, a leak, a regulator, a warm wall),
// and all of them while something is broken, are asked one by one. The laws: gas/orifice.h,
// series.h, hose.h, leak.h, heat.h, supply.h, regulator.h, cylinder.h, actuator/hysteresis.h,
// creep.h.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sinew/air/braid_lanes.h"
#include "sinew/air/cylinder.h"
#include "sinew/air/failure.h"
#include "sinew/air/fault.h"
#include "sinew/air/muscle.h"
#include "sinew/air/network_state.h"
#include "sinew/air/regulator_lanes.h"
#include "sinew/gas/air.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/slopes.h"
#include "sinew/gas/supply.h"
#include "sinew/signals/port.h"

namespace sinew::air {

// For at most `Most` muscles: compiled for 4, 8 and 48.
template <int Most>
class AirNetwork {
 public:
  using Lanes = air::Lanes<Most>;
  using Ends = air::Ends<Most>;

  using State = AirState<Most>;
  using Valves = AirValves<Most>;
  using Memory = AirMemory<Most>;
  using Answer = AirAnswer<Most>;
  using Course = AirCourse<Most>;

  // Throws std::invalid_argument for more than `Most` muscles, and for a cylinder with valves whose
  // chambers vanish at a stop.
  AirNetwork(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
             const std::optional<Cylinder>& cylinder = {}, std::span<const AirFault> faults = {});

  // How many muscles there are, and how many bodies of air beside theirs.
  int muscles() const noexcept { return size_; }
  int others() const noexcept { return others_; }
  double atmosphere() const noexcept { return air_.atmosphere; }  // [Pa]

  // For steps in which densities leave the reach of their series as a rule.
  void take_long_steps() { braids_.go_by_table(); }

  // Is there nothing but muscles between valves on a constant supply?
  bool plain() const noexcept { return plain_; }
  // And nothing of it will ever break, nor do valves open by and by: plain_air.h then has its law,
  // which goes by these.
  bool plain_for_good() const noexcept { return plain_ && !ramping_ && faults_.empty(); }
  const BraidLanes& braids() const noexcept { return braids_; }
  const gas::FlowConstants& flow(int valve) const noexcept {
    return taps_[static_cast<std::size_t>(valve)].flow;
  }
  const gas::Valve& valve(int index) const noexcept {
    return taps_[static_cast<std::size_t>(index)].valve;
  }
  bool ramping() const noexcept { return ramping_; }  // some shutter opens or closes gradually
  // Replaces the law of a valve's flow, for steps that are cut where it jumps.
  void set_flow(int valve, const gas::FlowConstants& flow) noexcept {
    taps_[static_cast<std::size_t>(valve)].flow = flow;
  }
  double supply_y() const noexcept { return supply_y_; }  // (P/P_atm)^(1/7) of the supply [-]

  // 2 x muscle + (0 inlet | 1 exhaust), then the cylinder's: up inlet, up exhaust, down inlet, down
  // exhaust.
  int valves() const noexcept { return static_cast<int>(taps_.size()); }

  // Volume of the air in muscle i  [m^3], and its mass at this pressure and length [kg].
  double volume(int i, double length) const noexcept;
  double mass_at(int i, double pressure, double length) const noexcept {
    return density(pressure) * volume(i, length);
  }

  // All muscles at one absolute pressure and at rest, air at the wall's temperature.
  State initial(double pressure, const Lanes& length, double travel) const;

  // All valves without current since ever, all set points at the atmosphere's pressure.
  Valves valves_at_rest() const;

  // Meshes that have stood at this pressure and length for long; the series stand on no base yet.
  Memory memory_at_rest(double pressure, const Lanes& length) const;

  // Chambers and hoses of the muscles, and of a single-acting cylinder, filled to one absolute
  // pressure, air at the wall's temperature: what an ideal regulator does.
  void hold(double pressure, const Lanes& length, double travel, State& state) const noexcept;

  // Sets the rates of what hold() sets to 0: it does not move by itself.
  void hold_still(Answer& look) const noexcept;

  // Air in the machine: chambers, hoses and tank  [kg]. What it loses has left through an exhaust
  // or a leak.
  double total_mass(const State& state, double travel) const noexcept;

  // An electrical edge of a valve at t, or a regulator's set point from t on, not before the last
  // node. `at_node`: the look at that node, for delays and failures that depend on the pressure
  // difference.
  void command(const signals::Edge& edge, double t, const Answer& at_node,
               Valves& valves) const noexcept;

  // At a node: valves, set points and faults move to t. `before`: the look at the last node, for
  // the delay of a shutter that a fault lets go.
  void move_valves(double t, const Answer& before, Valves& valves) const noexcept {
    if (valves.next_change <= t) move(t, before, valves);
  }

  // Share of the valve's area that is open at t  [-].
  double open_share(int valve, double t, const Valves& valves) const noexcept;

  // Does anything flow, warm or creep, or can it without a valve that moves?
  bool flowing(const Valves& valves) const noexcept {
    return restless_ || ramping_ || valves.open_count > 0 || valves.leaking;
  }

  // The law itself; t matters only to valves that ramp. `ahead`: muscles that go by a course, a bit
  // each: their flows are nobody's affair.
  void evaluate(double t, const Ends& ends, const State& state, const Valves& valves,
                const Memory& memory, Answer& out, std::uint64_t ahead = 0) const noexcept;

  // At a node, with the look at it: the references of the series follow, the plays of the
  // hysteresis move on. Looks between two nodes go by the last one, exactly as long as a pressure
  // does not turn between them. Answers what of the air is no number.
  Failure remember(const Answer& look, const State& state, Memory& memory) const noexcept;

  // Muscles that always have a course while air flows: behind hoses that hold air and, while
  // nothing is broken, behind regulators that are quick at any length.
  std::uint64_t always_ahead(const Valves& valves) const noexcept {
    return valves.broken ? behind_hoses_ : behind_hoses_ | behind_regulators_;
  }

  // At the beginning of a step of length h, or of a look so far ahead.
  void plan(double t, double h, const Ends& ends, const State& state, const Valves& valves,
            const Memory& memory, Course& course) const noexcept;

  // The stages of RK4: the state, h along the rates of one look, what has passed since the start
  // apart (`out` is another one than `from`); and the state, by the weighted mean of four looks.
  // What has a course goes by it.
  void move(State& out, const State& from, double h, const Answer& look, const Valves& valves,
            const Course& course) const noexcept;
  void finish(State& state, double h, const Answer* const (&look)[4], const Valves& valves,
              const Course& course) const noexcept;

  // The second half of Heun's rule, for a peek; move() is the first.
  void correct(State& out, const State& from, double h, const Answer& before, const Answer& after,
               const Valves& valves, const Course& course) const noexcept;

  // Returns the air of muscle i, and what has passed its valves and leaks since the start  [kg].
  Account account(const State& s, int i) const noexcept {
    return {.mass = s.mass[i], .in = s.in[i], .out = s.out[i], .leak = s.leak[i]};
  }
  // Pressure behind the valves of muscle i: its own, or that before a hose  [Pa].
  double manifold(const Answer& a, int i, const Valves& valves) const noexcept {
    return line(i).more || valves.broken ? a.manifold[i] : a.pressure[i];
  }
  double leak(const Answer& a, int i, const Valves& valves) const noexcept {  // [kg/s]
    return line(i).more || valves.broken ? a.leak[i] : 0.0;
  }
  Account cylinder_account(const State& s, int side) const noexcept {
    const auto c = static_cast<std::size_t>(side);
    const int mass = sides_[c].mass;
    return {
        .mass = mass != none ? other(s, mass) : 0.0, .in = s.piston_in[c], .out = s.piston_out[c]};
  }
  double cylinder_pressure(const Answer& a, int side) const noexcept {  // [Pa]
    return a.cylinder_pressure[static_cast<std::size_t>(side)];
  }
  // `past_tank`: what the supply has given while a fault had cut it from its tank; below 0 it has
  // taken more.
  SupplyState supply_state(const State& s, const Answer& a) const noexcept {
    return {a.supply_pressure, a.tank_pressure, cut_ == none ? 0.0 : other(s, cut_)};
  }

  // RK4 is stable up to this step: the fastest chamber, lag or wall that an option adds, or
  // infinity [s]. Without a place, wherever the piston stands. With one, muscles that never seal
  // are in it too: behind a regulator or a hose's chamber, or with a leak. Muscles behind shutters
  // are not.
  double longest_step() const noexcept;
  double longest_step(const Ends& ends, const Valves& valves) const noexcept;

  // Returns the same for what goes through no step ahead of the body: warm walls, lags, creep, and
  // what leaks behind a hose that holds no air.
  double longest_step_of_rest(const Ends& ends, const Valves& valves) const noexcept;

  // Returns the longest step in which the air of the cylinder's chambers changes little: its
  // spring, gamma P A^2/V, moves the body by half a radian at most, and the piston takes an eighth
  // of the room that it leaves. As a chamber vanishes both grow without bound; infinite without
  // chambers. `lift_per_force`: acceleration of the body per force of the piston [1/kg].
  double longest_step_of_piston(const Ends& ends, const Answer& look,
                                double lift_per_force) const noexcept;

 private:
  static constexpr int none = -1;
  using Cell = typename Course::Cell;

  // One valve, or regulator, and what it lets through.
  struct Tap {
    gas::Valve valve;
    gas::FlowConstants flow;
    int outlet = none;    // Kind::regulator: state of its outlet pressure
    bool listed = false;  // the flow is that of the open share alone
  };
  // A line lies between a muscle's valves and its air; its numbers stand among the others there.
  struct Line {
    int energy = none, hose = none, hose_energy = none;  // no hose's mass: it holds no air
    bool resists = false, more = false;                  // a hose; more than valves
    gas::HoseConstants hose_flow;
    gas::LeakConstants leak;
    bool plays = false;                                          // it has hysteresis
    std::array<int, actuator::Creep::most> late = {none, none};  // of the creep
    double settling = 0;  // n R T times the slope of what never shuts; 0: all of it does [m^3/s]
  };
  struct Slot {
    int mass = none, energy = none;
  };
  struct Chamber {
    double pressure = 0, y = 0, temperature = 0;
  };
  struct Flows {
    double in = 0, out = 0;  // from the supply, to the room [kg/s]
  };
  // The flows of one look go by these, beside the chambers.
  struct Now {
    double t;         // [s]
    double y_supply;  // of the line to the inlets
    const State& state;
    const Valves& valves;
    const Memory& memory;
    std::uint64_t ahead = 0;  // muscles whose flows are not asked for
  };
  // The flows through a pair of valves, their slopes over y and their drift at one y.
  struct Flowing {
    double in = 0, out = 0;                  // [kg/s]
    double in_by = 0, out_by = 0;            // [kg/s]
    double in_by_time = 0, out_by_time = 0;  // [kg/s^2]
  };
  // A volume that changes steadily within a step.
  struct Room {
    double volume = 0, rate = 0;  // [m^3], [m^3/s]
  };
  // The line to the inlets.
  struct Inlets {
    double y = 1;
    bool cut = false;  // a fault has cut it from its tank
  };
  struct Broken {
    gas::LeakConstants leak;
    double y = 1;  // of the supply's line
  };

  static double other(const State& s, int i) noexcept {
    return s.other[static_cast<std::size_t>(i)];
  }
  static double& other(State& s, int i) noexcept { return s.other[static_cast<std::size_t>(i)]; }
  static double& rate(Answer& a, int i) noexcept { return a.rate[static_cast<std::size_t>(i)]; }
  const Muscle& muscle(int i) const noexcept { return muscles_[static_cast<std::size_t>(i)]; }
  const Line& line(int i) const noexcept { return lines_[static_cast<std::size_t>(i)]; }

  // network_setup.h
  void add_muscle(const Muscle& muscle);
  void add_memory(int i);
  void add_cylinder();
  void add_tap(const gas::Valve& valve);
  void classify();
  void limit_step();
  double fastest_slope(int inlet) const;
  double hose_slope(const Line& line) const;
  bool always_quick(int i) const;
  double density(double pressure) const noexcept;
  void fill(const Slot& slot, double mass, State& state) const noexcept;

  // network_valves.h
  double difference(int valve, const Answer& at_node, const Valves& valves) const noexcept;
  double fraction(std::size_t valve, double t, const Valves& valves) const noexcept;
  void look_ahead(Valves& valves) const noexcept;
  void move(double t, const Answer& before, Valves& valves) const noexcept;
  void refresh(double t, Valves& valves) const noexcept;

  // network_flows.h
  Inlets inlets(const State& state, const Valves& valves, const Memory& memory,
                Answer& out) const noexcept;
  double line_of_tank(const State& state, const Memory& memory, Answer& out) const noexcept;
  void one_by_one(const Ends& ends, const State& state, const Memory& memory, Answer& out,
                  Lanes& y) const noexcept;
  double smooth_tension(int i, double length, double rate, double gauge, const State& state,
                        const Memory& memory, Answer& out) const noexcept;
  void pull(int i, double length, double rate, double pressure, const State& state,
            const Memory& memory, Answer& out) const noexcept;
  void open_taps(double t, double y_supply, const Lanes& y, const Valves& valves,
                 Answer& out) const noexcept;
  Flows through(int inlet, const Now& now, double y) const noexcept;
  bool shut(int inlet, const Now& now) const noexcept;
  Flows series(int i, const Now& now, const Chamber& c, Answer& out) const noexcept;
  Chamber hose(int i, const Now& now) const noexcept;
  void run_line(int i, const Now& now, const Ends& ends, const Chamber& c,
                Answer& out) const noexcept;
  void run_options(const Now& now, bool cut, const Ends& ends, const Lanes& y,
                   Answer& out) const noexcept;
  void run_cylinder(const Now& now, const Ends& ends, Answer& out) const noexcept;
  void run_supply(const Now& now, bool cut, Answer& out) const noexcept;
  double enthalpy(double flow, double from, double to) const noexcept;
  double warming(int energy, double mass, const State& state, double gained,
                 double work) const noexcept;
  template <class Mean>
  void add(State& out, const State& from, Mean mean, const Valves& valves,
           const Course& course) const noexcept;
  template <class Mean>
  void add_course(State& out, Mean mean, const Course& course) const noexcept;
  template <class Visit>
  void each_line(const Valves& valves, Visit visit) const noexcept;

  // network_quick.h
  Flowing sloped_through(int inlet, const Now& now, double since_node, double y,
                         bool sloped) const noexcept;
  gas::SlopedFlow sloped_leak(int i, const Now& now, double y) const noexcept;
  bool goes_ahead(int cell, double h, const Ends& ends, const Valves& valves) const noexcept;
  template <int Openings>
  void run_ahead(const Now& node, double h, const Room& room, const gas::Base& base, double mass,
                 Cell& cell) const noexcept;
  void run_hose_ahead(const Now& node, double h, const Room& room, Cell& cell) const noexcept;
  void run_muscle_ahead(const Now& node, double h, const Ends& ends, Cell& cell) const noexcept;
  void go_beside(int first, const Now& node, double h, const Ends& ends,
                 RegulatorLanes::Ahead& ahead) const noexcept;

  // network_faults.h
  void add_faults();
  void change(const AirFault& fault, bool begins, double t, const Answer& before,
              Valves& valves) const noexcept;
  bool let_through(const ActingFaults& faults) const noexcept;
  bool is_broken(const ActingFaults& faults) const noexcept;
  double past_seat(int valve, const Now& now, double y_from, double y_to) const noexcept;
  double through_holes(int i, const Now& now, double y) const noexcept;
  bool blocked(int i, const Valves& valves) const noexcept;
  double failed_line(const Valves& valves, Answer& out) const noexcept;
  double slope_of_faults(int pair, const ActingFaults& faults) const noexcept;

  int size_ = 0, others_ = 0;
  gas::Air air_;
  gas::Supply supply_;
  double supply_y_ = 0;                      // of its set pressure
  gas::PowerSeries of_pressure_{1.0 / 7.0};  // y of a pressure
  std::vector<Muscle> muscles_;
  BraidLanes braids_;
  RegulatorLanes regulators_;
  bool in_lanes_ = false;  // all muscles go by braids_
  bool plain_ = false;     // there is nothing but muscles between valves on a constant supply
  std::optional<Cylinder> cylinder_;

  std::vector<Tap> taps_;
  std::vector<Line> lines_;
  std::vector<int> more_;      // the muscles whose line is more than valves
  std::array<Slot, 2> sides_;  // of the cylinder
  std::vector<int> lagging_;   // regulators whose outlet is a state: their valves
  std::vector<int> held_;      // the others that hold() sets
  int tank_ = none;
  bool ramping_ = false, restless_ = false;
  FaultSchedule faults_;
  std::vector<Broken> broken_;  // by each fault
  int cut_ = none;              // state: air from a line that is cut from its tank
  double spring_ = 0;           // n R T: a chamber of volume V follows a slope G at n R T G/V
  double lag_rate_ = 0;         // of the quickest lag or creep [1/s]
  double longest_step_ = 0;     // of all that has the same rate wherever the machine stands [s]
  std::array<double, 2> side_settling_{};  // of the cylinder's chambers, as a line's [m^3/s]
  std::uint64_t behind_hoses_ = 0, behind_regulators_ = 0;  // that always go ahead
  std::uint64_t beside_ = 0;                                // that go ahead by regulators_
  bool settles_ = false;                                    // a line has `settling`
};

extern template class AirNetwork<4>;
extern template class AirNetwork<8>;
extern template class AirNetwork<48>;

}  // namespace sinew::air
