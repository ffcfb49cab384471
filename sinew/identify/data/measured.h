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

}  // namespace sinew::identify
