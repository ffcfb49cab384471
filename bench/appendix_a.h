// bench/appendix_a.h - the thesis's own program of the test stand, appendix A, as it is printed:
// an actuator on a 3-way valve at 25 Hz that lifts 5 lb from 3.4 in. Its names, constants and order
// of operations; without what it prints, and with the step as an argument.
//
// Its numbers are in and in/s, psia, slugs and lbf. It keeps them in variables of its own: one
// thread at a time.
#pragma once

#include <array>

namespace sinew::bench {

inline constexpr int appendix_a_milliseconds = 2000;

// Runs for two seconds with `steps_per_ms` steps in each of the program's milliseconds, of which
// the valve's program counts forty. Writes the length at the end of each millisecond to `length`,
// appendix_a_milliseconds of them [in].
void appendix_a(int steps_per_ms, double* length);

// Its right-hand side, for integrators of another kind: length, speed, pressure and mass.

std::array<double, 4> appendix_a_start();

// `valve`: 1 to the supply, 2 to the room. `side`: of the dry friction, 1 while the load goes down
// and -1 while it goes up, in place of the sign of the speed; 0: it rests.
void appendix_a_rates(int valve, int side, const double* x, double* rates);

struct AppendixFriction {
  double bound = 0;  // of the dry friction [lbf]
  double asks = 0;   // what pulls at a load that rests, down > 0 [lbf]
};
AppendixFriction appendix_a_friction(const double* x);

}  // namespace sinew::bench
