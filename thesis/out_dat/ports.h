// thesis/out_dat/ports.h - the bytes that the thesis's controller writes to the valves' two ports
// (B.1), and when.
#pragma once

#include <string>

#include "sinew/experiment/experiment.h"
#include "sinew/signals/table.h"

namespace sinew::thesis {

// Returns CSV: a time in s, and the byte of each port [1], wherever one changes. A board whose
// valves have more bits has more ports; several boards come one after the other, with a column that
// numbers them.
std::string write_ports(const signals::Table& table, const experiment::Experiment& experiment);

}  // namespace sinew::thesis
