#include "sinew/config/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "sinew/units/letters.h"

namespace sinew::config {

namespace {

// Returns the segments of a path without the indices of lists.
std::vector<std::string> segments(std::string_view path) {
  std::vector<std::string> out(1);
  bool index = false;
  for (const char c : path) {
    if (c == '.') {
      out.emplace_back();
      index = false;
    } else if (c == '[' || index) {
      index = true;
    } else {
      out.back() += c;
    }
  }
  return out;
}

std::vector<std::string_view> names_of_kinds(const Changes& changes) {
  std::vector<std::string_view> names;
  for (const Kind& kind : changes.kinds)
    if (kind.now.empty()) names.push_back(kind.name);
  return names;
}

std::string format_line(const Kind* kind, const Changes& all) {
  return fmt::format("format = \"{}\"",
                     kind ? newest_format(kind->name, all) : newest_format("experiment"));
}

}  // namespace

const Kind* Changes::find(std::string_view kind) const {
  const auto it = std::ranges::find(kinds, kind, &Kind::name);
  return it == kinds.end() ? nullptr : &*it;
}

// A test stand had its own kind before it became part of an experiment.
const Changes& changes() {
  static const Changes all{.kinds = {{"robot"},
                                     {"actuator"},
                                     {"valves"},
                                     {"wiring"},
                                     {"experiment", 2},
                                     {"rig", 1, "experiment"},
                                     {"plan"},
                                     {"tuning"},
                                     {"settings"},
                                     {"mapping"},
                                     {"labels"}},
                           .keys = {{.kind = "experiment",
                                     .format = 2,
                                     .from = "control.brain_period",
                                     .to = "high_level_period"},
                                    {.kind = "experiment",
                                     .format = 2,
                                     .from = "drive.believed_load",
                                     .to = "assumed_load"}}};
  return all;
}

std::string newest_format(std::string_view name, const Changes& all) {
  const Kind* kind = all.find(name);
  if (kind && !kind->now.empty()) kind = all.find(kind->now);
  if (!kind) throw std::invalid_argument("no kind of file: " + std::string(name));
  return fmt::format("sinew.{}/{}", kind->name, kind->newest);
}

Format format_of(std::string_view text) {
  constexpr std::string_view ours = "sinew.";
  const std::size_t slash = text.find('/');
  if (!text.starts_with(ours) || slash == text.npos) return {};
  Format format{text.substr(ours.size(), slash - ours.size()), 0};
  const std::string_view number = text.substr(slash + 1);
  const char* last = number.data() + number.size();
  const auto [end, error] = std::from_chars(number.data(), last, format.number);
  if (error != std::errc{} || end != last) format.number = 0;
  return format;
}

Format check_format(const Node& root, const Changes& changes) {
  const Node* node = root.find("format");
  const auto names = names_of_kinds(changes);
  const std::string expected = fmt::format("\"sinew.<kind>/1\", kind being {}", either(names));
  if (!node) {
    const Kind* likely = changes.find(likely_kind(root));
    const char* who = likely ? "; sinew migrate rewrites it" : "";
    fail(root.where, "format", "nothing", expected,
         format_line(likely, changes) + " as the first line" + who);
  }
  node->used = true;
  const Format format = format_of(node->text);
  const Kind* kind = changes.find(format.kind);
  if (node->kind != Node::Kind::text || !kind || format.number < 1)
    fail(node->where, "format", shown(*node), expected,
         format_line(kind ? kind : changes.find(closest(format.kind, names)), changes));
  if (format.number > kind->newest)
    fail(node->where, "format", shown(*node),
         fmt::format("\"sinew.{}/{}\" or older", format.kind, kind->newest),
         "a newer Sinew: the file was written for one");
  return format;
}

bool matches(std::string_view path, std::string_view pattern) {
  return std::ranges::equal(segments(path), segments(pattern),
                            [](const std::string& segment, const std::string& wanted) {
                              return wanted == "*" || segment == wanted;
                            });
}

const KeyChange* removed_key(std::string_view path, const Changes& changes) {
  for (const KeyChange& change : changes.keys) {
    // The keys of an actuator's file are below its name.
    const bool below = change.kind == "actuator";
    const std::string pattern = fmt::format("{}{}", below ? "actuator.*." : "", change.from);
    if (matches(path, pattern)) return &change;
  }
  return nullptr;
}

std::string replacement_text(const KeyChange& change, std::string_view path) {
  const std::string since = fmt::format("since sinew.{}/{}", change.kind, change.format);
  if (change.to.empty()) return fmt::format("{}; it is gone {}", change.why, since);
  const std::string_view table = path.substr(0, path.rfind('.') + 1);
  return fmt::format("{}{}, which replaces it {}", table, change.to, since);
}

std::string with_present_key(const std::string& setting, const Changes& changes) {
  const std::size_t equals = setting.find('=');
  if (equals == setting.npos) return setting;
  const std::string key(units::trimmed(std::string_view(setting).substr(0, equals)));
  const KeyChange* change = removed_key(key, changes);
  if (!change || change->to.empty()) return setting;
  return fmt::format("{}{}{}", key.substr(0, key.rfind('.') + 1), change->to,
                     setting.substr(equals));
}

std::string_view likely_kind(const Node& root) {
  // The first of these keys in the file decides, as an experiment may have any table of a robot.
  struct Sign {
    std::string_view key, kind;
  };
  static constexpr Sign signs[] = {{"tune", "tuning"},
                                   {"vary", "plan"},
                                   {"experiment", "plan"},
                                   {"element", "experiment"},
                                   {"load", "experiment"},
                                   {"robot", "experiment"},
                                   {"phase", "experiment"},
                                   {"sequence", "experiment"},
                                   {"link", "robot"},
                                   {"muscle", "robot"},
                                   {"joint", "robot"},
                                   {"braid", "actuator"},
                                   {"effectiveness", "actuator"},
                                   {"loss", "actuator"},
                                   {"wiring", "wiring"},
                                   {"valve", "valves"}};
  for (const Sign& sign : signs)
    if (root.find(sign.key)) return sign.kind;
  return {};
}

}  // namespace sinew::config
