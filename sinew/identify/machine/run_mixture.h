// identify/machine/run_mixture.h - distribution of parameters as a mixture of normal distributions,
// each within its own box: dead times have cells (run_search.h), and in each cell that the run does
// not exclude the readings give another distribution.
//
//   p(x)  ~  sum over the pieces of  exp(-c) exp(-|z|^2/2)  within the piece's box
//
//   x = middle + spread z      z of unit normals, spread upper triangular
//   c                          half the sum of squares at the piece's own minimum
//
// The middle 95 % of each parameter come from seeded draws, parameter after parameter within the
// remaining box, weighted with the box's probability (Geweke, Hajivassiliou, Keane).
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/contest/matrix.h"
#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

// One of the distributions.
struct RunPiece {
  std::vector<double> middle;
  Matrix spread;             // its diagonal > 0
  std::vector<RunCell> box;  // for each parameter
  double cost = 0;           // c
};

// Returns the middle 95 % of each parameter; for a single distribution they are its middle -+
// `width` standard deviations. If they do not contain `value`, such as a value at the end of its
// box, they are the 95 % that reach up to it. `pieces` must not be empty.
std::vector<RunCell> middle_of_pieces(std::span<const RunPiece> pieces,
                                      std::span<const double> value, double width);

}  // namespace sinew::identify
