// cli/compare.h - what `sinew compare` prints for people.
#pragma once

#include "sinew/report/compare/comparison.h"

namespace sinew::cli {

enum class ShownUnits { thesis, si };

// Runs, figures, parameters and channels that differ; with `all` what is equal too.
void print_comparison(const report::Comparison& comparison, ShownUnits units, bool all);

// "A" … "H": how a run is called in tables.
std::string letter_of(std::size_t run);

}  // namespace sinew::cli
