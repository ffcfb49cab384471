// analysis/measures/edges.h - valve edges that were recorded beside those that were decided again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "sinew/signals/table.h"

namespace sinew::analysis {

// The first edge at which two trains part.
struct EdgeDifference {
  std::int64_t time_ns = 0;
  std::string topic;
  std::string recorded, replayed;  // "opens", "shuts" or "nothing"
};

// How recorded edges of a valve compare with those that were decided again.
struct EdgeComparison {
  std::size_t recorded = 0, replayed = 0;  // edges
  std::optional<EdgeDifference> first;     // none: all are equal
};

// Compares the valves' edges of two runs; of a log that was cut off as far as all of it was there.
// Throws std::invalid_argument where `recorded` lacks a valve that `replayed` has.
EdgeComparison compare_edges(const signals::Table& recorded, const signals::Table& replayed);

}  // namespace sinew::analysis
