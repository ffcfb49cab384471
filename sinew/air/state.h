// air/state.h - state, memory and results of an air network; network.h describes their use.
#pragma once

#include <array>
#include <cstdint>

#include "sinew/air/fault.h"
#include "sinew/air/lanes.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/power_series.h"

namespace sinew::air {

// Air of one chamber: its mass, and the masses that have passed since the start [kg].
struct Account {
  double mass = 0, in = 0, out = 0, leak = 0;
};

// Absolute pressures of the supply [Pa], and the mass that it has delivered while a fault had cut
// it from its tank [kg].
struct SupplyState {
  double line = 0, tank = 0, past_tank = 0;
};

// States other than the muscles' masses: energies, hoses, creep, regulators, cylinder, tank,
// faults.
template <int Most>
inline constexpr int most_others = 6 * Most + 10;

template <int Most>
struct AirState {
  Lanes<Most> mass;           // air in the muscles [kg]
  Lanes<Most> in, out, leak;  // through their valves and holes since the start [kg]
  std::array<double, 2> piston_in{}, piston_out{};  // for the cylinder: up, down [kg]
  std::array<double, most_others<Most>> other;      // the first others() are used
};

// Positions of the valves and regulators.
template <int Most>
struct AirValves {
  // A valve until the next node.
  struct Valve {
    gas::Shutter shutter;
    double share = 0;                      // open share of its area
    double set = 0, set_y = 0;             // active set point of a regulator [Pa], and its y
    double next_set = 0, next_set_at = 0;  // next set point [Pa], and its time [s]
  };
  // A valve that is open, with its share.
  struct Open {
    int valve = 0;
    double share = 0;  // open share of its area
  };
  std::array<Valve, 2 * Most + 4> of;
  std::array<double, 2 * Most + 4> next_of;  // next_change for each valve [s]
  std::array<Open, 2 * Most + 4> open;       // those that pass air: the first open_count entries
  int open_count = 0;
  ActingFaults faults;
  bool leaking = false;    // a fault passes air although every valve is shut
  bool broken = false;     // a fault is active that is more than a share of a valve's area
  double next_change = 0;  // instant at which a valve, a set point or a fault changes, or
                           // infinity [s]

  Valve& operator[](std::size_t v) { return of[v]; }
  const Valve& operator[](std::size_t v) const { return of[v]; }
};

// Values that evaluations between two nodes use in addition to the valves.
template <int Most>
struct AirMemory {
  Reference<Most> reference;                   // base of the muscles' densities
  Lanes<Most> play;                            // state of the hysteresis [Pa]
  std::array<gas::Base, Most> hose;            // bases of the hoses' densities
  std::array<gas::Base, 2> side;               // bases of the cylinder's chambers
  std::array<gas::Base, 2 * Most + 4> outlet;  // bases of the regulators' pressures
  gas::Base line;                              // base of the supply's pressure
};

// Pairs of the cylinder: up, down. Values of lines with more than valves are set only for those
// lines.
template <int Most>
struct AirEvaluation : Pull<Most> {
  Lanes<Most> inflow;    // supply to muscle [kg/s]
  Lanes<Most> outflow;   // muscle to atmosphere [kg/s]
  Lanes<Most> gain;      // d(mass)/dt of a line with more than valves [kg/s]
  Lanes<Most> leak;      // leak of the muscle, of such a line [kg/s]
  Lanes<Most> manifold;  // pressure between valves and hose, of such a line [Pa]
  Lanes<Most> play;      // state of the hysteresis [Pa]

  double cylinder_force;  // on the body, up > 0 [N]
  std::array<double, 2> cylinder_pressure, cylinder_inflow, cylinder_outflow;  // [Pa] [kg/s]
  std::array<double, 2> cylinder_density;                                      // [kg/m^3]

  double supply_pressure;                      // absolute pressure of the line to the inlets [Pa]
  double tank_pressure;                        // the line's pressure if there is no tank [Pa]
  std::array<double, most_others<Most>> rate;  // d(other)/dt
};

// Bodies of air that are quicker than a step, integrated ahead of the body: quick_bodies.h.
template <int Most>
struct AirQuickMasses {
  struct Cell {
    int of;                // a muscle, or muscles() + side of the cylinder
    double half, full;     // its mass at the half and at the end of the step [kg]
    double hose;           // mass in its hose at the end [kg]
    double in, out, leak;  // within the step [kg]
  };

  int count = 0;
  std::uint64_t muscles = 0;  // those of the cells, a bit each
  double step = 0;            // [s]
  bool cut = false;           // a fault has cut the inlets from their tank
  std::array<Cell, Most + 2> cells;
};

}  // namespace sinew::air
