// muscle/plumbing.h - the air half of a machine whose air does more than a bank's: a tank that
// empties, hoses that resist, walls that warm, leaks, regulators, an air cylinder. And for meshes
// that remember: hysteresis and creep.
//
// Like a bank it is constant and is asked in every stage; whoever integrates owns the state, and
// the valves, which stay what they are between two nodes:
//
//   lengths, rates, state  ->  tensions, pressures, flows, and the state's derivative
//
// The content of the state depends on what is switched on: the muscles' masses come first. Muscles
// go by braid_lanes.h where it holds them and no wall is warm, else by one power and
// actuator/tension.h each; with nothing switched on it says what the bank says. The laws:
// gas/orifice.h, series.h, hose.h, leak.h, heat.h, supply.h, regulator.h, cylinder.h,
// actuator/hysteresis.h, creep.h.
//
//   order   electrical, level ... at t, from the look at the last node
//           node(t) at next_change() and wherever the integrator wants one, then evaluate, and
//           remember what the look at the node says
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sinew/gas/air.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/orifice.h"
#include "sinew/gas/supply.h"
#include "sinew/muscle/bank.h"
#include "sinew/muscle/cylinder.h"
#include "sinew/muscle/fault.h"
#include "sinew/muscle/muscle.h"

namespace sinew::muscle {

inline constexpr int max_air_states = 72;

// Only the first states() are used. Not set when made: `AirState x{}` is zero. The reference is
// what the pressures' series stands on; it moves at nodes alone.
struct AirState {
  std::array<double, max_air_states> of;
  Reference reference;

  double& operator[](int i) { return of[static_cast<std::size_t>(i)]; }
  double operator[](int i) const { return of[static_cast<std::size_t>(i)]; }
};

// Pull's `drift` is 0 where lanes do not hold. Pairs of the cylinder: up, down.
struct AirPull : Pull {
  Lanes leak;      // out of the muscle to the atmosphere [kg/s]
  Lanes manifold;  // pressure between valves and hose; the muscle's own without a hose [Pa]
  Lanes play;      // state of the hysteresis, where there is one [Pa]

  double cylinder_force = 0;  // on the body, up > 0 [N]
  std::array<double, 2> cylinder_pressure{}, cylinder_inflow{}, cylinder_outflow{};  // [Pa] [kg/s]

  double supply_pressure = 0;  // of the line to the inlets, absolute [Pa]
  double tank_pressure = 0;    // the line's without a tank [Pa]
};

// Is there anything that a bank cannot do?
bool needs_plumbing(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
                    const std::optional<Cylinder>& cylinder, std::span<const AirFault> faults = {});

class Plumbing {
 public:
  // Valves and regulators: where they are. Copied like bytes.
  struct Valves {
    struct Valve {
      gas::Shutter shutter;
      double share = 0;                      // of its area that is open
      double set = 0;                        // set point of a regulator in force [Pa]
      double next_set = 0, next_set_at = 0;  // and the one to come [Pa], [s]
    };
    std::array<Valve, 2 * capacity + 4> of;
    int open_count = 0;
    ActingFaults faults;
    bool leaking = false;    // some fault lets air through although every valve is shut
    double next_change = 0;  // instant at which a valve, a set point or a fault changes, or
                             // infinity [s]

    Valve& operator[](std::size_t v) { return of[v]; }
    const Valve& operator[](std::size_t v) const { return of[v]; }
  };

  // Throws std::invalid_argument for more than `capacity` muscles, and for a cylinder with valves
  // whose chambers vanish at a stop.
  Plumbing(std::span<const Muscle> muscles, const gas::Air& air, const gas::Supply& supply,
           const std::optional<Cylinder>& cylinder = {}, std::span<const AirFault> faults = {});

  int muscles() const { return size_; }
  int states() const { return states_; }
  double atmosphere() const { return air_.atmosphere; }  // [Pa]

  // 2 x muscle + (0 inlet | 1 exhaust), then the cylinder's: up inlet, up exhaust, down inlet, down
  // exhaust.
  int valves() const { return static_cast<int>(taps_.size()); }

