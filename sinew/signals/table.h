// signals/table.h - the channel table: what a run recorded, however long it was.
//
// A *topic* is one line of conventions.md's list of channels, for instance /true/foot/force with
// the fields x and y. Every topic has its own times, so samples every 10 ms and single valve edges
// live side by side. `log` writes and reads tables, `analysis` reads them. Of a long run memory
// holds the newest samples, a temporary file the others (paged_vector.h).
// Not part of the embedded core.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/signals/paged_vector.h"

namespace sinew::signals {

using Times = PagedVector<std::int64_t>;  // since the start of the run [ns]
using Column = PagedVector<double>;

struct Field {
  std::string name;  // "value" for a topic with one field
  std::string unit;  // "m", "N", "rad", "Pa", "count", "1"
};

// A channel by its name, with the units of its fields.
struct Topic {
  std::string name;         // "/true/foot/force"
  std::string description;  // one sentence
  std::vector<Field> fields;
};

// Holds what one channel recorded.
struct Series {
  Topic topic;
  Times time_ns;
  std::vector<Column> columns;  // [field][sample]
};

// Is it a valve's, /valve/… or a leg's /leg/<name>/valve/…? Their edges stand one by one.
bool is_of_valve(std::string_view topic);

struct Table {
  std::vector<Series> series;
  bool complete = true;  // false: read from a log that was cut off

  // Returns the channel of that name; nullptr where there is none.
  const Series* find(std::string_view topic) const;

  // Column `field` of `topic`; nullptr where the table has no such thing.
  const Column* column(std::string_view topic, std::string_view field = "value") const;
};

}  // namespace sinew::signals
