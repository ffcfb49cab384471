// report/page/blob.h - a run's samples as one text that a page can hold: base64 of zlib of columns.
//
// Inside: for every clock its times as int32 ticks of 100 us, each less the one before it; then for
// every column its values as float32. Each of these arrays stands byte by byte: the lowest bytes of
// all its numbers, then the next ones, since bytes of one rank are alike and shrink better. A time
// between ticks is rounded to the next one.
//
// Of a clock with more samples than a screen can show the page gets two of every few: of a column
// that is drawn as a line the least value and the greatest one, in the order in which they come, so
// that no peak is lost; of one that belongs to a pose the values of the first sample and of the
// middle one, so that a pose is one that was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/report/page/channels.h"

namespace sinew::report {

class Blob {
 public:
  static constexpr std::size_t most = 65536;  // samples of a clock

  // Says what a column is for: a curve, or a machine that is drawn.
  enum class As { line, pose };

  // Position of its column; that of the first time, where it was added before.
  int add(const Samples& samples, As as = As::line);

  // Samples that two stand for, of the clock with the most; 0 where all of them are there.
  std::size_t thinned() const;

  struct Layout {
    std::vector<std::size_t> clocks;  // samples of each
    std::vector<int> columns;         // the clock of each
  };
  // Returns where each column stands in the text; and the text.
  Layout layout() const;
  std::string base64() const;

 private:
  int clock_of(const signals::Times& time_ns);

  std::vector<const signals::Times*> clocks_;
  struct Column {
    int clock = 0;
    const signals::Column* values = nullptr;
    As as = As::line;
  };
  std::vector<Column> columns_;
  std::map<std::pair<const void*, As>, int> known_;  // columns by their values
};

// Returns bytes as letters that any text can hold.
std::string to_base64(std::string_view bytes);

}  // namespace sinew::report
