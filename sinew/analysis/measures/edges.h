// analysis/measures/edges.h - valve edges that were recorded beside those that were decided again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::analysis {

// The first edge at which two trains part.
struct EdgeDifference {
  std::int64_t time_ns = 0;
  std::string topic;
  std::string recorded, replayed;  // "opens", "shuts" or "nothing"
};

// One valve's edges. An edge that has no equal moved where the other side has one of the same
// direction within 5 ms, half a period of pulses, that has no equal either; else it is there on one
// side alone.
struct ValveEdges {
  std::string topic;
  std::size_t recorded = 0, replayed = 0;  // edges
  std::size_t moved = 0;
  std::size_t only_recorded = 0, only_replayed = 0;
  double mean_move = 0, largest_move = 0;  // replayed - recorded; in magnitude, with sign [s]

  // How many edges the two do not have in common.
  std::size_t differing() const { return moved + only_recorded + only_replayed; }
};

// How recorded edges of a valve compare with those that were decided again.
struct EdgeComparison {
  std::size_t recorded = 0, replayed = 0;  // edges
  std::optional<EdgeDifference> first;     // none: all are equal
  std::vector<ValveEdges> valves;          // all of them, in the replay's order
};

// Compares the valves' edges of two runs; of a log that was cut off as far as all of it was there.
// Throws std::invalid_argument, naming them, where `recorded` lacks valves that `replayed` has.
EdgeComparison compare_edges(const signals::Table& recorded, const signals::Table& replayed);

}  // namespace sinew::analysis
