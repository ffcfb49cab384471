// report/page/channels.h - where a page's numbers are found: the tables of a run, one after the
// other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::report {

// A field of a topic.
struct Channel {
  std::string topic;  // empty: none
  std::string field = "value";

  // Does it stand for no channel?
  bool none() const { return topic.empty(); }
};

// A channel's samples. Points into a table.
struct Samples {
  const signals::Times* time_ns = nullptr;
  const signals::Column* values = nullptr;
  std::string unit;

  explicit operator bool() const { return values && !values->empty(); }
};

// Recorded, derived and drawn series; where two have the same channel, the first one's counts.
class Channels {
 public:
  void add(const signals::Table& table) { tables_.push_back(&table); }  // outlives this
  // Returns its samples, of the first table that has it; empty where none has.
  Samples find(const Channel& channel) const;
  bool has(const Channel& channel) const { return static_cast<bool>(find(channel)); }
  // The first of them that is there; none where none is.
  Channel first_of(std::initializer_list<std::string> topics) const;
  const std::vector<const signals::Table*>& tables() const { return tables_; }

 private:
  std::vector<const signals::Table*> tables_;
};

}  // namespace sinew::report
