// bench/peers/measure.h - how long two things take that are done by turns.
//
// A computer that is shared speeds up and slows down all the time: a time says what it did just
// then. So two sides work by turns, now the one first and now the other, and what counts is the
// ratio of each pair: its median, and how far the pairs are spread.
#pragma once

#include <functional>
#include <vector>

namespace sinew::bench {

// A clock of this thread on the processor, which stands while others have it; one of all threads of
// this program together; or the wall's, for what goes on in several threads or programs.
enum class Clock { processor, all_threads, wall };

// A work is done once by a call, which answers how many units that were: walks, steps, simulated
// seconds.
using Work = std::function<double()>;

struct Turns {
  std::vector<double> ours, theirs;  // by round, for one unit [s]
};

// Both work once before anything counts.
Turns by_turns(const Work& ours, const Work& theirs, int rounds, Clock clock);

// Quantiles at 5, 25, 50, 75 and 95 %.
struct Spread {
  double low = 0, quarter = 0, median = 0, three_quarters = 0, high = 0;
};

// `values` must not be empty.
Spread spread(std::vector<double> values);

// By round, how many times as long as we the others take; or we as they.
std::vector<double> theirs_by_ours(const Turns& turns);
std::vector<double> ours_by_theirs(const Turns& turns);

// Returns the seconds that one work takes by the clock.
double seconds_of(const std::function<void()>& work, Clock clock);

}  // namespace sinew::bench
