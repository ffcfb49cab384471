// report/figures/measure.h - what an eye reads off a plot, as numbers.
//
// A trace is a drawn curve: x never falls unless a function says otherwise; samples of which x or y
// is not a number are gaps. What a trace does not show is NaN.
#pragma once

#include <span>
#include <vector>

namespace sinew::report {

struct Trace {
  std::span<const double> x, y;  // equally long
};

// Straight between samples; NaN outside of them.
double value_at(const Trace& trace, double x);

// Least x from `from` on with y >= level (straight between samples); crossing downwards: y <=
// level.
double first_at_least(const Trace& trace, double level, double from = -1e300);
double first_at_most(const Trace& trace, double level, double from = -1e300);

// Largest distance in y from the line of least squares, as a share of y's range. x in any order.
double bend(const Trace& trace);

// y = slope x + offset.
struct StraightLine {
  double slope = 0, offset = 0;
};
StraightLine line_of(const Trace& trace);  // least squares; x in any order

// Largest drop of y from one sample to a later one; 0: y never falls. x in any order.
double largest_fall(const Trace& trace);

// Returns the smallest and the largest y; NaN of an empty trace.
double least(const Trace& trace);
double greatest(const Trace& trace);

// The part with from <= x <= to.
Trace part(const Trace& trace, double from, double to);

// Mean of y, each sample with the same weight.
double mean(const Trace& trace);

// First y that is less than both neighbours, from `from` on; a flat bottom counts at its left end.
double first_dip(const Trace& trace, double from = -1e300);  // its x

// Amplitude of what repeats no slower than `width` of x: root of twice the mean square of y less
// its centered moving mean over `width`. Samples evenly spaced.
double amplitude(const Trace& trace, double width);

}  // namespace sinew::report
