// analysis/measures/valves.h - how long valves are open, of the edges that a run logs one by one.
//
// Electrical: current in the coil. Delivered: air may flow. Between the two lie the valve's dead
// times: the shutter opens t_o after the current comes and shuts t_c after it goes; an edge that
// comes before the last one took effect cancels it. So a pulse D delivers D - t_o + t_c, and
// nothing if D <= t_o.
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

// Shut before the first one; an edge to where the valve stands already is none.
Edges edges_of(const signals::Times& time_ns, const signals::Column& open);

// Returns when the shutter moves, of electrical edges and delays  [s].
Edges delivered(const Edges& electrical, double opening_delay, double closing_delay);

// Within [from, to), as the last edge before `to` leaves it  [s].
double open_time(const Edges&, double from, double to);

// What the coil takes of the battery within [from, to), of electrical edges:
//   E = P t_on + (P_boost - P) min(t_on, t_boost) for each pulse  [J]
double coil_energy(const Edges& electrical, const gas::Coil& coil, double from, double to);

// Times that it opens within [from, to).
int openings(const Edges&, double from, double to);

// Valve edges that were recorded beside those that were decided again.

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
