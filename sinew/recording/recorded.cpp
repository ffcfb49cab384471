#include "sinew/recording/recorded.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/config/utf8.h"
#include "sinew/log/mcap.h"
#include "sinew/log/reader.h"
#include "sinew/recording/matlab.h"
#include "sinew/recording/number.h"
#include "sinew/recording/raw_table.h"
#include "sinew/recording/stamp.h"

namespace sinew::recording {

namespace {

// Times of a log count from the start of a run or, in most other programs' logs, since 1970; larger
// times than this are since 1970.
constexpr std::int64_t since_1970 = 31'536'000'000'000'000;  // one year [ns]

std::string first_bytes(const std::string& path) {
  std::string bytes(64, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

// Adds the columns of one clock; times count from `origin` if the clock has one.
void add_clock(RawTable& table, std::optional<std::int64_t> origin, Recorded& out) {
  Clock clock{.column = table.clock,
              .origin = origin,
              .has_date = table.has_date,
              .zone = table.zone,
              .headings = std::move(table.clock_headings)};
  const std::int64_t late = origin && table.instant ? *table.instant - *origin : 0;
  const double first = origin ? 0 : table.first;
  clock.time_ns.reserve(table.time.size());
  for (const double t : table.time) clock.time_ns.push_back(late + std::llround(1e9 * (first + t)));
  out.clocks.push_back(std::move(clock));
  for (RawColumn& column : table.columns)
    out.columns.push_back(
        {{column}, out.clocks.size() - 1, signals::Column(std::move(column.values))});
}

Recorded read_text(const std::string& path, const Mapping& mapping,
                   std::atomic<std::int64_t>* read) {
  Source source = source_of(path, mapping);
  source.read = read;
  for (const ColumnMapping& c : mapping.columns)
    if (!c.unit.empty()) source.clock_units[c.name] = c.unit;
  RawTable table = read_table(source);
  if (table.rows() == 0 && !source.where.empty())
    config::fail({path, 0, 0}, "where", "no row that meets it", "values that some rows have");
  if (table.time.empty())
    config::fail({path, 0, 0}, "time", "no column of times",
                 "one that is called time, t or Zeit, or dates",
                 "names.time=NAME, or rate=\"100 Hz\"");
  Recorded out{
      .file = path, .kind = "CSV", .started = table.start, .header_line = table.header_line};
  out.notes = std::move(table.notes);
  const std::optional<std::int64_t> origin = table.instant;
  add_clock(table, origin, out);
  for (RawTable& further : table.further) {
    out.notes.insert(out.notes.end(), further.notes.begin(), further.notes.end());
    add_clock(further, origin, out);
  }
  return out;
}

// Converts times since 1970 to times since the log's first message.
void count_from_the_first(Recorded& log) {
  std::optional<std::int64_t> first;
  for (const Clock& clock : log.clocks)
    if (!clock.time_ns.empty())
      first = std::min(first.value_or(clock.time_ns.front()), clock.time_ns.front());
  if (!first || *first < since_1970) return;
  for (Clock& clock : log.clocks) {
    signals::Times since(clock.time_ns.file());
    for (const std::int64_t t : clock.time_ns) since.push_back(t - *first);
    clock.time_ns = std::move(since);
    clock.origin = *first;
    clock.zone = 0;
  }
  log.started = iso_text(*first) + "Z";
}

Recorded read_mcap(const std::string& path) {
  const signals::Table table = log::read(path);
  Recorded out{.file = path, .kind = "MCAP", .complete = table.complete};
  if (table.series.empty())
    config::fail({path, 0, 0}, "", "a log without a topic of numbers in JSON",
                 "topics with a JSON schema and messages in JSON",
                 "the program that wrote it to export CSV");
  if (!table.complete)
    out.notes.push_back("it was cut off or is damaged; everything before is there");
  for (const signals::Series& s : table.series) {
    out.clocks.push_back({.column = s.topic.name, .time_ns = s.time_ns});
    for (std::size_t f = 0; f < s.columns.size(); ++f) {
      const signals::Field& field = s.topic.fields[f];
      const bool whole = s.columns.size() == 1 && field.name == "value";
      const std::string name = whole ? s.topic.name : s.topic.name + "." + field.name;
      out.columns.push_back({{.name = config::without_controls(name), .unit = field.unit},
                             out.clocks.size() - 1,
                             s.columns[f]});
    }
  }
  count_from_the_first(out);
  return out;
}

// Refuses settings that apply only to text tables.
void refuse_table_settings(const std::string& path, const char* kind, const Mapping& mapping) {
  if (!mapping.where.empty())
    config::fail({path, 0, 0}, "where", fmt::format("rows of {}", kind),
                 "a table of text, of which rows are chosen");
}

}  // namespace

Source source_of(const std::string& path, const Mapping& mapping) {
  Source out{.path = path};
  out.columns = mapping.table.columns;
  out.encoding = mapping.table.encoding;
  out.decimal = mapping.table.decimal;
  out.thousands = mapping.table.thousands;
  out.dates = mapping.table.dates;
  out.spread_times = mapping.table.spread_times;
  out.drop_incomplete = mapping.table.drop_incomplete;
  out.part = mapping.table.part;
  out.rate = mapping.clock.rate;
  if (!mapping.clock.column.empty()) {
    out.names["time"] = mapping.clock.column;
    if (!mapping.clock.unit.empty()) out.units[mapping.clock.column] = mapping.clock.unit;
  }
  for (const WhereMapping& w : mapping.where) out.where[w.column] = w.values;
  return out;
}

Recorded read_recording(const std::string& path, const Mapping& mapping,
                        std::atomic<std::int64_t>* read) {
  const std::string bytes = first_bytes(path);
  if (bytes.starts_with(log::kMagic)) {
    refuse_table_settings(path, "an MCAP log", mapping);
    return read_mcap(path);
  }
  if (is_matlab(bytes) || std::filesystem::path(path).extension() == ".mat") {
    refuse_table_settings(path, "a MAT file", mapping);
    return read_matlab(path, mapping.clock);
  }
  return read_text(path, mapping, read);
}

bool Stated::is_for(const std::string& file) const {
  return std::filesystem::path(file).filename().string().find(part) != std::string::npos;
}

Stated stated_in(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    config::fail({"values", 0, 0}, "", config::in_quotes(text),
                 "NAME=VALUE or PART:NAME=VALUE, such as \"pressure=2 bar gauge\"");
  const std::string name = text.substr(0, equals);
  const std::size_t colon = name.find(':');
  if (colon == name.npos) return {"", name, text.substr(equals + 1)};
  return {name.substr(0, colon), name.substr(colon + 1), text.substr(equals + 1)};
}

void add_stated(const std::vector<std::string>& values, Recorded& file) {
  for (const std::string& text : values) {
    const Stated stated = stated_in(text);
    if (!stated.is_for(file.file) || file.clocks.empty()) continue;
    const std::size_t blank = std::min(stated.value.find(' '), stated.value.size());
    const auto number = number_in(stated.value.substr(0, blank));
    if (!number)
      config::fail({"values", 0, 0}, "", config::in_quotes(text),
                   "a number with its unit, such as \"/muscle/flexor/pressure=2 bar gauge\"");
    const std::size_t rows = file.clocks.front().time_ns.size();
    const Heading heading{.name = stated.name,
                          .unit = blank < stated.value.size() ? stated.value.substr(blank + 1) : "",
                          .column = 0};
    file.columns.push_back(
        {{heading}, 0, signals::Column(std::vector<double>(rows, *number)), true});
  }
}

void check_stated(const std::vector<std::string>& values, const std::vector<std::string>& files) {
  for (const std::string& text : values) {
    const Stated stated = stated_in(text);
    if (!std::ranges::any_of(files, [&](const std::string& f) { return stated.is_for(f); }))
      config::fail({"values", 0, 0}, "", config::in_quotes(text),
                   "a part of the name of one of the files before the colon");
  }
}

}  // namespace sinew::recording
