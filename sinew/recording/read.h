// recording/read.h - reading of a recording from a file. The format is recognised by the file's
// first bytes, not by its name.
//
//   CSV      tables of text in all supported formats (raw_table.h)
//   MCAP     logs of Sinew and of other programs, with messages in JSON
//   MATLAB   .mat of level 5 and 7.3 (matlab.h)
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "sinew/recording/mapping.h"
#include "sinew/recording/recorded.h"
#include "sinew/recording/source.h"

namespace sinew::recording {

// Reads one file. Uses the mapping's clock, table settings and row conditions. Throws config::Error
// and log::Error if it cannot be read, and names other formats that it recognises, such as a
// workbook or an archive. `read` counts the bytes read from the rows of a text table.
Recorded read_recording(const std::string& path, const Mapping& mapping,
                        std::atomic<std::int64_t>* read = nullptr);

// Returns the settings of a mapping for the table reader.
Source source_of(const std::string& path, const Mapping& mapping);

}  // namespace sinew::recording
