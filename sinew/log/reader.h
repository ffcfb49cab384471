// log/reader.h - reads an MCAP file as a channel table: Sinew's own logs, and what it can use of
// others'.
//
// Indexed and plain files read alike, and so does a log that was cut off or damaged: everything
// before the damage is kept, and the table says that it is not complete. Topics whose messages are
// not JSON with numbers in it are passed over.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "sinew/log/error.h"
#include "sinew/signals/table.h"

namespace sinew::log {

// The series stand in the order of the file's channels, each in ascending time. Throws Error where
// there is no such file, or it is empty, or not MCAP, or compressed.
signals::Table read(const std::filesystem::path& file);

// What the writer was told about the run; empty where the file says nothing. Throws like read().
std::vector<std::pair<std::string, std::string>> read_metadata(const std::filesystem::path& file);

}  // namespace sinew::log
