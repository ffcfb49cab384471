// recording/assemble.h - recordings become a channel table, by a mapping and a machine's channels.
//
// Several recordings stand side by side in time, or one begins where the one before it ends. The
// table's time 0 is the first sample, unless the clock of the recording begins between 0 and 1 s:
// then it is a run's own, and stays.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/recording/mapping.h"
#include "sinew/recording/recorded.h"
#include "sinew/signals/table.h"
#include "sinew/units/constants.h"

namespace sinew::recording {

// How several become one.
struct Joining {
  bool at_end = false;                        // one behind the other; else side by side
  std::map<std::string, std::string> shifts;  // file -> "0.12 s", by which its times are later
  double atmosphere = units::atmosphere;      // between gauge and absolute pressures [Pa]
};

// Says what became of one file.
struct Taken {
  std::string file, kind;
  std::string started;              // on the clock on the wall; empty: not known
  std::size_t rows = 0;             // of its longest clock
  std::size_t values = 0;           // that went into the table
  std::size_t left_out = 0;         // values that are no numbers, or stand before time 0
  std::vector<std::string> unused;  // columns without a channel
};

// The table, how it came about, and what somebody should know about it.
struct Assembled {
  signals::Table table;  // in the order of the machine's channels, then /recorded/…
  Mapping used;          // with every column that has a channel, also those that need no words
  std::vector<Taken> files;
  std::string started;  // the table's time 0 on the clock on the wall; empty: not known
  std::vector<std::string> notes;
};

// `topics`: the machine's. Throws config::Error with all that is wrong: a column or a channel that
// there is not, a unit that is missing or of another dimension, a channel that two files have.
Assembled assemble(const std::vector<Recorded>& files, const Mapping& mapping,
                   std::span<const signals::Topic> topics, const Joining& joining = {});

// A machine's channels by the names that people's loggers give them.

// One field of a topic.
struct Target {
  std::size_t topic = 0, field = 0;
  friend bool operator==(const Target&, const Target&) = default;
};

// Knows channels by their own names and by those that say the same.
class ChannelNames {
 public:
  // `topics` outlives this.
  explicit ChannelNames(std::span<const signals::Topic> topics);

  // The channel of exactly this name: a topic with one field, or topic.field.
  std::optional<Target> exact(std::string_view name) const;

  // The only channel that a column of this name and unit can be: "elbow_angle" and "Joint elbow
  // angle" are /joint/elbow/angle, and so is "angle" where one joint is all there is. Nothing where
  // it could be several, or has no such unit. What is only desired, planned or simulated has to be
  // named in full.
  std::optional<Target> obvious(std::string_view name, std::string_view unit) const;

  // The name of a channel, and all names, for messages.
  std::string name_of(Target target) const;
  const std::vector<std::string>& all() const { return names_; }

 private:
  struct Alias {
    std::string words;
    Target target;
    bool counts_only = false;  // a sensor's own name, which is often that of what it measures
  };
  void add_aliases(Target target);

  std::span<const signals::Topic> topics_;
  std::vector<std::string> names_;
  std::vector<Target> targets_;  // of these names
  std::vector<Alias> aliases_;
};

// The unit of a channel as quantities name it: a log's Pa is absolute, but for what a test stand's
// transducers say by their own scales, which is gauge.
std::string quantity_unit(const signals::Topic& topic, std::size_t field);

}  // namespace sinew::recording