  // All muscles at one absolute pressure and at rest, air at the wall's temperature.
  AirState initial(double pressure, const Lanes& length, double travel) const;

  // All valves without current since ever, all set points at the atmosphere's pressure.
  Valves valves_at_rest() const;

  // Chambers and hoses of the muscles, and of a single-acting cylinder, filled to one absolute
  // pressure, air at the wall's temperature: what an ideal regulator does.
  void hold(double pressure, const Lanes& length, double travel, AirState& state) const noexcept;

  // The first of the states: what hold() sets is among these.
  int held_states() const { return held_states_; }

  // Air in the machine: chambers, hoses and tank  [kg]. What it loses has left through an exhaust
  // or a leak.
  double total_mass(const AirState& state, double travel) const;

  // Air that a supply has given since the start while a fault had cut it from its tank; below 0 it
  // has taken more  [kg].
  double given_past_tank(const AirState& state) const { return cut_ == none ? 0.0 : state[cut_]; }

  // An electrical edge of a valve at t, not before the last node. `at_node`: the look at that node,
  // for delays and failures that depend on the pressure difference.
  void electrical(int valve, double t, bool open, const AirPull& at_node,
                  Valves& valves) const noexcept;

  // Set point of a regulator from t on, as a share 0..1 of its range; not before the last node.
  void level(int valve, double t, double share, Valves& valves) const noexcept;

  // At a node: valves, set points and faults move to t. `before`: the look at the last node, for
  // the delay of a shutter that a fault lets go.
  void node(double t, const AirPull& before, Valves& valves) const noexcept {
    if (valves.next_change <= t) move(t, before, valves);
  }

  // The law itself; t matters only to valves that ramp.
  void evaluate(double t, const Lanes& length, const Lanes& rate, double travel, double travel_rate,
                const AirState& state, const Valves& valves, AirPull& out,
                AirState& derivative) const noexcept;

  // At a node, with the look at it: the reference of the pressures follows, the plays of the
  // hysteresis move on. Looks between two nodes go by the last one, exactly as long as a pressure
  // does not turn between them.
  void remember(const AirPull& at_node, AirState& state) const noexcept {
    if (in_lanes_) braids_.follow(at_node.drift, state.reference);
    for (int i = 0; i < size_ && plays_; ++i)
      if (const int play = lines_[static_cast<std::size_t>(i)].play; play != none)
        state[play] = at_node.play[i];
  }

  // Nothing flows, warms or creeps: the derivative is all zero until the next change.
  bool quiet(const Valves& valves) const noexcept {
    return !restless_ && !ramping_ && valves.open_count == 0 && !valves.leaking;
  }

  // Share of the valve's area that is open at t  [-].
  double open_share(int valve, double t, const Valves& valves) const noexcept;

  // RK4 is stable up to this step: the fastest chamber, lag or wall that an option adds, or
  // infinity [s]. Without a place, wherever the piston stands. With one, muscles that never seal
  // are in it too: behind a regulator or a hose's chamber, or with a leak. Muscles behind shutters
  // are not.
  double longest_step() const noexcept;
  double longest_step(const Lanes& length, double travel, const Valves& valves) const noexcept;

 private:
  static constexpr int none = -1;

  // One valve, or regulator, and what it lets through.
  struct Tap {
    gas::Valve valve;
    gas::FlowConstants flow;
    int outlet = none;  // Kind::regulator: state of its outlet pressure
  };
  // One body of air and where its numbers stand in the state.
  struct Slot {
    int mass = none, energy = none;
  };
  struct Line {
    Slot chamber, hose;  // no hose's mass: it holds no air
    bool resists = false;
    gas::HoseConstants hose_flow;
    gas::LeakConstants leak;
    int play = none;                                             // of the hysteresis
    std::array<int, actuator::Creep::most> late = {none, none};  // of the creep
    double settling = 0;  // n R T times the slope of what never shuts; 0: all of it does [m^3/s]
  };
  struct Chamber {
    double pressure = 0, y = 0, temperature = 0;
  };
  struct Flows {
    double in = 0, out = 0;  // from the supply, to the room [kg/s]
  };

