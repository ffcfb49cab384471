// report/figures/measure.h - numbers that are read off the curves of a plot.
//
// A trace is a drawn curve. x must not fall, except where a function allows it; samples with NaN in
// x or y are gaps. A result that a trace does not contain is NaN.
#pragma once

#include <span>

namespace sinew::report {

struct Trace {
  std::span<const double> x, y;  // equally long
};

// Returns y at x, interpolated linearly; NaN outside the samples.
double value_at(const Trace& trace, double x);

// Return the least x from `from` on with y >= level, or y <= level, interpolated linearly.
double first_at_least(const Trace& trace, double level, double from = -1e300);
double first_at_most(const Trace& trace, double level, double from = -1e300);

// Returns the largest distance in y from the line of least squares, as a share of y's range. x may
// be in any order.
double bend(const Trace& trace);

// y = slope x + offset.
struct StraightLine {
  double slope = 0, offset = 0;
};
StraightLine line_of(const Trace& trace);  // least squares; x may be in any order

// Returns the largest drop of y from one sample to a later one; 0 if y never falls. x may be in any
// order.
double largest_fall(const Trace& trace);

// Returns the smallest and the largest y; NaN of an empty trace.
double least(const Trace& trace);
double greatest(const Trace& trace);

// Returns the part with from <= x <= to.
Trace part(const Trace& trace, double from, double to);

// Returns the mean of y, each sample with the same weight.
double mean(const Trace& trace);

// Returns x of the first minimum from `from` on; a flat one counts at its left end.
double first_dip(const Trace& trace, double from = -1e300);

// Returns the amplitude of oscillations with a period up to `width` of x: root of twice the mean
// square of y less its centered moving mean over `width`. Samples must be evenly spaced.
double amplitude(const Trace& trace, double width);

}  // namespace sinew::report
