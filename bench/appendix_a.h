// bench/appendix_a.h - the program of appendix A of the thesis for the test stand, as printed: an
// actuator on a 3-way valve at 25 Hz that lifts 5 lb from 3.4 in. Names, constants and order of
// operations are unchanged; its output is omitted, and the step is an argument.
//
// Its units are in, in/s, psia, slugs and lbf. It uses global variables, so it can only be used by
// one thread at a time.
#pragma once

#include <array>

namespace sinew::bench {

inline constexpr int appendix_a_milliseconds = 2000;

// Simulates two seconds with `steps_per_ms` steps in each millisecond; the period of the valve is
// 40 ms. Writes the length [in] at the end of each of appendix_a_milliseconds to `length`.
void appendix_a(int steps_per_ms, double* length);

// Right-hand side of its equations, for other integrators: length, speed, pressure and mass.

std::array<double, 4> appendix_a_start();

// `valve`: 1 to the supply, 2 to the room. `side`: direction of the dry friction, 1 while the load
// moves down and -1 while it moves up, instead of the sign of the speed; 0 at rest.
void appendix_a_rates(int valve, int side, const double* x, double* rates);

struct AppendixFriction {
  double bound = 0;       // of the dry friction [lbf]
  double unbalanced = 0;  // force on a load at rest, down > 0 [lbf]
};
AppendixFriction appendix_a_friction(const double* x);

}  // namespace sinew::bench
