// log/csv.h - a channel table as CSV, for spreadsheets and everything else that reads columns.
//
// `time [s]` comes first, then a column per field under `topic.field [unit]`, or `topic [unit]`
// where the topic has one field. There is a row per distinct time of the periodic topics; a topic
// without a sample at a row's time has an empty cell there, and so has a value that is no number.
//
// Valve edges (/valve/<muscle>/<inlet|exhaust>/open) make no rows: their column says whether the
// valve stands open (1) or shut (0) at the row's time, an edge at that very time included. Before
// its first edge a valve is shut. In a table of edges alone the rows are their times.
//
// Numbers have the fewest digits that read back to the same bits.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "sinew/log/error.h"
#include "sinew/signals/table.h"

namespace sinew::log {

// `topics` names what to write: those topics and all below them ("/muscle/hip_flexor", "/true");
// empty stands for all.
void write_csv(const signals::Table& table, std::ostream& out,
               const std::vector<std::string>& topics = {});

// Into a file, which is replaced when the table is whole. Throws Error where it cannot be written.
void write_csv(const signals::Table& table, const std::filesystem::path& file,
               const std::vector<std::string>& topics = {});

}  // namespace sinew::log
