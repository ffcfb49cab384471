// analysis/align/divergence.h - the time at which a simulation departs from a measurement, by
// channel.
//
//   e_i = simulated - measured       where their samples meet (verdict/compare.h)
//   band = max(share·range, 4 sigma) of the measured channel; sigma is its noise (signal.h)
//   parts at                         the first e beyond the band that is followed by two more
//   growth                           rms of e in each tenth of the measured channel's time
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/verdict/compare.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// One channel that both have.
struct Divergence {
  std::string topic, field, unit;
  Difference difference;
  double band = 0;                  // in the channel's unit
  std::optional<double> at;         // [s]; empty if it stays within the band
  std::array<double, 10> growth{};  // NaN if no samples meet in that tenth
};

// Returns the common channels that a sensor can measure, without valves, duties and plans, in the
// order of departure. The band is `share` of the range, 0 to 1.
std::vector<Divergence> divergences(const signals::Table& measured, const signals::Table& simulated,
                                    double share);

// Returns whether a channel describes the motion of a machine: not a valve, a duty, a plan, an
// internal value of the low level or a true value of a simulation.
bool is_of_motion(std::string_view topic);

}  // namespace sinew::analysis
