#include "sinew/recording/mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/problems.h"
#include "sinew/config/quantity.h"
#include "sinew/config/reader.h"
#include "sinew/recording/mapping.fields.h"

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
    problems.add(0, 0, at + "scale", config::format_number(row.scale),
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
  config::Problems problems(file);
  for (std::size_t i = 0; i < mapping.columns.size(); ++i) check_row(mapping.columns, i, problems);
  if (!mapping.clock.column.empty() && !mapping.clock.rate.empty())
    problems.add(
        0, 0, "clock.rate",
        fmt::format("{} together with clock.column {}", config::in_quotes(mapping.clock.rate),
                    config::in_quotes(mapping.clock.column)),
        "one of the two: a column with times, or a rate");
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

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    out += c;
  }
  return out + '"';
}

// Writes lines `key = "value"  # comment`, except for empty values.
class Lines {
 public:
  void comment(const std::string& text) { out_ += "# " + text + "\n"; }
  void head(const std::string& text) { out_ += "\n" + text + "\n"; }
  void text(const char* key, const std::string& value, const char* what = "") {
    if (!value.empty()) put(key, quoted(value), what);
  }
  void number(const char* key, double value, double unless, const char* what = "") {
    if (value != unless) put(key, config::format_number(value), what);
  }
  void flag(const char* key, bool value, const char* what = "") {
    if (value) put(key, "true", what);
  }
  void put(const char* key, const std::string& value, const char* what = "") {
    out_ += fmt::format("{} = {}", key, value);
    out_ += *what ? fmt::format("  # {}\n", what) : "\n";
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

void put_table(const TableSettings& t, Lines& out) {
  if (t.encoding.empty() && t.decimal.empty() && t.thousands.empty() && t.dates.empty() &&
      !t.spread_times && !t.drop_incomplete && t.columns.empty())
    return;
  out.head("[table]  # how the file is written, where it does not show it");
  out.text("encoding", t.encoding);
  out.text("decimal", t.decimal);
  out.text("thousands", t.thousands);
  out.text("dates", t.dates);
  out.flag("spread_times", t.spread_times);
  out.flag("drop_incomplete", t.drop_incomplete);
  std::string names;
  for (const std::string& name : t.columns) names += (names.empty() ? "" : ", ") + quoted(name);
  if (!names.empty()) out.put("columns", "[" + names + "]", "the file has no header");
}

void put_clock(const ClockMapping& c, Lines& out) {
  if (c.column.empty() && c.unit.empty() && c.rate.empty() && c.scale == 1 && c.start.empty())
    return;
  out.head("[clock]");
  out.text("column", c.column, "the times");
  out.text("unit", c.unit);
  out.text("rate", c.rate, "of the rows");
  out.number("scale", c.scale, 1, "true seconds in a second of this clock");
  out.text("start", c.start, "becomes the log's time 0");
}

}  // namespace

std::string text_of(const Mapping& mapping) {
  Lines out;
  out.put("format", "\"sinew.mapping/1\"");
  out.comment("What the columns of a recording mean: value = scale x number [unit] + offset.");
  out.comment("docs/reference/keys.md has every key.");
  if (mapping.keep_others) out.head("keep_others = true  # columns without a channel: /recorded/…");
  put_table(mapping.table, out);
  put_clock(mapping.clock, out);
  for (const WhereMapping& w : mapping.where) {
    out.head("[[where]]  # only rows in which this column has one of these values");
    out.put("column", quoted(w.column));
    out.put("values", quoted(w.values));
  }
  for (const ColumnMapping& c : mapping.columns) {
    out.head("[[column]]");
    out.put("name", quoted(c.name));
    out.text("channel", c.channel);
    out.text("unit", c.unit);
    out.number("scale", c.scale, 1);
    out.text("offset", c.offset);
  }
  return out.take();
}

}  // namespace sinew::recording
