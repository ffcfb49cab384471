// log/reader.h - reader of an MCAP file as a channel table, for Sinew's logs and those of other
// programs.
//
// Indexed and plain files give the same table. From a log that was cut off or damaged, everything
// before the damage is read, and the table is marked as incomplete. Topics whose messages are not
// JSON with numbers are skipped.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sinew/log/file.h"
#include "sinew/signals/table.h"

namespace sinew::log {

// Reads a log. The series have the order of the file's channels, with ascending times. Throws Error
// if the file is missing, empty, not MCAP, or compressed.
signals::Table read(const std::filesystem::path& file);

// Returns the metadata of the run; empty if the file has none. Throws like read().
std::vector<std::pair<std::string, std::string>> read_metadata(const std::filesystem::path& file);

}  // namespace sinew::log
