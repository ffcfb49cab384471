// log/message.h - a topic in JSON: its schema, and its messages {"x":1.5,"y":-2}.
//
// Numbers take the fewest digits that read back to the same bits. JSON has no NaN and no infinity:
// both are written as null, and null is read as NaN.
#pragma once

#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sinew/signals/table.h"

namespace sinew::log {

// The JSON schema of a topic: its description, its fields in order, their units. JSON Schema has no
// word for a unit and lets any other stand beside its own, so "unit" is for programs, and the
// description, which viewers show, says it once more.
std::string to_schema(const signals::Topic& topic);

// Returns these units as metadata of the topic's channel, for readers that do not look into
// schemas.
std::vector<std::pair<std::string, std::string>> to_metadata(const signals::Topic& topic);

// The topic that a schema describes; nothing where it has no field with a number. Fields of other
// kinds, which foreign logs have, are left out; those of an object within it are called `pose.x`.
std::optional<signals::Topic> from_schema(std::string_view schema, std::string_view topic);

// Returns whether it is a JSON schema of objects that names no property of theirs.
bool is_open_schema(std::string_view schema);

// Returns a topic with a field for each number in a message, of a log whose schema has none of
// them.
std::optional<signals::Topic> from_message(std::string_view text, std::string_view topic);

// Writes and reads the messages of one topic.
class MessageFormat {
 public:
  // Takes the fields of the topic, in their order.
  explicit MessageFormat(const signals::Topic& topic);

  // How many values a message has.
  std::size_t fields() const { return keys_.size(); }
  // Appends a message; what is not a number is null.
  void append(std::string& out, std::span<const double> values) const;

  // Reads any object; what append() has written is read without building a document. A field
  // that is missing gives NaN. False: not a JSON object. `values` has fields() elements.
  bool parse(std::string_view text, std::span<double> values) const;

 private:
  bool parse_own(std::string_view text, std::span<double> values) const;
  bool parse_any(std::string_view text, std::span<double> values) const;

  std::vector<std::string> names_;
  std::vector<std::string> keys_;  // what stands before each value: {"x": and then ,"y":
};

// The digits of a finite number; 32 characters are enough.
inline std::string_view digits(double value, std::span<char, 32> room) {
  const auto end = std::to_chars(room.data(), room.data() + room.size(), value).ptr;
  return {room.data(), static_cast<std::size_t>(end - room.data())};
}

}  // namespace sinew::log
