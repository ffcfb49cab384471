// air/state.h - what an air network keeps and returns; network.h has how it is used.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/air/fault.h"
#include "sinew/air/lanes.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/power_series.h"

namespace sinew::air {

// Air of one chamber: what is there, and what has passed since the start  [kg].
struct Account {
  double mass = 0, in = 0, out = 0, leak = 0;
};

// Pressures of the supply, absolute  [Pa], and what it has given while a fault had cut it from its
// tank [kg].
struct SupplyState {
  double line = 0, tank = 0, past_tank = 0;
};

// States beside the muscles' masses: energies, hoses, creep, regulators, cylinder, tank, faults.
template <int Most>
inline constexpr int most_others = 6 * Most + 10;

template <int Most>
struct AirState {
  Lanes<Most> mass;           // of the muscles [kg]
  Lanes<Most> in, out, leak;  // through their valves and holes since the start [kg]
  std::array<double, 2> piston_in{}, piston_out{};  // the same of the cylinder: up, down [kg]
  std::array<double, most_others<Most>> other;      // the first others() are used
};

// Where the valves and regulators are.
template <int Most>
struct AirValves {
  // A valve until the next node.
  struct Valve {
    gas::Shutter shutter;
    double share = 0;                      // of its area that is open
    double set = 0, set_y = 0;             // set point of a regulator in force [Pa]
    double next_set = 0, next_set_at = 0;  // and the one to come [Pa], [s]
  };
  // A valve that is open, and how far.
  struct Open {
    int valve = 0;
    double share = 0;  // of its area
  };
  std::array<Valve, 2 * Most + 4> of;
  std::array<Open, 2 * Most + 4> open;  // those that let air through: open_count of them
  int open_count = 0;
  ActingFaults faults;
  bool leaking = false;    // some fault lets air through although every valve is shut
  bool broken = false;     // some fault acts that is more than a share of a valve's area
  double next_change = 0;  // instant at which a valve, a set point or a fault changes, or
                           // infinity [s]

  Valve& operator[](std::size_t v) { return of[v]; }
  const Valve& operator[](std::size_t v) const { return of[v]; }
};

// Looks between two nodes go by this, beside the valves.
template <int Most>
struct AirMemory {
  Reference<Most> reference;                   // of the muscles' densities
  Lanes<Most> play;                            // of the hysteresis, where there is one [Pa]
  std::array<gas::Base, Most> hose;            // of the hoses' densities
  std::array<gas::Base, 2> side;               // of the cylinder's chambers
  std::array<gas::Base, 2 * Most + 4> outlet;  // of the regulators' pressures
  gas::Base line;                              // of the supply's pressure
};

// Pairs of the cylinder: up, down. Those of a line with more than valves are set only there.
template <int Most>
struct AirAnswer : Pull<Most> {
  Lanes<Most> inflow;    // from the supply [kg/s]
  Lanes<Most> outflow;   // to the atmosphere [kg/s]
  Lanes<Most> gain;      // d(mass)/dt of a line with more than valves [kg/s]
  Lanes<Most> leak;      // out of the muscle to the atmosphere, of such a line [kg/s]
  Lanes<Most> manifold;  // pressure between valves and hose, of such a line [Pa]
  Lanes<Most> play;      // state of the hysteresis, where there is one [Pa]

  double cylinder_force;  // on the body, up > 0 [N]
  std::array<double, 2> cylinder_pressure, cylinder_inflow, cylinder_outflow;  // [Pa] [kg/s]
  std::array<double, 2> cylinder_density;                                      // [kg/m^3]

  double supply_pressure;                      // of the line to the inlets, absolute [Pa]
  double tank_pressure;                        // the line's without a tank [Pa]
  std::array<double, most_others<Most>> rate;  // d(other)/dt
};

// Air that is quicker than a step goes through it ahead of the body: quick_bodies.h.
template <int Most>
struct AirCourse {
  struct Cell {
    int of;                // a muscle, or muscles() + a side of the cylinder
    double half, full;     // its mass at the half and at the end of the step [kg]
    double hose;           // mass in its hose at the end [kg]
    double in, out, leak;  // within the step [kg]
  };

  int count = 0;
  std::uint64_t muscles = 0;  // among them, a bit each
  double step = 0;            // [s]
  bool cut = false;           // a fault has cut the inlets from their tank
  std::array<Cell, Most + 2> cells;
};

}  // namespace sinew::air
