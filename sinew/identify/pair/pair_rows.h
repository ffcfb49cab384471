// identify/pair/pair_rows.h - selection of the samples of a recording that are fitted or predicted.
#pragma once

#include <cstddef>
#include <vector>

#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// Indices of samples of a recording, ascending.
using PairRows = std::vector<std::size_t>;

// Number of time blocks that cross-validation leaves out, one after the other.
inline constexpr std::size_t pair_blocks = 5;

// Returns the samples whose time is in [from, to], or those outside.
PairRows pair_rows(const PairRecord& record, double from, double to, bool inside);

// Returns the rows of the k-th of `pair_blocks` blocks, or those of all the others.
PairRows pair_block(const PairRows& rows, std::size_t k, bool inside);

// Returns the recording with every k-th sample, about 2000: more samples of a smooth series add no
// information.
PairRecord pair_thinned(const PairRecord& record);

}  // namespace sinew::identify
