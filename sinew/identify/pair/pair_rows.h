// identify/pair/pair_rows.h - which samples of a recording are fitted, and which are predicted.
#pragma once

#include <cstddef>
#include <vector>

#include "sinew/identify/pair/pair_record.h"

namespace sinew::identify {

// Samples of a recording, in ascending order.
using PairRows = std::vector<std::size_t>;

// Blocks of time that cross-validation leaves out, one after the other.
inline constexpr std::size_t pair_blocks = 5;

// Returns the samples whose time is in [from, to], or those that are not.
PairRows pair_rows(const PairRecord& record, double from, double to, bool inside);

// Returns the rows of the k-th of `pair_blocks` blocks, or those of all the others.
PairRows pair_block(const PairRows& rows, std::size_t k, bool inside);

// Returns the recording with every k-th sample, about 2000: more of a smooth series say nothing
// new.
PairRecord pair_thinned(const PairRecord& record);

}  // namespace sinew::identify
