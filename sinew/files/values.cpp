#include "sinew/files/values.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/reader.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/json/json.h"
#include "sinew/recording/mapping.fields.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/units/quantity.h"

namespace sinew::files {

namespace {

std::string si_text(const config::Node& values, const config::Origin& origin) {
  if (origin.unit.empty()) return "";
  const config::Node* node = config::value_at(values, origin.path);
  if (!node) return "";
  return config::written(node->is_value_table() ? *node->find("value") : *node);
}

// Returns the value for display: a single number without digits caused by conversion.
std::string rounded_text(const config::Node& values, const config::Origin& origin) {
  const std::string si = si_text(values, origin);
  const units::Parsed parsed = units::parse_quantity(si, origin.unit.empty() ? "1" : origin.unit);
  return origin.unit.empty() || parsed.mistake ? si
                                               : units::rounded_quantity(parsed.si, origin.unit);
}

// Absolute pressures are shown with the unit of pressures, as gauge if the set of units has it.
std::string_view held(std::string_view unit) { return unit == "Pa abs" ? "Pa" : unit; }

// Returns the value in the units to show; a list has each of its numbers.
std::string shown_text(const config::Node& values, const config::Origin& origin,
                       const units::ShownUnits& shown, double room) {
  const config::Node* node = origin.unit.empty() ? nullptr : config::value_at(values, origin.path);
  if (!node) return "";
  if (node->is_value_table()) node = node->find("value");
  const auto text = [&](const config::Node& number) {
    const std::string si = config::written(number);
    const units::Parsed parsed = units::parse_quantity(si, origin.unit, room);
    return parsed.mistake ? si : shown.text(parsed.si, held(origin.unit), 6, room);
  };
  if (node->kind != config::Node::Kind::array) return text(*node);
  std::vector<std::string> all;
  for (const config::Node& number : node->children) all.push_back(text(number));
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string mark(const config::Origin& o) {
  return o.fit ? "fit" : o.guess ? "guess" : o.is_default ? "default" : "";
}

std::string place(const config::Origin& o) {
  if (o.is_default) return "";
  return o.where.line > 0 ? fmt::format("{}:{}", o.where.file, o.where.line) : o.where.file;
}

// Returns the origins selected by key or beginning of a key; all, if no key is given.
config::Origins chosen(const config::Origins& all, const std::vector<std::string>& keys,
                       const std::string& path) {
  if (keys.empty()) return all;
  config::Origins out;
  std::vector<bool> found(keys.size(), false), whole(keys.size(), false);
  for (const config::Origin& origin : all)
    for (std::size_t k = 0; k < keys.size(); ++k) whole[k] = whole[k] || origin.path == keys[k];
  for (const config::Origin& origin : all) {
    bool wanted = false;
    for (std::size_t k = 0; k < keys.size(); ++k)
      if (whole[k] ? origin.path == keys[k] : origin.path.starts_with(keys[k]))
        found[k] = wanted = true;
    if (wanted) out.push_back(origin);
  }
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (found[k]) continue;
    std::vector<std::string_view> paths;
    for (const config::Origin& origin : all) paths.push_back(origin.path);
    const std::string near(config::closest(keys[k], paths));
    config::fail({path, 0, 0}, "", config::in_quotes(keys[k]),
                 "a key of the file, or the beginning of one", near);
  }
  return out;
}

// Returns the keys of an actuator's file with actuator.<name>, which such a file omits.
std::vector<std::string> with_actuator(std::vector<std::string> keys,
                                       const experiment::MachineFile& file) {
  if (file.kind != "actuator") return keys;
  for (std::string& key : keys)
    if (std::ranges::none_of(file.experiment.origins, [&](const config::Origin& origin) {
          return origin.path.starts_with(key);
        }))
      key = fmt::format("actuator.{}.{}", file.experiment.actuators.front().name, key);
  return keys;
}

Json to_json(const config::Origin& o, const config::Node& values) {
  Json out{{"key", o.path}, {"written", o.text}};
  if (const std::string si = si_text(values, o); !si.empty()) out["si"] = si;
  if (!o.unit.empty()) out["unit"] = o.unit;
  if (!o.source.empty()) out["source"] = o.source;
  for (const auto& [name, value] :
       {std::pair{"fit", o.fit}, {"guess", o.guess}, {"default", o.is_default}})
    if (value) out[name] = true;
  if (!o.range.empty()) out["range"] = o.range;
  if (o.range_si) out["range_si"] = *o.range_si;
  if (!o.uncertainty.empty()) out["uncertainty"] = o.uncertainty;
  if (!o.is_default) out["file"] = o.where.file;
  if (o.where.line > 0) out["line"] = o.where.line;
  return out;
}

// Returns the values of a mapping, whose rows are tables in a list.
Values mapping_values(const std::string& path, const std::vector<std::string>& sets,
                      const std::vector<std::string>& keys) {
  const config::Node root = config::compose(path, sets);
  config::Reader reader(root);
  recording::Mapping mapping;
  std::string format;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  recording::fields(reader, mapping);
  reader.finish();
  config::Writer writer;
  recording::fields(writer, mapping);
  return {writer.root(), chosen(reader.origins(), keys, path)};
}

}  // namespace

Values values(const std::string& path, const std::vector<std::string>& sets,
              const std::vector<std::string>& keys) {
  if (config::format_kind(config::parse_file(path)) == "mapping")
    return mapping_values(path, sets, keys);
  const auto file = experiment::load_machine_file(path, sets);
  return {experiment::values_in_si(file),
          chosen(file.experiment.origins, with_actuator(keys, file), path)};
}

std::string text_of(const Values& v, const units::ShownUnits* shown) {
  const double room = config::atmosphere_of(v.in_si);
  report::TextTable table(
      {"key", "as written", shown ? shown->text() : "SI", "", "range", "where", "source"});
  for (const config::Origin& o : v.origins) {
    const std::string other =
        shown ? shown_text(v.in_si, o, *shown, room) : rounded_text(v.in_si, o);
    const std::string range = fmt::format("{}", fmt::join(o.range, " to "));
    table.add({o.path, o.text, other == o.text ? "" : other, mark(o), range, place(o), o.source});
  }
  return table.text();
}

std::string json_of(const Values& v) {
  const auto json = [&](const config::Origin& origin) { return to_json(origin, v.in_si); };
  return Json::array(v.origins, json).text();
}

}  // namespace sinew::files
