#include "sinew/recording/sampled_valves.h"

#include <algorithm>

#include "sinew/signals/tick.h"

namespace sinew::recording {

bool SampledValves::give_pulses(double period) const {
  constexpr double rows_of_period = 10, rows_of_state = 4;
  constexpr double tick = static_cast<double>(signals::tick_nanoseconds);

  // The first row may have the state at the start.
  const bool is_list = !is_edge_.empty() && std::all_of(is_edge_.begin() + 1, is_edge_.end(),
                                                        [](bool is) { return is; });
  if (is_list || row_ <= tick) return true;
  return rows_of_period * row_ <= 1e9 * period && static_cast<double>(shortest_) >= rows_of_state;
}

}  // namespace sinew::recording
