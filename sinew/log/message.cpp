#include "sinew/log/message.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/json/json.h"
#include "sinew/log/file.h"

namespace sinew::log {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string text_or_empty(const Json& object, const char* key) {
  const Json* found = object.find(key);
  return found != nullptr && found->is_string() ? found->string() : std::string();
}

bool holds_number(const Json& property) {
  const std::string type = text_or_empty(property, "type");
  return type == "number" || type == "integer" || type == "boolean";
}

double number(const Json& value) {
  if (value.is_boolean()) return value.boolean() ? 1.0 : 0.0;
  return value.is_number() ? value.number() : kNaN;
}

// Returns whether it is the message's time, {"sec": …, "nsec": …}, which duplicates its log time.
bool is_timestamp(const Json& properties) {
  return properties.size() == 2 && properties.contains("sec") &&
         (properties.contains("nsec") || properties.contains("nanosec"));
}

// Adds the fields of a schema; those of nested objects are named `pose.x`.
void add_fields(const Json& properties, const std::string& prefix,
                std::vector<signals::Field>& out) {
  constexpr std::size_t deepest = 8;  // maximum number of dots in a name
  if (static_cast<std::size_t>(std::ranges::count(prefix, '.')) > deepest) return;
  for (const auto& [name, property] : properties.items()) {
    if (!property.is_object()) continue;
    if (holds_number(property)) {
      out.push_back({prefix + name, text_or_empty(property, "unit")});
      continue;
    }
    const Json* within = property.find("properties");
    if (within == nullptr || !within->is_object() || is_timestamp(*within)) continue;
    add_fields(*within, prefix + name + ".", out);
  }
}

// Returns the value of a field in the object or in nested ones; nullptr if it has none.
const Json* value_of(const Json& object, std::string_view name) {
  if (const Json* found = object.find(name)) return found;
  for (std::size_t dot = name.find('.'); dot != name.npos; dot = name.find('.', dot + 1)) {
    const Json* within = object.find(name.substr(0, dot));
    if (within == nullptr) continue;
    if (const Json* found = value_of(*within, name.substr(dot + 1))) return found;
  }
  return nullptr;
}

// Removes `start` from the front of `text`; returns whether it was there.
bool skip(std::string_view& text, std::string_view start) {
  if (!text.starts_with(start)) return false;
  text.remove_prefix(start.size());
  return true;
}

}  // namespace

std::string to_schema(const signals::Topic& topic) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const signals::Field& field : topic.fields) {
    properties[field.name] = {{"type", "number"}, {"unit", field.unit}};
    if (!field.unit.empty()) properties[field.name]["description"] = "in " + field.unit;
    required.push_back(field.name);
  }
  const Json schema = {{"type", "object"},
                       {"title", topic.name},
                       {"description", topic.description},
                       {"properties", std::move(properties)},
                       {"required", std::move(required)}};
  return schema.exact_text();
}

std::vector<std::pair<std::string, std::string>> to_metadata(const signals::Topic& topic) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const signals::Field& field : topic.fields)
    out.emplace_back(std::string(kUnit) + field.name, field.unit);
  return out;
}

std::optional<signals::Topic> from_schema(std::string_view schema, std::string_view topic) {
  Json json;
  (void)Json::parse(schema, json);
  if (!json.is_object()) return std::nullopt;
  const Json* properties = json.find("properties");
  if (properties == nullptr || !properties->is_object()) return std::nullopt;

  signals::Topic result{std::string(topic), text_or_empty(json, "description"), {}};
  add_fields(*properties, "", result.fields);
  if (result.fields.empty()) return std::nullopt;
  return result;
}

namespace {

void add_numbers(const Json& object, const std::string& prefix, std::vector<signals::Field>& out) {
  constexpr std::size_t deepest = 8;  // maximum number of dots in a name
  if (static_cast<std::size_t>(std::ranges::count(prefix, '.')) > deepest) return;
  if (is_timestamp(object)) return;
  for (const auto& [name, value] : object.items()) {
    if (value.is_number() || value.is_boolean() || value.is_null())
      out.push_back({prefix + name, ""});
    else if (value.is_object())
      add_numbers(value, prefix + name + ".", out);
  }
}

// Replaces numbers that JSON lacks, as Python and others spell them, by null.
std::string with_nulls(std::string_view text) {
  std::string out;
  bool in_text = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '"' && (at == 0 || text[at - 1] != '\\')) in_text = !in_text;
    std::string_view rest = text.substr(at);
    for (const std::string_view word : {"-Infinity", "Infinity", "NaN"}) {
      if (in_text || !rest.starts_with(word)) continue;
      out += "null";
      at += word.size();
      rest = text.substr(at);
      break;
    }
    if (at < text.size()) out += text[at];
  }
  return out;
}

// Returns the object of a message, or another kind of value if the message does not hold an object.
Json object_in(std::string_view text) {
  Json json;
  if (Json::parse(text, json)) return json;
  if (!Json::parse(with_nulls(text), json)) return {};
  return json;
}

}  // namespace

bool is_open_schema(std::string_view schema) {
  if (schema.empty()) return true;
  Json json;
  if (!Json::parse(schema, json) || !json.is_object()) return false;
  const Json* properties = json.find("properties");
  return !properties || (properties->is_object() && properties->items().empty());
}

std::optional<signals::Topic> from_message(std::string_view text, std::string_view topic) {
  const Json json = object_in(text);
  if (!json.is_object()) return std::nullopt;
  signals::Topic result{std::string(topic), "", {}};
  add_numbers(json, "", result.fields);
  if (result.fields.empty()) return std::nullopt;
  return result;
}

MessageFormat::MessageFormat(const signals::Topic& topic) {
  for (const signals::Field& field : topic.fields) {
    names_.push_back(field.name);
    std::string& key = keys_.emplace_back(keys_.empty() ? "{" : ",");
    key += Json(field.name).exact_text();
    key += ':';
  }
}

void MessageFormat::append(std::string& out, std::span<const double> values) const {
  char room[32];
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    out += keys_[i];
    out += std::isfinite(values[i]) ? digits(values[i], room) : std::string_view("null");
  }
  out += '}';
}

bool MessageFormat::parse(std::string_view text, std::span<double> values) const {
  return parse_own(text, values) || parse_any(text, values);
}

bool MessageFormat::parse_own(std::string_view text, std::span<double> values) const {
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (!skip(text, keys_[i])) return false;
    if (skip(text, "null")) {
      values[i] = kNaN;
      continue;
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), values[i]);
    if (error != std::errc() || !std::isfinite(values[i])) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return text == "}";
}

bool MessageFormat::parse_any(std::string_view text, std::span<double> values) const {
  const Json json = object_in(text);
  if (!json.is_object()) return false;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const Json* const value = value_of(json, names_[i]);
    values[i] = value ? number(*value) : kNaN;
  }
  return true;
}

}  // namespace sinew::log
