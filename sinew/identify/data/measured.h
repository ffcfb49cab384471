// identify/data/measured.h - tables that the identification methods read: those of sinew/recording
// under the names that the methods use.
#pragma once

#include "sinew/recording/measured.h"

namespace sinew::identify {

using recording::Column;
using recording::ColumnSpec;
using recording::Measured;
using recording::parse_measured;
using recording::read_measured;
using recording::Source;
using recording::text_of;

// Whether a row of a list of ColumnSpec is optional: {"angle", "rad", 0.01, 7, needed_column, …}.
inline constexpr bool needed_column = false, optional_column = true;

}  // namespace sinew::identify
