#include "bench/peers/measure.h"

#include <time.h>

#include <algorithm>
#include <cmath>

namespace sinew::bench {

namespace {

double now(Clock clock) {  // [s]
  const clockid_t by[] = {CLOCK_THREAD_CPUTIME_ID, CLOCK_PROCESS_CPUTIME_ID, CLOCK_MONOTONIC};
  timespec t{};
  clock_gettime(by[static_cast<int>(clock)], &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double per_unit(const Work& work, Clock clock) {
  double units = 0;
  const double seconds = seconds_of([&] { units = work(); }, clock);
  return seconds / units;
}

// Interpolates linearly in a sorted list.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double part = place - static_cast<double>(below);
  return sorted[below] + part * (sorted[above] - sorted[below]);
}

std::vector<double> quotients(const std::vector<double>& over, const std::vector<double>& under) {
  std::vector<double> out;
  for (std::size_t i = 0; i < over.size(); ++i) out.push_back(over[i] / under[i]);
  return out;
}

}  // namespace

double seconds_of(const std::function<void()>& work, Clock clock) {
  const double before = now(clock);
  work();
  return now(clock) - before;
}

Turns by_turns(const Work& ours, const Work& theirs, int rounds, Clock clock) {
  ours();
  theirs();
  Turns out;
  for (int i = 0; i < rounds; ++i) {
    if (i % 2 == 0) out.ours.push_back(per_unit(ours, clock));
    out.theirs.push_back(per_unit(theirs, clock));
    if (i % 2 == 1) out.ours.push_back(per_unit(ours, clock));
  }
  return out;
}

Spread spread(std::vector<double> values) {
  std::ranges::sort(values);
  return {quantile(values, 0.05), quantile(values, 0.25), quantile(values, 0.5),
          quantile(values, 0.75), quantile(values, 0.95)};
}

std::vector<double> theirs_by_ours(const Turns& turns) {
  return quotients(turns.theirs, turns.ours);
}
std::vector<double> ours_by_theirs(const Turns& turns) {
  return quotients(turns.ours, turns.theirs);
}

}  // namespace sinew::bench
