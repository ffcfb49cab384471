// log/steady.h - topics whose value never changes, which a finished log holds once.
//
// Such a topic has a message at each time of another one, all of them the same. Its first message
// says it all, if it is known which topic's times are meant: the channel's metadata names that one,
// and the reader gives the value to each of its times, so that a table is read as it was written.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::log {

// Learns of a topic while its messages are written.
class Steadiness {
 public:
  // Looks at the next message of the topic.
  void add(std::int64_t time_ns, std::string_view message);

  // Have all messages been the same so far, two of them at least?
  bool is_steady() const { return steady_ && count_ > 1; }
  // Has the other one the very times? (Of so many times as there are, in their order, by a hash of
  // 64 bits.)
  bool has_times_of(const Steadiness& other) const {
    return count_ == other.count_ && hash_ == other.hash_;
  }

 private:
  std::string first_;
  std::uint64_t count_ = 0, hash_ = 0;
  bool steady_ = true;
};

// By the number of a topic's channel, which is its place in the list and 1: at whose times it
// stands.
using SteadyTopics = std::map<std::uint16_t, std::string>;

// Returns the topics that are to be written once. One that is written whole is named by them.
SteadyTopics steady_topics(const std::vector<std::string>& names,
                           const std::vector<Steadiness>& topics);

// Gives a series of one sample its value at each time of the other one.
void repeat(signals::Series& series, const signals::Series& times);

}  // namespace sinew::log
