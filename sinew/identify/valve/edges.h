// identify/valve/edges.h - switching times of a recorded command.
#pragma once

#include <vector>

#include "sinew/identify/data/measured.h"
#include "sinew/identify/valve/chamber.h"

namespace sinew::identify {

struct Edges {
  std::vector<Opening> edges;  // coil edges, halfway between the samples around each
  double sample = 0;           // median sample interval [s]
};

// Returns the edges of the column `command`, which is on above half of its largest value. Throws
// Refusal if it never switches.
Edges edges_of(const Measured& data);

// Returns the edges of the valve itself, with dead times [s] (gas/delay.h).
std::vector<Opening> delayed(const std::vector<Opening>& edges, double opening_delay,
                             double closing_delay);

}  // namespace sinew::identify
