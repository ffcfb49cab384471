// analysis/measures/valves.h - how long valves are open, of the edges that a run logs one by one.
//
// Electrical: current in the coil. Delivered: air may flow. Between the two lie the valve's dead
// times: the shutter opens t_o after the current comes and shuts t_c after it goes; an edge that
// comes before the last one took effect cancels it. So a pulse D delivers D - t_o + t_c, and
// nothing if D <= t_o.
#pragma once

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

}  // namespace sinew::analysis
