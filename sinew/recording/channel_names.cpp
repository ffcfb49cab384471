#include "sinew/recording/channel_names.h"

#include <algorithm>
#include <cctype>
#include <variant>

#include "sinew/recording/columns.h"
#include "sinew/units/constants.h"

namespace sinew::recording {
namespace {

// Returns "joint_elbow_angle" for "Joint elbow-angle".
std::string words_of(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0 || letter >= 0x80) {
      out += static_cast<char>(std::tolower(letter));
    } else if (!out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (out.ends_with('_')) out.pop_back();
  return out;
}

// Returns the parts of a topic between its slashes.
std::vector<std::string> parts_of(std::string_view topic) {
  std::vector<std::string> out;
  while (!topic.empty()) {
    topic.remove_prefix(1);
    const std::size_t end = std::min(topic.find('/'), topic.size());
    out.emplace_back(topic.substr(0, end));
    topic.remove_prefix(end);
  }
  return out;
}

std::string joined(std::span<const std::string> parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : "_") + words_of(part);
  return out;
}

bool has_unit(std::string_view unit, const signals::Topic& topic, std::size_t field) {
  const std::string& channel_unit = topic.fields[field].unit;
  if (unit == channel_unit) return true;
  if (unit.empty()) return channel_unit == "1" || channel_unit == "count";
  return std::holds_alternative<FileUnit>(
      file_unit(std::string(unit), quantity_unit(topic, field), units::atmosphere));
}

}  // namespace

std::string name_of_field(const signals::Topic& topic, std::size_t field) {
  return topic.fields.size() > 1 ? topic.name + "." + topic.fields[field].name : topic.name;
}

std::string quantity_unit(const signals::Topic& topic, std::size_t field) {
  const std::string& unit = topic.fields[field].unit;
  if (unit != "Pa") return unit;
  return is_gauge_channel(topic.name) ? "Pa gauge" : "Pa abs";
}

ChannelNames::ChannelNames(std::span<const signals::Topic> topics) : topics_(topics) {
  for (std::size_t t = 0; t < topics.size(); ++t)
    for (std::size_t f = 0; f < topics[t].fields.size(); ++f) {
      targets_.push_back({t, f});
      names_.push_back(name_of({t, f}));
      add_aliases({t, f});
    }
}

void ChannelNames::add_aliases(Target target) {
  std::vector<std::string> parts = parts_of(topics_[target.topic].name);
  if (parts.size() < 2) return;
  for (const char* not_measured : {"true", "desired", "plan", "low_level", "recorded"})
    if (parts.front() == not_measured) return;
  const bool of_sensor = parts.front() == "sensor" && parts.back() == "count";
  if (topics_[target.topic].fields.size() > 1)
    parts.push_back(topics_[target.topic].fields[target.field].name);
  const std::span<const std::string> all(parts);
  const auto add = [&](std::string words, bool counts_only = false) {
    aliases_.push_back({std::move(words), target, counts_only});
  };
  add(joined(all));
  if (parts.size() > 2) add(joined(all.subspan(1)));
  if (of_sensor) return add(joined(all.subspan(1, parts.size() - 2)), true);
  if (parts.back() == "open") {
    add(joined(all.first(parts.size() - 1)));
    return add(joined(all.subspan(1, parts.size() - 2)));
  }
  add(words_of(parts.back()));
}

std::optional<Target> ChannelNames::exact(std::string_view name) const {
  const auto at = std::ranges::find(names_, name);
  if (at != names_.end()) return targets_[static_cast<std::size_t>(at - names_.begin())];
  // Logs may name the single field of a topic as well.
  if (!name.ends_with(".value")) return std::nullopt;
  name.remove_suffix(6);
  const auto whole = std::ranges::find(names_, name);
  if (whole == names_.end()) return std::nullopt;
  return targets_[static_cast<std::size_t>(whole - names_.begin())];
}

std::optional<Target> ChannelNames::obvious(std::string_view name, std::string_view unit) const {
  const std::string words = words_of(name);
  const std::string last = words_of(name.substr(name.find_last_of("./") + 1));
  for (const std::string& asked : {words, last}) {
    std::optional<Target> found;
    bool several = false;
    for (const Alias& alias : aliases_) {
      if (alias.words != asked || (alias.counts_only && unit != "count")) continue;
      if (!has_unit(unit, topics_[alias.target.topic], alias.target.field)) continue;
      several = several || (found && *found != alias.target);
      found = alias.target;
    }
    if (several) return std::nullopt;
    if (found) return found;
  }
  return std::nullopt;
}

std::string ChannelNames::name_of(Target target) const {
  return name_of_field(topics_[target.topic], target.field);
}

}  // namespace sinew::recording
