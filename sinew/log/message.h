// log/message.h - JSON format of a topic: its schema, and its messages {"x":1.5,"y":-2}.
//
// Numbers have the fewest digits that read back to the same bits. JSON has neither NaN nor
// infinity: both are written as null, and null is read as NaN.
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

// Returns the JSON schema of a topic: description, fields in order, and units. JSON Schema defines
// no keyword for units but allows others, so programs find it in "unit"; viewers show the
// description, which repeats it.
std::string to_schema(const signals::Topic& topic);

// Returns the units as metadata of the topic's channel, for readers that do not parse schemas.
std::vector<std::pair<std::string, std::string>> to_metadata(const signals::Topic& topic);

// Returns the topic that a schema describes; nothing if it has no field with a number. Fields of
// other kinds, which other programs' logs have, are left out; fields of a nested object are named
// `pose.x`.
std::optional<signals::Topic> from_schema(std::string_view schema, std::string_view topic);

// Returns whether it is a JSON schema of an object without any named properties.
bool is_open_schema(std::string_view schema);

// Returns a topic with a field for each number in a message, for a log whose schema names no
// fields.
std::optional<signals::Topic> from_message(std::string_view text, std::string_view topic);

// Writes and reads the messages of a topic.
class MessageFormat {
 public:
  // Uses the fields of the topic, in their order.
  explicit MessageFormat(const signals::Topic& topic);

  // Returns the number of values in a message.
  std::size_t fields() const { return keys_.size(); }
  // Appends a message; values that are not finite become null.
  void append(std::string& out, std::span<const double> values) const;

  // Reads a JSON object; messages of append() are read without building a document. A missing field
  // gives NaN. Returns false if the text is not a JSON object. `values` has fields() elements.
  bool parse(std::string_view text, std::span<double> values) const;

 private:
  bool parse_own(std::string_view text, std::span<double> values) const;
  bool parse_any(std::string_view text, std::span<double> values) const;

  std::vector<std::string> names_;
  std::vector<std::string> keys_;  // text before each value: {"x": and then ,"y":
};

// Returns the digits of a finite number; 32 characters are enough.
inline std::string_view digits(double value, std::span<char, 32> room) {
  const auto end = std::to_chars(room.data(), room.data() + room.size(), value).ptr;
  return {room.data(), static_cast<std::size_t>(end - room.data())};
}

}  // namespace sinew::log
