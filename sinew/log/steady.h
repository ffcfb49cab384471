// log/steady.h - topics whose value never changes; a finished log stores their value once.
//
// Such a topic has a message at each time of another topic, all of them equal. The log stores only
// the first one, and the channel's metadata names the other topic. The reader repeats the value at
// each of its times, so that a table is read as it was written.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::log {

// Observes the messages of a topic while they are written.
class Steadiness {
 public:
  // Adds the next message of the topic.
  void add(std::int64_t time_ns, std::string_view message);

  // Returns whether there were at least two messages and all were equal.
  bool is_steady() const { return steady_ && count_ > 1; }
  // Returns whether the other topic has the same number of messages at the same times, compared by
  // a hash of 64 bits.
  bool has_times_of(const Steadiness& other) const {
    return count_ == other.count_ && hash_ == other.hash_;
  }

 private:
  std::string first_;
  std::uint64_t count_ = 0, hash_ = 0;
  bool steady_ = true;
};

// Channel number of a topic, its index plus 1 -> name of the topic whose times it has.
using SteadyTopics = std::map<std::uint16_t, std::string>;

// Returns the topics to be written once. Each refers to a topic that is written in full.
SteadyTopics steady_topics(const std::vector<std::string>& names,
                           const std::vector<Steadiness>& topics);

// Repeats the value of a series with one sample at each time of the other one.
void repeat(signals::Series& series, const signals::Series& times);

}  // namespace sinew::log
