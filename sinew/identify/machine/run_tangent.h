// identify/machine/run_tangent.h - the residuals of a run about a point: run_steps.cpp goes along
// them, run_judge.cpp says what they leave open.
#pragma once

#include <span>
#include <vector>

#include "sinew/identify/fit/matrix.h"
#include "sinew/identify/machine/run_search.h"

namespace sinew::identify {

// Steps of derivatives, in the parameters' scales: the search's, and a longer one that has to
// agree.
inline constexpr double short_difference = 1e-4, long_difference = 2e-3;

// The residuals about a point, by the scaled parameters.
struct RunTangent {
  std::vector<double> r;
  Matrix j;
};

// Writes the tangent at p, of derivatives within the cells. Its columns are forward differences: a
// central one costs a simulation more and gains nothing where the next step comes anyway. False
// where the machine has no answer.
bool run_tangent(const RunResiduals& residuals, std::span<const Parameter> parameters,
                 std::span<const RunCell> cells, const std::vector<double>& p, int threads,
                 RunTangent& out, double by = short_difference);

}  // namespace sinew::identify
