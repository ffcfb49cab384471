// bench/peers/pair.h - comparison of two works that are done alternately, as a benchmark.
//
// The speed of a shared computer varies all the time, so that single times are not comparable. Each
// repetition of such a benchmark therefore does both works, in alternating order, and its time is
// the ratio of ours to the other's. The statistics of google-benchmark and its compare.py are then
// those of ratios, which can be compared between days.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace sinew::bench {

// Processor time of this thread, processor time of all threads of this program, or wall time, for
// work in several threads or programs.
enum class Clock { processor, all_threads, wall };

// Does the work once and returns the number of its units: walks, steps or simulated seconds.
using Work = std::function<double()>;

struct Pair {
  Work ours, theirs;
  Clock clock = Clock::processor;
  std::string label;                      // name of the comparison
  std::map<std::string, double> figures;  // counters: errors of both sides, with their units
  std::function<void()> before;           // called before both works, not timed; may be empty
};

// Registers a benchmark. `make` is called once, before the first repetition; if it throws, the row
// reports the reason. Counters: `times_as_fast`, and the time of one unit of each side.
void compare(const std::string& name, std::function<Pair()> make);

// Its object at namespace scope registers the rows of a file.
struct Registration {
  explicit Registration(void (*rows)()) { rows(); }
};

// Returns the time of one work by this clock [s].
double seconds_of(const std::function<void()>& work, Clock clock);

// Returns a quantile of values, interpolated linearly. `values` must not be empty.
double quantile(std::vector<double> values, double share);

}  // namespace sinew::bench
