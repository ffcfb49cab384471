// thesis/out_dat/ports.h - bytes that the thesis's controller writes to the two valve ports (B.1),
// with their times.
#pragma once

#include <string>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/table.h"

namespace sinew::thesis {

// Returns CSV: time [s] and the byte of each port [1], with a row for each change. A board with
// more valve bits has more ports; several boards follow one after the other, with a column for
// their number.
std::string write_ports(const signals::Table& table, const experiment::Experiment& experiment);

}  // namespace sinew::thesis
