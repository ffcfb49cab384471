// files/key_schema.cpp - the keys of a file as a JSON schema, for editors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/changes.h"
#include "sinew/config/diagnostics.h"
#include "sinew/files/key_text.h"
#include "sinew/json/json.h"
#include "sinew/units/quantity.h"

namespace sinew::files {

namespace {

// Tree of the keys: the keys in a table, and the rows of a key with several variants.
struct Place {
  std::string name;
  std::vector<Key> rows;
  std::vector<Place> inside;

  Place& at(std::string_view part) {
    for (Place& one : inside)
      if (one.name == part) return one;
    inside.push_back({std::string(part), {}, {}});
    return inside.back();
  }
};

void put(Place& root, const Key& key, std::string_view path) {
  Place* place = &root;
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    std::string_view part = path.substr(0, dot);
    if (part.ends_with("[]")) part.remove_suffix(2);
    place = &place->at(part);
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  place->rows.push_back(key);
}

std::string describe(const Key& key) {
  std::string out = key.doc;
  const auto add = [&](const std::string& words) {
    if (!words.empty()) out += (out.empty() ? "" : "; ") + words;
  };
  if (!key.unit.empty()) add(units::describe_unit(key.unit));
  add(range_of(key));
  if (!key.why.empty()) add(key.why);
  if (!key.when.empty()) add("where " + key.when);
  return out;
}

Json reference(const char* name) { return {{"$ref", fmt::format("#/$defs/{}", name)}}; }

// Returns the schema of a quantity: a text with a unit, or also a number if `plain`.
Json quantity(const Key& key, bool plain) {
  if (!plain) return reference("quantity");
  Json number{{"type", "number"}};
  if (std::isfinite(key.min)) number["minimum"] = key.min;
  if (std::isfinite(key.max)) number["maximum"] = key.max;
  return {{"anyOf", {number, reference("quantity")}}};
}

Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }

Json plain_value(const Key& key) {
  switch (key.type) {
    case KeyType::number:
      return quantity(key, key.unit == "1");
    case KeyType::numbers:
      return list_of(quantity(key, key.unit == "1"));
    case KeyType::polynomial:
      return list_of(quantity(key, true));
    case KeyType::whole: {
      Json whole{{"type", "integer"}};
      if (std::isfinite(key.min)) whole["minimum"] = static_cast<std::int64_t>(key.min);
      if (std::isfinite(key.max)) whole["maximum"] = static_cast<std::int64_t>(key.max);
      return whole;
    }
    case KeyType::flag:
      return {{"type", "boolean"}};
    case KeyType::texts:
      return list_of({{"type", "string"}});
    case KeyType::choice:
      return {{"enum", key.choices}};
    default:
      break;
  }
  const Json text{{"type", "string"}};
  if (key.path == "files.actuator") return {{"anyOf", {text, list_of(text)}}};
  return text;
}

void add_provenance(Json& properties) {
  for (const char* key : {"source", "fit", "guess", "range"})
    if (!properties.contains(key)) properties[key] = reference(key);
}

// Returns the schema of a value alone or as { value, source, … }.
Json value(const Key& key) {
  const Json plain = plain_value(key);
  Json with{{"value", plain}};
  add_provenance(with);
  with["uncertainty"] = reference("uncertainty");
  return {{"anyOf",
           {plain,
            {{"type", "object"},
             {"properties", with},
             {"required", {"value"}},
             {"additionalProperties", false}}}}};
}

Json leaf(const std::vector<Key>& rows) {
  std::vector<Json> different;
  std::string words;
  for (const Key& row : rows) {
    Json one = value(row);
    if (std::ranges::find(different, one) == different.end()) different.push_back(std::move(one));
    if (const std::string line = describe(row); words.find(line) == std::string::npos)
      words += (words.empty() ? "" : "\n") + line;
  }
  Json out = different.size() == 1 ? different.front() : Json{{"anyOf", different}};
  out["description"] = words;
  if (rows.size() == 1 && !rows[0].required) {
    const Key& key = rows[0];
    if (key.type == KeyType::choice && !key.default_text.empty()) out["default"] = key.default_text;
    if (key.type == KeyType::flag) out["default"] = key.default_text == "true";
    if (key.type == KeyType::number && key.default_text != "not set")
      out["default"] = key.default_text;
  }
  return out;
}

Json schema(const Place& place);

Json table(const Place& place) {
  Json properties = Json::object(), others = false;
  for (const Place& one : place.inside) {
    if (one.name == "<name>")
      others = schema(one);
    else
      properties[one.name] = schema(one);
  }
  add_provenance(properties);
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", others}};
}

Json schema(const Place& place) {
  if (place.rows.empty()) return table(place);
  const Key& first = place.rows.front();
  const bool list = first.type == KeyType::list;
  if (!list && first.type != KeyType::table && first.type != KeyType::tables)
    return leaf(place.rows);
  Json out = list ? list_of(table(place)) : table(place);
  if (!first.doc.empty()) out["description"] = first.doc;
  return out;
}

Json definitions() {
  const Json text{{"type", "string"}}, flag{{"type", "boolean"}};
  const Json number{{"type", "number"}};
  return {{"quantity",
           {{"type", "string"},
            {"pattern", "^\\s*[-+]?\\.?[0-9]"},
            {"description", "a number and its unit, as \"3.2 in\" or \"60 psi gauge\""}}},
          {"source", {{"type", "string"}, {"description", "where it comes from"}}},
          {"fit", {{"type", "boolean"}, {"description", "chosen so that something agrees"}}},
          {"guess", {{"type", "boolean"}, {"description", "not published"}}},
          {"range", list_of({{"anyOf", {text, number}}})},
          {"uncertainty", {{"anyOf", {text, number}}}}};
}

// Returns the path of a key in a file of that kind; empty if the file cannot contain it.
std::string path_in_file(const Key& key, std::string_view kind) {
  if (key.path == "name" && key.kind != kind) return "";
  if (kind != "actuator" || key.path == "name") return key.path;
  constexpr std::string_view own = "actuator.<name>.";
  return key.path.starts_with(own) ? key.path.substr(own.size()) : "";
}

void refuse_unknown(std::string_view kind) {
  std::vector<std::string_view> kinds(key_kinds().begin(), key_kinds().end());
  kinds.pop_back();  // "any" is not a file
  if (std::ranges::find(kinds, kind) == kinds.end())
    config::fail({"schema", 0, 0}, "", config::in_quotes(kind), config::either(kinds),
                 std::string(config::closest(kind, kinds)));
}

}  // namespace

std::string schema_of(std::string_view kind) {
  refuse_unknown(kind);
  const std::string format = config::newest_format(kind);
  Place root;
  for (const std::string& one : kinds_within(kind))
    for (const Key& key : keys_of(one))
      if (const std::string path = path_in_file(key, kind); !path.empty()) put(root, key, path);
  Json file = table(root);
  file["properties"]["format"] = {{"const", format}, {"description", "kind and version"}};
  file["properties"]["base"] = {{"type", "string"},
                                {"description",
                                 "a file of the same kind, which this one changes; its `reported` "
                                 "figures are not inherited"}};
  Json out{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", format}};
  out.update(file);
  out["required"] = {"format"};
  out["$defs"] = definitions();
  return out.text(2) + "\n";
}

}  // namespace sinew::files
