// identify/machine/run_mixture.h - what is known of numbers where several normal distributions
// hold, each within a box of its own: dead times have cells (run_search.h), and what the readings
// say is another distribution in each that the run does not rule out.
//
//   p(x)  ~  sum over the pieces of  exp(-c) exp(-|z|^2/2)  within the piece's box
//
//   x = middle + spread z      z of unit normals, spread upper triangular
//   c                          what is left in the piece's own best place, half a sum of squares
//
// The middle 95 % of each number come from seeded draws, number after number within what the box
// leaves of it, with the box's share as weight (Geweke, Hajivassiliou, Keane).
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/fit/matrix.h"
#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

// One of the distributions.
struct RunPiece {
  std::vector<double> middle;
  Matrix spread;             // its diagonal > 0
  std::vector<RunCell> box;  // of each number
  double cost = 0;           // c
};

// Returns the middle 95 % of each number, where a distribution's are its middle -+ `width` standard
// deviations. Where `value` is none of them, as the end of a box that holds it, they are those 95 %
// that reach up to it. There is a piece at least.
std::vector<RunCell> middle_of_pieces(std::span<const RunPiece> pieces,
                                      std::span<const double> value, double width);

}  // namespace sinew::identify
