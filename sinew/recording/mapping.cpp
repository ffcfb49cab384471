#include "sinew/recording/mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/reader.h"
#include "sinew/config/write/writer.h"
#include "sinew/recording/mapping.fields.h"
#include "sinew/units/each_field.h"
#include "sinew/units/quantity.h"

namespace sinew::recording {

Mapping load_mapping(const std::string& path) {
  const config::Node root = config::compose(path);
  if (config::format_kind(root) != "mapping")
    config::fail({path, 0, 0}, "format", config::in_quotes(config::format_kind(root)),
                 "\"sinew.mapping/1\"");
  Mapping out;
  config::Reader reader(root);
  std::string format;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  fields(reader, out);
  reader.finish();
  check_mapping(out, path);
  return out;
}

namespace {

void check_row(const std::vector<ColumnMapping>& rows, std::size_t i, config::Problems& problems) {
  const ColumnMapping& row = rows[i];
  const std::string at = fmt::format("column[{}].", i);
  if (!row.channel.empty() && !row.channel.starts_with('/'))
    problems.add(0, 0, at + "channel", config::in_quotes(row.channel),
                 "a channel, which begins with /", "\"/" + row.channel + "\"");
  if (row.scale == 0 || !std::isfinite(row.scale))
    problems.add(0, 0, at + "scale", units::format_number(row.scale),
                 "a finite number that is not 0");
  for (std::size_t k = 0; k < i; ++k) {
    if (rows[k].name == row.name)
      problems.add(0, 0, at + "name", fmt::format("{} a second time", config::in_quotes(row.name)),
                   "one row for a column");
    if (!row.channel.empty() && rows[k].channel == row.channel)
      problems.add(0, 0, at + "channel", fmt::format("{} a second time", row.channel),
                   fmt::format("one column for it: {} or {}", rows[k].name, row.name));
  }
}

}  // namespace

void check_mapping(const Mapping& mapping, const std::string& file) {
  config::Problems problems(file, std::numeric_limits<std::size_t>::max());
  for (std::size_t i = 0; i < mapping.columns.size(); ++i) check_row(mapping.columns, i, problems);
  if (!mapping.clock.column.empty() && !mapping.clock.rate.empty())
    problems.add(
        0, 0, "clock.rate",
        fmt::format("{} together with clock.column {}", config::in_quotes(mapping.clock.rate),
                    config::in_quotes(mapping.clock.column)),
        "one of the two: a column with times, or a rate");
  // A file's own scale was checked when it was read.
  const double scale = mapping.clock.scale;
  if (!(scale >= least_clock_scale && scale <= most_clock_scale))
    config::fail(
        {"clock_scale", 0, 0}, "", units::format_number(scale),
        fmt::format("from {:g} to {:g}: {}", least_clock_scale, most_clock_scale, clock_scale_why));
  problems.finish();
}

namespace {

ColumnMapping& row_of(Mapping& mapping, const std::string& column) {
  const auto row = std::ranges::find(mapping.columns, column, &ColumnMapping::name);
  if (row != mapping.columns.end()) return *row;
  return mapping.columns.emplace_back(ColumnMapping{.name = column});
}

template <class T>
void take(T& first, const T& second) {
  if (!(second == T{})) first = second;
}

void take_scale(double& first, double second) {
  if (second != 1) first = second;
}

}  // namespace

Mapping merged(Mapping first, const Mapping& second) {
  take(first.table.encoding, second.table.encoding);
  take(first.table.decimal, second.table.decimal);
  take(first.table.thousands, second.table.thousands);
  take(first.table.dates, second.table.dates);
  take(first.table.spread_times, second.table.spread_times);
  take(first.table.drop_incomplete, second.table.drop_incomplete);
  take(first.table.columns, second.table.columns);
  // A rate replaces a column, and a column replaces a rate.
  if (!second.clock.rate.empty()) first.clock.column.clear();
  if (!second.clock.column.empty()) first.clock.rate.clear();
  take(first.clock.column, second.clock.column);
  take(first.clock.unit, second.clock.unit);
  take(first.clock.rate, second.clock.rate);
  take_scale(first.clock.scale, second.clock.scale);
  take(first.clock.start, second.clock.start);
  for (const WhereMapping& w : second.where) {
    std::erase_if(first.where, [&](const WhereMapping& old) { return old.column == w.column; });
    first.where.push_back(w);
  }
  for (const ColumnMapping& c : second.columns) {
    if (!c.channel.empty())
      std::erase_if(first.columns, [&](const ColumnMapping& old) {
        return old.channel == c.channel && old.name != c.name;
      });
    ColumnMapping& row = row_of(first, c.name);
    take(row.channel, c.channel);
    take(row.unit, c.unit);
    take_scale(row.scale, c.scale);
    take(row.offset, c.offset);
  }
  first.keep_others = first.keep_others || second.keep_others;
  return first;
}

void map_channel(Mapping& mapping, const std::string& channel, const std::string& column) {
  if (channel == "time") {
    mapping.clock.column = column;
    return;
  }
  std::string& its = row_of(mapping, column).channel;
  if (!its.empty() && its != channel)
    config::fail({"names", 0, 0}, "", fmt::format("{} for {} and {}", column, its, channel),
                 "one channel for a column");
  its = channel;
}

void map_unit(Mapping& mapping, const std::string& column, const std::string& unit) {
  row_of(mapping, column).unit = unit;
}

void map_scale(Mapping& mapping, const std::string& column, double scale) {
  row_of(mapping, column).scale = scale;
}

void map_offset(Mapping& mapping, const std::string& column, const std::string& offset) {
  row_of(mapping, column).offset = offset;
}

void map_where(Mapping& mapping, const std::string& column, const std::string& values) {
  mapping.where.push_back({column, values});
}

namespace {

// Returns a value as TOML; empty if it is the default.
std::string text_of(const units::VisitedField& f) {
  if (f.text) return f.text->empty() ? "" : config::toml_string(*f.text);
  if (f.number) return *f.number == 1 ? "" : units::format_number(*f.number);  // a scale
  if (f.flag) return *f.flag ? "true" : "";
  std::string items;
  for (const std::string& item : *f.texts)
    items += (items.empty() ? "" : ", ") + config::toml_string(item);
  return items.empty() ? "" : fmt::format("[{}]", items);
}

}  // namespace

std::string text_of(const Mapping& mapping) {
  using Type = units::FieldType;
  std::string top =
      "format = \"sinew.mapping/1\"\n"
      "# What the columns of a recording mean: value = scale x number [unit] + offset.\n"
      "# docs/reference/keys.md has every key.\n";
  std::string tables, heading;  // heading of a table without a key so far
  units::EachField visitor([&](const units::VisitedField& f) {
    if (f.type == Type::list) return;
    if (f.type == Type::table || f.type == Type::item) {
      heading = f.type == Type::item ? fmt::format("\n[[{}]]\n", f.field.name)
                                     : fmt::format("\n[{}]  # {}\n", f.name, f.field.doc);
      return;
    }
    const std::string value = text_of(f);
    if (value.empty()) return;
    if (f.depth > 0) tables += std::exchange(heading, "");
    (f.depth > 0 ? tables : top) += fmt::format("{} = {}  # {}\n", f.name, value, f.field.doc);
  });
  Mapping visited = mapping;  // visitors take fields by non-const reference
  fields(visitor, visited);
  return top + tables;
}

}  // namespace sinew::recording
