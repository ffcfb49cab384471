#include "sinew/recording/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/clock.h"

namespace sinew::recording {

namespace {

// Share of the recording's length: a time that jumps back this close to the first one is a new
// start.
constexpr double near_start = 0.05;

// Finds the start of each recording, row by row.
class PartFinder {
 public:
  PartFinder(const Grid& grid, const Source& source, std::optional<std::size_t> clock)
      : grid_(grid), clock_(grid, source, clock) {}

  std::vector<Part> find() {
    Body body(grid_);
    for (Row row; body.next(row);) take(row, body.count());
    if (!parts_.empty() && parts_.back().end == 0) parts_.back().end = grid_.text->size();
    return std::move(parts_);
  }

 private:
  // Returns whether the row repeats the header, cell by cell.
  bool is_header(const Row& row) const {
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      if (row.cells[i].text != grid_.headings()[i].written) return false;
    return true;
  }

  std::optional<double> time_of(const Row& row, std::size_t index) {
    if (clock_.kind() == RowClock::Kind::none) return std::nullopt;
    std::size_t cell = 0;
    const std::optional<RowTime> time = clock_.read(row, index, cell);
    if (!time) return std::nullopt;
    return clock_.kind() == RowClock::Kind::instants ? static_cast<double>(time->instant)
                                                     : time->number;
  }

  void take(const Row& row, std::size_t index) {
    if (is_header(row)) {
      close(row.at);
      return;
    }
    const std::optional<double> time = time_of(row, index);
    if (time && last_ && *time < *last_ && *time <= first_ + near_start * (*last_ - first_))
      close(row.at);
    if (parts_.empty() || parts_.back().end != 0) {
      parts_.push_back({.begin = row.at, .line = row.line});
      last_.reset();
      clock_.restart();
    }
    if (!time) return;
    if (!last_) first_ = *time;
    last_ = time;
  }

  void close(std::size_t at) {
    if (!parts_.empty() && parts_.back().end == 0) parts_.back().end = at;
  }

  const Grid& grid_;
  RowClock clock_;
  std::vector<Part> parts_;  // the last one has end 0 until it is known
  double first_ = 0;
  std::optional<double> last_;
};

}  // namespace

std::vector<Part> parts_of(const Grid& grid, const Source& source,
                           std::optional<std::size_t> clock) {
  return PartFinder(grid, source, clock).find();
}

void keep_part(Grid& grid, const Source& source, std::optional<std::size_t> clock) {
  const std::vector<Part> parts = parts_of(grid, source, clock);
  if (source.part < 1 || static_cast<std::size_t>(source.part) > parts.size())
    config::fail({grid.file, 0, 0}, "part", std::to_string(source.part),
                 parts.size() == 1
                     ? "1: the file holds one recording"
                     : fmt::format("1 to {}, the recordings of the file", parts.size()));
  const Part& part = parts[static_cast<std::size_t>(source.part) - 1];
  grid.notes.push_back(fmt::format("recording {} of {} in the file, from line {}", source.part,
                                   parts.size(), part.line));
  grid.text =
      std::make_unique<const std::string>(grid.text->substr(part.begin, part.end - part.begin));
  grid.dialect.body = 0;
  grid.dialect.body_line = part.line;
}

void refuse_parts(const Grid& grid, const Source& source, std::optional<std::size_t> clock) {
  const std::vector<Part> parts = parts_of(grid, source, clock);
  if (parts.size() < 2) return;
  config::fail(
      {grid.file, parts[1].line, 1}, "",
      fmt::format("{} recordings one after the other, the second from this line", parts.size()),
      "one recording", fmt::format("part=1 to part={} to read one of them", parts.size()));
}

}  // namespace sinew::recording
