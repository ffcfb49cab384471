// identify/task/valve_tables.h - the tables of a valve, as a logger leaves them: times that no
// chart asks for, fillings one after the other in one file or in several.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/valve/added_volume.h"

namespace sinew::identify {

// Returns the table. Where its rows are a chart or a map of duties, the order of their times means
// nothing, and a column `time` that runs backwards is left out. Throws config::Error.
Measured read_valve(const Source& source);

// Returns the fillings whose added volumes are known: by `settings`, one between commas for each
// source, or by a column added_volume, whose values may also part one table. Several recordings in
// a file, one after the other, are as many fillings. Empty: no such volumes are told. Throws
// config::Error and Refusal.
std::vector<AddedFill> added_fills(const std::vector<Source>& sources, const std::string& settings);

}  // namespace sinew::identify
