// recording/parts.h - several recordings in one table, one after the other: a restarted logger
// writes its header again, or its time jumps back to the start.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sinew/recording/grid.h"

namespace sinew::recording {

// Recording in a table: its byte range in the grid's text, and the line of its first row.
struct Part {
  std::size_t begin = 0, end = 0;
  int line = 0;
};

// Returns the recordings of a table; `clock` is the index of its time column, if it has one.
std::vector<Part> parts_of(const Grid& grid, const Source& source,
                           std::optional<std::size_t> clock);

// Removes all rows from the grid but those of recording `source.part`, counted from 1, and adds a
// note. Throws config::Error if there is no such recording.
void keep_part(Grid& grid, const Source& source, std::optional<std::size_t> clock);

// Throws config::Error with the line and the way to choose one, if there are several recordings.
void refuse_parts(const Grid& grid, const Source& source, std::optional<std::size_t> clock);

}  // namespace sinew::recording
