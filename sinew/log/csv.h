// log/csv.h - channel table as CSV, for spreadsheets and other programs that read columns.
//
// `time [s]` comes first, then a column per field named `topic.field [unit]`, or `topic [unit]` if
// the topic has one field. Each distinct time of the periodic topics has a row. A topic without a
// sample at a row's time has an empty cell there; a value that is not finite is empty as well.
//
// Valve edges (/valve/<muscle>/<inlet|exhaust>/open) add no rows: their column is 1 if the valve is
// open and 0 if it is shut at the row's time, including an edge at exactly that time. A valve is
// shut before its first edge. A table that has only edges has a row for each of their times.
//
// Numbers have the fewest digits that read back to the same bits.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "sinew/log/file.h"
#include "sinew/signals/table.h"

namespace sinew::log {

// Returns the text of a cell, in quotes where necessary.
std::string csv_cell(const std::string& text);

// Writes the table. `topics` selects these topics and all below them ("/muscle/hip_flexor",
// "/true"); empty selects all.
void write_csv(const signals::Table& table, std::ostream& out,
               const std::vector<std::string>& topics = {});

// Writes to a file, which is replaced once the table is complete. Throws Error on failure.
void write_csv(const signals::Table& table, const std::filesystem::path& file,
               const std::vector<std::string>& topics = {});

}  // namespace sinew::log
