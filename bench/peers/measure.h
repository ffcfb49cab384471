// bench/peers/measure.h - times of two works that are done alternately.
//
// The speed of a shared computer varies all the time, so that single times are not comparable. Two
// sides therefore work alternately, in alternating order, and the result is the ratio of each pair:
// its median and its spread.
#pragma once

#include <functional>
#include <vector>

namespace sinew::bench {

// Processor time of this thread, processor time of all threads of this program, or wall time, for
// work in several threads or programs.
enum class Clock { processor, all_threads, wall };

// Does the work once and returns the number of its units: walks, steps or simulated seconds.
using Work = std::function<double()>;

struct Turns {
  std::vector<double> ours, theirs;  // by round, for one unit [s]
};

// Measures both alternately, after one run of each that is not counted.
Turns by_turns(const Work& ours, const Work& theirs, int rounds, Clock clock);

// Quantiles at 5, 25, 50, 75 and 95 %.
struct Spread {
  double low = 0, quarter = 0, median = 0, three_quarters = 0, high = 0;
};

// `values` must not be empty.
Spread spread(std::vector<double> values);

// Return, by round, the ratio of their time to ours, and of our time to theirs.
std::vector<double> theirs_by_ours(const Turns& turns);
std::vector<double> ours_by_theirs(const Turns& turns);

// Returns the time of one work by this clock [s].
double seconds_of(const std::function<void()>& work, Clock clock);

}  // namespace sinew::bench
