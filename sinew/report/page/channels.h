// report/page/channels.h - channels of a run, found in several tables.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::report {

// A field of a topic.
struct Channel {
  std::string topic;  // empty: no channel
  std::string field = "value";

  // Returns whether this is no channel.
  bool is_empty() const { return topic.empty(); }
};

// A channel's samples; points into a table.
struct Samples {
  const signals::Times* time_ns = nullptr;
  const signals::Column* values = nullptr;
  std::string unit;

  explicit operator bool() const { return values && !values->empty(); }
};

// Recorded, derived and drawn series. If several tables have a channel, the first one counts.
class Channels {
 public:
  void add(const signals::Table& table) { tables_.push_back(&table); }  // must outlive this
  // Returns the samples of the first table that has the channel; empty if no table has it.
  Samples find(const Channel& channel) const;
  bool has(const Channel& channel) const { return static_cast<bool>(find(channel)); }
  // Returns the first of these topics that has samples; is_empty() if no topic has.
  Channel first_of(std::initializer_list<std::string> topics) const;
  const std::vector<const signals::Table*>& tables() const { return tables_; }

 private:
  std::vector<const signals::Table*> tables_;
};

}  // namespace sinew::report
