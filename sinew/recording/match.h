// recording/match.h - which column is which channel, and how its numbers become that channel's.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/channel_names.h"
#include "sinew/recording/mapping.h"
#include "sinew/recording/recorded.h"

namespace sinew::recording {

// Numbers of a file to those of a channel.
struct Scaling {
  double slope = 1, offset = 0;
  bool same = true;  // bit for bit

  // Returns the value that the channel has for a number of the file.
  double operator()(double number) const { return same ? number : offset + slope * number; }
};

// A column with its channel.
struct Matched {
  std::size_t file = 0, column = 0;
  Target target;
  Scaling conversion;
};

// All columns that have a channel, and those that have none.
struct Matches {
  std::vector<Matched> columns;
  std::vector<std::vector<std::string>> unused;  // columns' names, by file
  Mapping used;                                  // a row for each matched column
  std::vector<std::string> guessed;              // "elbow_angle is /joint/elbow/angle"
  std::vector<signals::Topic> topics;            // the machine's, and /recorded/… behind them
};

// Throws config::Error with all that is wrong.
Matches match(const std::vector<Recorded>& files, const Mapping& mapping,
              std::span<const signals::Topic> topics, double atmosphere, bool at_end);

}  // namespace sinew::recording
