// analysis/align/parting.h - where a simulation parts from what was measured, channel by channel.
//
//   e_i = simulated - measured       where their samples meet (verdict/compare.h)
//   band = max(share·range, 4 sigma) of what was measured; sigma its noise (signal.h)
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

// One channel of both.
struct Parting {
  std::string topic, field, unit;
  Difference difference;
  double band = 0;                  // in the channel's unit
  std::optional<double> at;         // [s]; nothing where it stays within the band
  std::array<double, 10> growth{};  // none where no samples meet in that tenth
};

// Channels that a sensor could have measured and both have, those that part first at the top; no
// valves, duties or plans. `share` of the range is the band, 0 to 1.
std::vector<Parting> partings(const signals::Table& measured, const signals::Table& simulated,
                              double share);

// Answers whether a channel says how a machine moved: no valve, duty, plan, or what only a
// simulation knows.
bool is_of_motion(std::string_view topic);

}  // namespace sinew::analysis
