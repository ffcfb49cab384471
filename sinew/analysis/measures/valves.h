// analysis/measures/valves.h - open times and coil energy of valves, from the edges in a log.
//
// Electrical edges are those of the coil's current, delivered edges those of the air. Between them
// are the valve's dead times: the shutter opens t_o after the current begins and shuts t_c after it
// ends; an edge before the last one took effect cancels it. So a pulse D delivers D - t_o + t_c,
// and nothing if D <= t_o.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sinew/gas/valve.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// A valve opens or shuts.
struct Edge {
  double time = 0;  // [s]
  bool open = false;
};

using Edges = signals::PagedVector<Edge>;

// Returns the edges of a valve that is shut before the first one. Samples that do not change its
// state are left out.
Edges edges_of(const signals::Times& time_ns, const signals::Column& open);

// Returns the edges of the shutter, from electrical edges and delays  [s].
Edges delivered(const Edges& electrical, double opening_delay, double closing_delay);

// Returns the time within [from, to) in which the valve is open; after the last edge it stays in
// its state  [s].
double open_time(const Edges&, double from, double to);

// Returns the energy that the coil takes within [from, to), from electrical edges:
//   E = P t_on + (P_boost - P) min(t_on, t_boost) for each pulse  [J]
double coil_energy(const Edges& electrical, const gas::Coil& coil, double from, double to);

// Returns the number of openings within [from, to).
int openings(const Edges&, double from, double to);

// --- Recorded edges compared with those of a replay ---

// The first edge at which two trains of edges differ.
struct EdgeDifference {
  std::int64_t time_ns = 0;
  std::string topic;
  std::string recorded, replayed;  // "opens", "shuts" or "nothing"
};

// Comparison of one valve's edges. An edge without an equal counts as moved if the other side has
// one of the same direction within 5 ms, half a period of pulses, that has no equal either;
// otherwise it is on one side only.
struct ValveEdges {
  std::string topic;
  std::size_t recorded = 0, replayed = 0;  // edges
  std::size_t moved = 0;
  std::size_t only_recorded = 0, only_replayed = 0;
  double mean_move = 0, largest_move = 0;  // replayed - recorded; in magnitude, with sign [s]

  // Returns the number of edges that are not equal.
  std::size_t differing() const { return moved + only_recorded + only_replayed; }
};

// Comparison of the recorded edges of all valves with those of a replay.
struct EdgeComparison {
  std::size_t recorded = 0, replayed = 0;  // edges
  std::optional<EdgeDifference> first;     // empty if all are equal
  std::vector<ValveEdges> valves;          // in the replay's order
};

// Compares the valves' edges of two runs; those of a log that was cut off up to the time at which
// the first of its sensors ends. Throws std::invalid_argument with the names of valves that
// `replayed` has and `recorded` lacks.
EdgeComparison compare_edges(const signals::Table& recorded, const signals::Table& replayed);

}  // namespace sinew::analysis
