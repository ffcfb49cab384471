// bench/peers/drill.h - workload for comparing actuators: muscles that are stretched and released
// by a given motion while their valves are pulsed, with different pulses in every period and
// muscle.
//
//   L = rest + 2 mm sin(2 pi 1.5 Hz t)      pulses of 0 to 6 ms every 10 ms, in or out, with whole
//                                           ticks for edges and no delay
#pragma once

#include <cstdint>
#include <vector>

#include "sinew/air/muscle.h"
#include "sinew/gas/air.h"
#include "sinew/gas/supply.h"

namespace sinew::bench {

inline constexpr int drill_machines = 8, drill_muscles = 4;  // of each machine
inline constexpr int drill_ticks = 5000;                     // of 100 us

// At the start of a tick, one valve.
struct Switching {
  int tick = 0;
  int machine = 0, muscle = 0;
  bool exhaust = false, open = false;
};

struct Drill {
  air::Muscle muscle;  // the same for all; ideal valves
  gas::Air air;
  gas::Supply supply;
  double rest = 0;   // [m]
  double start = 0;  // absolute pressure [Pa]
  int parts = 1;     // steps per tick
  int stride = 1;    // ticks per step, unless a valve switches earlier; requires parts == 1
  std::vector<double> stroke;         // L - rest by half steps, from 0 on [m]
  std::vector<double> speed;          // its rate [m/s]
  std::vector<Switching> switchings;  // ascending in tick
};

// Returns a drill of the leg's muscles.
Drill drill(int parts, int stride = 1);

// Pressures [Pa] by machine, muscle and sample, the sample varying fastest. Every stride divides
// the interval between two samples.
using Pressures = std::vector<double>;
inline constexpr int drill_sampling = 50;  // [ticks]
inline constexpr int drill_samples = drill_ticks / drill_sampling;

// Counts of an implementation of the drill over all muscles.
struct Counts {
  double steps = 0;      // of single muscles
  double seconds = 0;    // simulated, of all muscles together
  double divisions = 0;  // of packs, or of doubles, in the steps' laws
  double roots = 0;
};
Counts by_pow(const Drill& drill, Pressures* pressures);  // scalar, pow_muscle.h
Counts by_network(const Drill& drill,
                  Pressures* pressures);  // air/network.h, one machine after the other

// One width of air/plain_air.h, in a library that is compiled for it, so that code for wide
// registers is not linked into code for other processors.
struct Wide {
  int width = 0;
  Counts (*run)(const Drill& drill, Pressures* pressures) = nullptr;
  // Computes so many independent divisions and square roots of packs.
  double (*divide)(std::int64_t divisions, std::int64_t roots) = nullptr;
};

[[gnu::visibility("default")]] Wide wide_2();
[[gnu::visibility("default")]] Wide wide_4();
[[gnu::visibility("default")]] Wide wide_8();

// Returns the widths that this processor supports, the narrowest first.
std::vector<Wide> widths();

}  // namespace sinew::bench
