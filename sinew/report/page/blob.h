// report/page/blob.h - a run's samples as one text that a page can hold: base64 of zlib of columns.
//
// Inside: for every clock its times as int32 ticks of 100 us, each less the one before it; then for
// every column its values as float32. Each of these arrays stands byte by byte: the lowest bytes of
// all its numbers, then the next ones, since bytes of one rank are alike and shrink better. A time
// between ticks is rounded to the next one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/report/page/channels.h"

namespace sinew::report {

class Blob {
 public:
  // Position of its column; that of the first time, where it was added before.
  int add(const Samples& samples);

  struct Layout {
    std::vector<std::size_t> clocks;  // samples of each
    std::vector<int> columns;         // the clock of each
  };
  Layout layout() const;
  std::string base64() const;

 private:
  int clock_of(const std::vector<std::int64_t>& time_ns);

  std::vector<const std::vector<std::int64_t>*> clocks_;
  struct Column {
    int clock = 0;
    const std::vector<double>* values = nullptr;
  };
  std::vector<Column> columns_;
  std::map<const void*, int> known_;  // columns by their values
};

std::string to_base64(std::string_view bytes);

}  // namespace sinew::report
