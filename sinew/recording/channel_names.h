// recording/channel_names.h - a machine's channels, found by the names that other loggers give
// them.
#pragma once

#include <cstddef>
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

// Maps channel names and their aliases to channels.
class ChannelNames {
 public:
  // Keeps a reference to `topics`, which must outlive this object.
  explicit ChannelNames(std::span<const signals::Topic> topics);

  // Returns the channel with exactly this name: a topic with one field, or topic.field.
  std::optional<Target> exact(std::string_view name) const;

  // Returns the only channel that fits a column of this name and unit: "elbow_angle" and "Joint
  // elbow angle" are /joint/elbow/angle, and so is "angle" on a machine with one joint. Returns
  // nothing if several channels fit, or none with such a unit. Desired, planned and simulated
  // channels need their full name.
  std::optional<Target> obvious(std::string_view name, std::string_view unit) const;

  // Return the name of a channel, and the names of all channels, for messages.
  std::string name_of(Target target) const;
  const std::vector<std::string>& all() const { return names_; }

 private:
  struct Alias {
    std::string words;
    Target target;
    bool counts_only = false;  // a sensor's name, which is often that of the measured quantity
  };
  void add_aliases(Target target);

  std::span<const signals::Topic> topics_;
  std::vector<std::string> names_;
  std::vector<Target> targets_;  // the targets of these names
  std::vector<Alias> aliases_;
};

// Returns the name of a field's channel: the topic's, or topic.field where it has several fields.
std::string name_of_field(const signals::Topic& topic, std::size_t field);

// Returns the unit of a channel as units::parse_quantity() takes it. A log's Pa is absolute,
// except in /sensor/ topics, where a test stand's transducers measure gauge pressure.
std::string quantity_unit(const signals::Topic& topic, std::size_t field);

}  // namespace sinew::recording
