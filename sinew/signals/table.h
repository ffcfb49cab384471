// signals/table.h - the channel table: what a run recorded, in memory.
//
// A *topic* is one line of conventions.md's list of channels, for instance /true/foot/force with
// the fields x and y. Every topic has its own times, so samples every 10 ms and single valve edges
// live side by side. `log` writes and reads tables, `analysis` reads them.
// Not part of the embedded core.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::signals {

struct Field {
  std::string name;  // "value" for a topic with one field
  std::string unit;  // "m", "N", "rad", "Pa", "count", "1"
};

struct Topic {
  std::string name;         // "/true/foot/force"
  std::string description;  // one sentence
  std::vector<Field> fields;
};

struct Series {
  Topic topic;
  std::vector<std::int64_t> time_ns;         // since the start of the run
  std::vector<std::vector<double>> columns;  // [field][sample]
};

// Is it a valve's, /valve/… or a leg's /leg/<name>/valve/…? Their edges stand one by one.
bool is_of_valve(std::string_view topic);

struct Table {
  std::vector<Series> series;
  bool complete = true;  // false: read from a log that was cut off

  const Series* find(std::string_view topic) const;

  // Column `field` of `topic`; nullptr where the table has no such thing.
  const std::vector<double>* column(std::string_view topic, std::string_view field = "value") const;
};

}  // namespace sinew::signals
