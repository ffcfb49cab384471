// recording/channel_names.h - a machine's channels by the names that people's loggers give them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::recording {

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
