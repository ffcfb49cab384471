// recording/read.h - a recording from its file, whatever it is: told by its first bytes, not by its
// name.
//
//   CSV      tables of text in all their dialects (raw_table.h)
//   MCAP     logs of Sinew and of others, with messages in JSON
//   MATLAB   .mat of level 5 and 7.3 (matlab.h)
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "sinew/recording/mapping.h"
#include "sinew/recording/recorded.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// Reads one file; of the mapping, what it says of the clock, the table and the rows. Throws
// config::Error and log::Error for what cannot be read, and names what else it is: a workbook, an
// archive. `read` counts the bytes of a table of text while its rows are read.
Recorded read_recording(const std::string& path, const Mapping& mapping,
                        std::atomic<std::int64_t>* read = nullptr);

// Returns what the reader of tables is told by a mapping.
Source source_of(const std::string& path, const Mapping& mapping);

}  // namespace sinew::recording
