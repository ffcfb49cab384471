// recording/sampled_valves.h - states of valves in the rows of a table, and whether these rows give
// the valves' pulses.
//
// A row has the state at its instant; what a valve did between two rows is unknown. Rows give the
// pulses in three cases only:
//
//   each row has an edge of a valve: the table is a list of edges
//   a row lasts at most a tick, during which a valve has one state
//   a row lasts at most a tenth of the period of the pulses, and each state lasts at least 4 rows
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::recording {

class SampledValves {
 public:
  // Keeps a reference to the rows' times, which must outlive this object. `scale` is that of their
  // clock.
  SampledValves(const signals::Times& rows, double scale) : rows_(rows), is_edge_(rows.size()) {
    if (rows.size() > 1)
      row_ = scale * static_cast<double>(rows.back() - rows.front()) /
             static_cast<double>(rows.size() - 1);
  }

  // Adds a valve by its number in each row: 0.5 and more is open. A row without a finite number
  // keeps the state.
  void add(const std::invocable<std::size_t> auto& number) {
    bool before = false;
    std::size_t since = 0;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const double now = number(row);
      if (!std::isfinite(now) || (now >= 0.5) == before) continue;
      if (since > 0 && row - since < shortest_) shortest_ = row - since;
      before = !before;
      since = row;
      is_edge_[row] = true;
    }
  }

  // Returns whether the rows give the pulses of valves with this period [s].
  bool give_pulses(double period) const;

 private:
  const signals::Times& rows_;
  double row_ = 0;             // mean duration of a row [ns]
  std::vector<bool> is_edge_;  // whether a valve changes in the row
  // Number of rows of the shortest state that begins and ends in the table.
  std::size_t shortest_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace sinew::recording
