// recording/parts.h - several recordings in one table, one after the other: a logger that was
// started again writes its header once more, or its time jumps back to where it began.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sinew/recording/grid.h"

namespace sinew::recording {

// One recording: its bytes in the grid's text, and the line on which its first row stands.
struct Part {
  std::size_t begin = 0, end = 0;
  int line = 0;
};

// Returns the recordings of a table; `clock` is its column of times, where it has one.
std::vector<Part> parts_of(const Grid& grid, const Source& source,
                           std::optional<std::size_t> clock);

// Keeps the rows of recording `source.part`, of 1 and up, of the grid alone, and notes it. Throws
// config::Error where there is no such recording.
void keep_part(Grid& grid, const Source& source, std::optional<std::size_t> clock);

// Throws config::Error, which names the line and how to choose, where there are several.
void refuse_parts(const Grid& grid, const Source& source, std::optional<std::size_t> clock);

}  // namespace sinew::recording
