// signals/table.h - the channel table: recorded data of a run of any length.
//
// A *topic* is one line of the list of channels in conventions.md, for instance /true/foot/force
// with the fields x and y. Every topic has its own times, so that samples every 10 ms and single
// valve edges can be in one table. `log` writes and reads tables, `analysis` reads them. For a long
// run memory holds the newest samples and a temporary file the others (paged_vector.h). Not part of
// the embedded core.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
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

// Recorded data of one channel.
struct Series {
  Topic topic;
  Times time_ns;
  std::vector<Column> columns;  // [field][sample]
};

// Names of topics.
using TopicNames = std::set<std::string, std::less<>>;

// Returns whether the topic is a valve's, /valve/… or for a leg /leg/<name>/valve/…; such topics
// record single edges.
bool is_of_valve(std::string_view topic);

// Description of a valve's topic whose edges come from rows too far apart to give its pulses, and
// whether a topic has it.
inline constexpr std::string_view coarse_edges = "edges as the rows of a table show them";
bool has_coarse_edges(const Topic& topic);

struct Table {
  std::vector<Series> series;
  bool complete = true;  // false: read from a log that was cut off

  // Returns the channel of that name; nullptr if there is no such channel.
  const Series* find(std::string_view topic) const;

  // Returns column `field` of `topic`; nullptr if the table does not have it.
  const Column* column(std::string_view topic, std::string_view field = "value") const;
};

}  // namespace sinew::signals
