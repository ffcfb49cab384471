// identify/valve/edges.h - when a recorded command was switched.
#pragma once

#include <vector>

#include "sinew/identify/data/measured.h"
#include "sinew/identify/valve/chamber.h"

namespace sinew::identify {

struct Edges {
  std::vector<Opening> edges;  // of the coil, halfway between the samples around each
  double sample = 0;           // how long those are apart, mostly [s]
};

// Column `command`, on above half of its largest value. Throws Refusal where it is never switched.
Edges edges_of(const Measured& data);

// What a valve with dead times makes of them (gas/delay.h), times [s].
std::vector<Opening> delayed(const std::vector<Opening>& edges, double opening_delay,
                             double closing_delay);

}  // namespace sinew::identify