  void add_muscle(const Muscle& muscle);
  void add_memory(int i);
  void add_cylinder();
  void add_tap(const gas::Valve& valve);
  Slot add_chamber();
  void limit_step();
  double fastest_slope(int inlet) const;
  double hose_slope(const Line& line) const;
  double volume(int i, double length) const noexcept;
  double density(double pressure) const noexcept;

  void rest(int i, double gauge, double length, AirState& state) const;
  void fill(const Slot& slot, double mass, AirState& state) const noexcept;
  Chamber chamber(const Slot& slot, double volume, const AirState& state) const noexcept;
  double smooth_tension(int i, double length, double rate, double gauge, const AirState& state,
                        AirPull& out, AirState& derivative) const noexcept;
  void pull(int i, double length, double rate, double pressure, const AirState& state, AirPull& out,
            AirState& derivative) const noexcept;
  // What the flows of one look go by, beside the chambers.
  struct Now {
    double t;         // [s]
    double y_supply;  // of the line to the inlets
    const AirState& state;
    const Valves& valves;
  };
  Flows through(int inlet, const Now& now, double y) const noexcept;
  bool shut(int inlet, const Now& now) const noexcept;
  Flows series(int i, const Now& now, const Chamber& c, AirPull& out) const noexcept;
  Flows buffered(int i, const Now& now, const Chamber& h, const Chamber& c, double passed,
                 AirPull& out, AirState& derivative) const noexcept;
  void line(int i, const Now& now, double length, double rate, const Chamber& c, AirPull& out,
            AirState& derivative) const noexcept;
  void cylinder(const Now& now, double travel, double travel_rate, AirPull& out,
                AirState& derivative) const noexcept;
  double enthalpy(double flow, double from, double to) const noexcept;
  void warm(const Slot& slot, const AirState& state, double gained, double work,
            AirState& derivative) const noexcept;
  double difference(int valve, const AirPull& at_node) const noexcept;
  double fraction(std::size_t valve, double t, const Valves& valves) const noexcept;
  void look_ahead(Valves& valves) const noexcept;
  void move(double t, const AirPull& before, Valves& valves) const noexcept;
  void refresh(double t, Valves& valves) const noexcept;

  // plumbing_faults.cpp
  void add_faults();
  void change(const AirFault& fault, bool begins, double t, const AirPull& before,
              Valves& valves) const noexcept;
  bool let_through(const ActingFaults& faults) const noexcept;
  double past_seat(int valve, const Now& now, double y_from, double y_to) const noexcept;
  double through_holes(int i, const Now& now, double y) const noexcept;
  bool blocked(int i, const Valves& valves) const noexcept;
  double failed_line(const Valves& valves, AirPull& out) const noexcept;
  double slope_of_faults(int pair, const ActingFaults& faults) const noexcept;

  void muscles_in_lanes(const Lanes& length, const Lanes& rate, const AirState& state, AirPull& out,
                        Lanes& y) const noexcept;

  int size_ = 0, states_ = 0, held_states_ = 0;
  gas::Air air_;
  gas::Supply supply_;
  double supply_y_ = 0;  // of its set pressure
  std::vector<Muscle> muscles_;
  BraidLanes braids_;
  bool in_lanes_ = false;  // all muscles go by braids_
  std::optional<Cylinder> cylinder_;

  std::vector<Tap> taps_;
  std::vector<Line> lines_;
  std::array<Slot, 2> sides_;  // of the cylinder
  int tank_ = none;
  bool ramping_ = false, restless_ = false;
  FaultSchedule faults_;
  struct Broken {
    gas::LeakConstants leak;
    double y = 1;  // of the supply's line
  };
  std::vector<Broken> broken_;  // by each fault
  int cut_ = none;              // state: air from a line that is cut from its tank
  double spring_ = 0;           // n R T: a chamber of volume V follows a slope G at n R T G/V
  double longest_step_ = 0;     // of all that has the same rate wherever the machine stands [s]
  std::array<double, 2> side_settling_{};  // of the cylinder's chambers, as a line's [m^3/s]
  bool settles_ = false;                   // a line has `settling`
  bool plays_ = false;                     // a line has a `play`
};

}  // namespace sinew::muscle
