// bench/appendix_a.h - the thesis's own program of the test stand, appendix A, as it is printed:
// an actuator on a 3-way valve at 25 Hz that lifts 5 lb from 3.4 in. Its names, constants and order
// of operations; without what it prints, and with the step as an argument.
#pragma once

namespace sinew::bench {

inline constexpr int appendix_a_milliseconds = 2000;

// Runs for two seconds with `steps_per_ms` steps in each of the program's milliseconds, of which
// the valve's program counts forty. Writes the length at the end of each millisecond to `length`,
// appendix_a_milliseconds of them [in].
void appendix_a(int steps_per_ms, double* length);

}  // namespace sinew::bench
