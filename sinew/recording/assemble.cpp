#include "sinew/recording/assemble.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/columns.h"
#include "sinew/recording/sampled_valves.h"
#include "sinew/recording/stamp.h"
#include "sinew/units/quantity.h"
#include "sinew/units/spelling.h"
#include "sinew/units/unit.h"

namespace sinew::recording {
namespace {

constexpr double pressure_noise = 2e3;  // largest noise of a sensor at a vacuum [Pa]

// --- matching of columns to channels, and conversion of their numbers ---

// A column with its channel.
struct Matched {
  std::size_t file = 0, column = 0;
  Target target;
  Conversion conversion;
};

// Matched columns, and the names of columns without a channel.
struct Matches {
  std::vector<Matched> columns;
  std::vector<std::vector<std::string>> unused;  // columns' names, by file
  Mapping used;                                  // a row for each matched column
  std::vector<std::string> guessed;              // "elbow_angle is /joint/elbow/angle"
  std::vector<signals::Topic> topics;            // the machine's, followed by /recorded/…
};

constexpr std::size_t most_names = 20;  // maximum number in a message

// Returns a valid topic name for a column: "Kraft A" -> "/recorded/Kraft_A".
std::string recorded_name(std::string_view name) {
  std::string out = "/recorded/";
  while (name.starts_with('/')) name.remove_prefix(1);
  for (const char c : name) out += c == ' ' || c == '\t' || c == '.' ? '_' : c;
  return out;
}

class Matcher {
 public:
  Matcher(const std::vector<Recorded>& files, const Mapping& mapping,
          std::span<const signals::Topic> topics, double atmosphere, bool at_end)
      : files_(files),
        mapping_(mapping),
        channels_(topics),
        atmosphere_(atmosphere),
        at_end_(at_end),
        problems_(files.front().file) {
    out_.topics.assign(topics.begin(), topics.end());
    out_.unused.resize(files.size());
    out_.used = mapping;
    out_.used.columns.clear();
    for (const ColumnMapping& c : mapping.columns) {
      const auto channel = channels_.exact(c.channel);
      if (channel) names_[channels_.name_of(*channel)] = c.name;
      if (!c.unit.empty()) units_[c.name] = c.unit;
    }
    for (const Recorded& file : files) headers_.push_back(file.header());
  }

  Matches take() {
    check_mapping();
    for (std::size_t f = 0; f < files_.size(); ++f)
      for (std::size_t c = 0; c < files_[f].columns.size(); ++c) column(f, c);
    check_clocks();
    check_pressures();
    problems_.finish();
    if (out_.columns.empty()) nothing_matched();
    return std::move(out_);
  }

 private:
  void problem(std::string file, std::string key, std::string found, std::string expected,
               std::string try_this = "") {
    problems_.add({{std::move(file), 0, 0},
                   std::move(key),
                   std::move(found),
                   std::move(expected),
                   std::move(try_this)});
  }

  ColumnResolver resolver(const Header& header) {
    return {header, names_, units_, atmosphere_, problems_};
  }

  WantedColumn wanted(Target target) const {
    const signals::Topic& topic = out_.topics[target.topic];
    return {name_of(target), quantity_unit(topic, target.field), "a channel of this machine"};
  }

  // Returns the header of the only file, or else the columns of all files.
  Header all_columns() const {
    if (headers_.size() == 1) return headers_.front();
    Header out{.file = "names"};
    for (const Header& header : headers_)
      out.columns.insert(out.columns.end(), header.columns.begin(), header.columns.end());
    return out;
  }

  // Requires that each row of the mapping names an existing column and channel.
  void check_mapping() {
    const Header all = all_columns();
    for (const ColumnMapping& c : mapping_.columns) {
      const auto channel = channels_.exact(c.channel);
      const bool is_clock = std::ranges::any_of(files_, [&](const Recorded& file) {
        return std::ranges::any_of(file.clocks,
                                   [&](const Clock& clock) { return clock.is_called(c.name); });
      });
      const bool is_there = is_clock || std::ranges::any_of(headers_, [&](const Header& header) {
                              return header.find(c.name).has_value();
                            });
      if (!is_there && channel)
        resolver(all).refuse_missing(wanted(*channel));
      else if (!is_there)
        check_columns(all, c.unit.empty() ? "names" : "units", {{c.name, c.unit}}, problems_);
      if (!c.channel.empty() && !c.channel.starts_with("/recorded/") && !channel)
        problem(
            "names", "", config::in_quotes(c.channel),
            fmt::format("a channel of this machine, such as {}", some_channels()),
            config::closest_in_quotes(c.channel, {channels_.all().begin(), channels_.all().end()}));
    }
  }

  // Lists only measured channels, those of joints, muscles and stands, if there are any.
  std::string some_channels() const {
    std::vector<std::string> some;
    for (const std::string& name : channels_.all())
      if (name.starts_with("/joint/") || name.starts_with("/muscle/") ||
          name.starts_with("/stand/"))
        some.push_back(name);
    if (some.size() > 8) some.resize(8);
    return config::listed(some.empty() ? channels_.all() : some, most_names);
  }

  void column(std::size_t f, std::size_t c) {
    const RecordedColumn& column = files_[f].columns[c];
    const auto row = std::ranges::find_if(
        mapping_.columns, [&](const ColumnMapping& r) { return headers_[f].find(r.name) == c; });
    ColumnMapping use = row == mapping_.columns.end() ? ColumnMapping{.name = column.name} : *row;
    const std::string unit = use.unit.empty() ? column.unit : use.unit;
    const std::optional<Target> target = target_of(use, unit);
    if (!target) {
      out_.unused[f].push_back(column.name);
      return;
    }
    if (!is_free(*target, f, column)) return;
    const std::size_t before = problems_.count();
    Matched matched{f, c, *target, conversion(f, c, use, unit, *target)};
    if (problems_.count() > before) return;
    out_.columns.push_back(matched);
    if (std::ranges::find(out_.used.columns, use.channel, &ColumnMapping::channel) ==
        out_.used.columns.end())
      out_.used.columns.push_back(std::move(use));
  }

  // Returns the column's channel and stores its name in `use`.
  std::optional<Target> target_of(ColumnMapping& use, const std::string& unit) {
    if (use.channel.starts_with("/recorded/")) return added(use.channel, unit);
    std::optional<Target> found = channels_.exact(use.channel.empty() ? use.name : use.channel);
    if (!found && use.channel.empty()) {
      found = channels_.obvious(use.name, unit);
      if (found)
        out_.guessed.push_back(fmt::format("{} is {}", use.name, channels_.name_of(*found)));
    }
    if (!found && use.channel.empty() && mapping_.keep_others) {
      use.channel = recorded_name(use.name);
      return added(use.channel, unit);
    }
    if (found) use.channel = channels_.name_of(*found);
    return found;
  }

  Target added(const std::string& name, const std::string& unit) {
    const auto at = std::ranges::find(out_.topics, name, &signals::Topic::name);
    if (at != out_.topics.end()) return {static_cast<std::size_t>(at - out_.topics.begin()), 0};
    out_.topics.push_back({name,
                           "recorded elsewhere; no channel of this machine",
                           {{"value", unit.empty() ? "1" : own_unit(unit).shown}}});
    return {out_.topics.size() - 1, 0};
  }

  // A channel has one column in a file; several files may have it only if they are concatenated.
  bool is_free(Target target, std::size_t f, const RecordedColumn& column) {
    for (const Matched& other : out_.columns) {
      if (other.target != target || (at_end_ && other.file != f)) continue;
      const RecordedColumn& first = files_[other.file].columns[other.column];
      if (other.file == f)
        problem(files_[f].file, name_of(target),
                fmt::format("two columns for it: {} and {}", first.name, column.name), "one",
                "another channel for one of them");
      else
        problem(files_[f].file, name_of(target),
                fmt::format("a channel that {} has too", files_[other.file].file),
                "recordings of different channels, side by side",
                "to join them at their ends, where one follows the other");
      return false;
    }
    return true;
  }

  std::string name_of(Target t) const { return name_of_field(out_.topics[t.topic], t.field); }

  Conversion conversion(std::size_t f, std::size_t c, const ColumnMapping& use,
                        const std::string& unit, Target target) {
    Conversion out = by_units(f, c, unit, target);
    out.slope *= use.scale;
    if (use.offset.empty()) return out;
    const units::Parsed added = parse_offset(use.offset, wanted(target).unit, atmosphere_);
    if (added.mistake)
      problem(files_[f].file, fmt::format("{}.offset", use.name), added.mistake->found,
              added.mistake->expected, added.mistake->try_this);
    out.offset += added.si;
    return out;
  }

  Conversion by_units(std::size_t f, std::size_t c, const std::string& unit, Target target) {
    const signals::Topic& topic = out_.topics[target.topic];
    const std::string& channel_unit = topic.fields[target.field].unit;
    const bool is_bare = unit.empty() && (channel_unit == "1" || channel_unit == "count");
    if (topic.name.starts_with("/recorded/")) return kept(f, unit, target);
    if (unit == channel_unit || is_bare) return {};
    const RecordedColumn& column = files_[f].columns[c];
    const WantedColumn quantity = wanted(target);
    if (unit.empty() && column.stated) {
      problem(files_[f].file, column.name, "a stated number without a unit",
              units::describe_unit(quantity.unit),
              fmt::format("a value such as \"{}={} {}\"", column.name,
                          units::format_number(column.values.front()),
                          units::usual_units(quantity.unit).front()));
      return {};
    }
    const auto found = resolver(headers_[f]).convert(c, quantity);
    return found ? found->conversion : Conversion{};
  }

  // Returns the conversion to the unit of a kept channel, which is that of the first file with it.
  Conversion kept(std::size_t f, const std::string& unit, Target target) {
    const std::string& channel_unit = out_.topics[target.topic].fields[target.field].unit;
    const FileUnit own = own_unit(unit);
    if ((unit.empty() ? "1" : own.shown) == channel_unit) return own.conversion;
    const auto reference = [](std::string_view of) { return units::unit_and_reference(of)[1]; };
    if (units::is_unit(channel_unit) && reference(own.shown) == reference(channel_unit)) {
      const auto found = file_unit(unit, channel_unit, atmosphere_);
      if (const auto* converted = std::get_if<FileUnit>(&found)) return converted->conversion;
    }
    const auto first = std::ranges::find(out_.columns, target, &Matched::target);
    problem(files_[f].file, name_of(target),
            unit.empty() ? "a column without a unit" : "the unit " + config::in_quotes(unit),
            first == out_.columns.end()
                ? config::in_quotes(channel_unit)
                : fmt::format("{}, its unit in {}", config::in_quotes(channel_unit),
                              files_[first->file].file),
            "a common unit in both headers");
    return {};
  }

  // Requires that all fields of a topic have the same clock.
  void check_clocks() {
    std::map<std::pair<std::size_t, std::size_t>, const Matched*> first;
    for (const Matched& m : out_.columns) {
      const auto [at, is_new] = first.try_emplace({m.file, m.target.topic}, &m);
      if (is_new) continue;
      const RecordedColumn& a = files_[m.file].columns[at->second->column];
      const RecordedColumn& b = files_[m.file].columns[m.column];
      if (a.clock != b.clock)
        problem(files_[m.file].file, out_.topics[m.target.topic].name,
                fmt::format("{} and {} with times of their own", a.name, b.name),
                "fields of one topic that were sampled together");
    }
  }

  // Requires that no column of absolute pressures is below zero, beyond the noise of a sensor.
  // Gauge pressures are checked by refuse_impossible().
  void check_pressures() {
    for (const Matched& m : out_.columns) {
      if (m.target.topic >= out_.topics.size() || wanted(m.target).unit != "Pa abs") continue;
      const RecordedColumn& column = files_[m.file].columns[m.column];
      const auto [bare, reference] = units::unit_and_reference(column.unit);
      if (reference == "gauge") continue;
      const auto lowest = std::ranges::min_element(column.values, {}, [](double x) {
        return std::isnan(x) ? std::numeric_limits<double>::infinity() : x;
      });
      if (lowest == column.values.end() || !(m.conversion(*lowest) < -pressure_noise)) continue;
      problem(files_[m.file].file, column.name,
              fmt::format("an absolute pressure of {:.4g} kPa", 1e-3 * m.conversion(*lowest)),
              "none below 0, which is a vacuum",
              stated_setting("units", column.name,
                             (bare.empty() ? "kPa" : std::string(bare)) + " gauge") +
                  ", if it is counted from the atmosphere");
    }
  }

  [[noreturn]] void nothing_matched() const {
    config::fail({files_.front().file, headers_.front().line, 1}, "",
                 fmt::format("no column that is a channel of this machine by its name: {}",
                             all_columns().all_names()),
                 fmt::format("columns for channels such as {}", some_channels()),
                 "names.CHANNEL=COLUMN for each, or a mapping's file");
  }

  const std::vector<Recorded>& files_;
  const Mapping& mapping_;
  ChannelNames channels_;
  double atmosphere_;
  bool at_end_;
  std::vector<Header> headers_;  // one per file
  Names names_, units_;          // channel -> column, and column -> unit
  Matches out_;
  config::Problems problems_;
};

// Matches columns to channels. Throws config::Error with all faults.
Matches match(const std::vector<Recorded>& files, const Mapping& mapping,
              std::span<const signals::Topic> topics, double atmosphere, bool at_end) {
  return Matcher(files, mapping, topics, atmosphere, at_end).take();
}

constexpr double nanoseconds = 1e9;                // in a second
constexpr std::int64_t own_start = 1'000'000'000;  // a run's clock begins before this [ns]

// Conversion of a file's times to the table's: (t - zero) scale + shift [ns].
struct TimeConversion {
  std::int64_t zero = 0, shift = 0;
  double scale = 1;

  std::int64_t operator()(std::int64_t t) const {
    const std::int64_t since = t - zero;
    return shift + (scale == 1 ? since : std::llround(scale * static_cast<double>(since)));
  }
};

std::int64_t nanoseconds_of(const std::string& text, const std::string& key) {
  const units::Parsed parsed = units::parse_quantity(text, "s");
  if (parsed.mistake) config::fail({key, 0, 0}, "", *parsed.mistake);
  return std::llround(nanoseconds * parsed.si);
}

bool is_edges(const signals::Topic& topic) {
  return signals::is_of_valve(topic.name) && topic.name.ends_with("/open");
}

class Assembler {
 public:
  Assembler(const std::vector<Recorded>& files, const Mapping& mapping, const Joining& joining,
            Matches matches)
      : files_(files), mapping_(mapping), joining_(joining), matches_(std::move(matches)) {}

  AssembledRecording take() {
    out_.used = matches_.used;
    for (std::size_t f = 0; f < files_.size(); ++f) {
      const Recorded& file = files_[f];
      ImportSummary summary{.file = file.file, .kind = file.kind, .started = file.started};
      summary.unused = matches_.unused[f];
      for (const Clock& clock : file.clocks)
        summary.rows = std::max(summary.rows, clock.time_ns.size());
      out_.files.push_back(std::move(summary));
      for (const std::string& note : file.notes) out_.notes.push_back(file.file + ": " + note);
      out_.table.complete = out_.table.complete && file.complete;
    }
    set_clocks();
    for (std::size_t t = 0; t < matches_.topics.size(); ++t) topic(t);
    refuse_empty_files();
    mark_coarse_edges();
    report_gaps();
    add_notes();
    return std::move(out_);
  }

 private:
  // First and last time of the columns in use [ns, in the file's clock].
  struct Span {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    std::int64_t last = std::numeric_limits<std::int64_t>::min();
    std::int64_t period = 10'000'000;  // the period of the clock that ends last
    bool any() const { return first <= last; }
  };
  Span span_of(std::size_t f) const {
    Span out;
    for (const Matched& m : matches_.columns) {
      if (m.file != f) continue;
      const signals::Times& times = clock_of(m).time_ns;
      if (times.empty()) continue;
      out.first = std::min(out.first, times.front());
      if (times.back() <= out.last) continue;
      out.last = times.back();
      const std::size_t n = times.size();
      if (n > 1) out.period = (times.back() - times.front()) / static_cast<std::int64_t>(n - 1);
    }
    return out;
  }

  const Clock& clock_of(const Matched& m) const {
    const Recorded& file = files_[m.file];
    return file.clocks[file.columns[m.column].clock];
  }

  void set_clocks() {
    times_.resize(files_.size());
    find_origins();
    const std::optional<std::int64_t> wall = wall_start();
    std::int64_t end = 0;
    for (std::size_t f = 0; f < files_.size(); ++f) {
      const Span span = span_of(f);
      TimeConversion& t = times_[f];
      t.scale = mapping_.clock.scale;
      const auto shift = joining_.shifts.find(files_[f].file);
      if (shift != joining_.shifts.end()) t.shift = nanoseconds_of(shift->second, "shift");
      if (!span.any()) continue;
      t.zero = zero_of(f, span, wall);
      if (joining_.at_end && f > 0) {
        t.zero = span.first;
        t.shift += end;
      }
      end = t(span.last) + std::llround(t.scale * static_cast<double>(span.period));
    }
    note_start(wall);
  }

  // Returns the wall-clock time of the earliest sample. Absent if a file has no wall-clock time, or
  // if there is only one file.
  std::optional<std::int64_t> wall_start() const {
    std::optional<std::int64_t> first;
    if (files_.size() < 2 || joining_.at_end || !mapping_.clock.start.empty()) return first;
    for (std::size_t f = 0; f < files_.size(); ++f) {
      const Span span = span_of(f);
      if (!span.any()) continue;
      const std::optional<std::int64_t> origin = origin_of(f);
      if (!origin) return std::nullopt;
      first = std::min(first.value_or(*origin + span.first), *origin + span.first);
    }
    return first;
  }

  std::optional<std::int64_t> origin_of(std::size_t f) const { return origins_[f]; }

  const Clock& clock_of_file(std::size_t f) const {
    static const Clock none;
    return files_[f].clocks.empty() ? none : files_[f].clocks.front();
  }

  // Sets the wall-clock time of each file's time 0. Dates without a zone are assumed to be in the
  // zone of another file; times of day without a date are taken as nearest to the first file's.
  void find_origins() {
    const Clock* zoned = nullptr;
    bool dates = false, times_of_day = false;
    for (std::size_t f = 0; f < files_.size(); ++f) {
      const Clock& clock = clock_of_file(f);
      origins_.push_back(clock.origin);
      if (!clock.origin) continue;
      (clock.has_date ? dates : times_of_day) = true;
      if (clock.zone && !zoned) zoned = &clock;
    }
    constexpr std::int64_t day = 86'400'000'000'000;  // [ns]
    for (std::size_t f = 0; f < files_.size(); ++f) {
      const Clock& clock = clock_of_file(f);
      std::optional<std::int64_t>& origin = origins_[f];
      if (!origin) continue;
      if (zoned && !clock.zone && clock.has_date) {
        *origin -= *zoned->zone;
        if (!joining_.at_end)
          out_.notes.push_back(fmt::format("{}: dates without a zone, taken for those of {}",
                                           files_[f].file, zone_text(*zoned->zone)));
      }
      if (clock.has_date) continue;
      if (dates)
        origin.reset();
      else if (times_of_day && origins_[0])
        *origin -= day * std::llround(static_cast<double>(*origin - *origins_[0]) / day);
    }
  }

  std::int64_t zero_of(std::size_t f, const Span& span, std::optional<std::int64_t> wall) const {
    if (wall) return *wall - *origin_of(f);
    if (!mapping_.clock.start.empty()) return nanoseconds_of(mapping_.clock.start, "start");
    return span.first >= 0 && span.first < own_start ? 0 : span.first;
  }

  void note_start(std::optional<std::int64_t> wall) {
    const std::optional<std::int64_t> origin = origin_of(0);
    const Clock& clock = clock_of_file(0);
    if (wall || origin) {
      out_.started =
          start_text(wall ? *wall : *origin + times_[0].zero, clock.has_date, clock.zone);
    } else {
      out_.started = files_[0].started;
    }
    for (std::size_t f = 0; f < files_.size() && !wall; ++f) {
      if (f > 0 && (joining_.at_end || !mapping_.clock.start.empty())) break;
      if (times_[f].zero != 0 && !origin_of(f))
        out_.notes.push_back(
            fmt::format("{}: time 0 of the log is {} s of the recording's clock", files_[f].file,
                        units::format_number(static_cast<double>(times_[f].zero) / nanoseconds)));
      else if (f > 0 && (origin_of(f) || origin_of(0)))
        out_.notes.push_back(fmt::format(
            "{}: no common clock with {}: both begin at time 0; a shift of one of them places it",
            files_[f].file, files_[0].file));
    }
  }

  // Notes each file that overlaps in time with no other file.
  void report_gaps() {
    if (joining_.at_end) return;
    for (std::size_t f = 0; f < files_.size() && files_.size() > 1; ++f) {
      const Span span = span_of(f);
      if (!span.any()) continue;
      const std::int64_t first = times_[f](span.first), last = times_[f](span.last);
      bool any = false, meets = false;
      for (std::size_t g = 0; g < files_.size(); ++g) {
        const Span other = span_of(g);
        if (g == f || !other.any()) continue;
        any = true;
        meets = meets || (times_[g](other.first) <= last && first <= times_[g](other.last));
      }
      if (!any || meets) continue;
      out_.notes.push_back(fmt::format(
          "{}: from {} to {} s, where no other file has a sample: another zone, date or clock, "
          "unless a shift of the file places it",
          files_[f].file, units::format_number(static_cast<double>(first) / nanoseconds),
          units::format_number(static_cast<double>(last) / nanoseconds)));
    }
  }

  // Adds the samples of a topic from all files, in the order of their times.
  void topic(std::size_t t) {
    signals::Series series{matches_.topics[t], signals::Times(pages_), {}};
    series.columns.assign(series.topic.fields.size(), signals::Column(pages_));
    bool any = false;
    for (std::size_t f = 0; f < files_.size(); ++f) {
      std::vector<const Matched*> fields(series.topic.fields.size(), nullptr);
      for (const Matched& m : matches_.columns)
        if (m.file == f && m.target.topic == t) fields[m.target.field] = &m;
      if (std::ranges::all_of(fields, [](auto* m) { return m == nullptr; })) continue;
      any = true;
      if (is_edges(series.topic))
        edges(*fields[0], series);
      else
        samples(f, fields, series);
    }
    if (any) out_.table.series.push_back(std::move(series));
  }

  void samples(std::size_t f, const std::vector<const Matched*>& fields, signals::Series& series) {
    const auto given = std::ranges::find_if(fields, [](auto* m) { return m != nullptr; });
    const signals::Times& times = clock_of(**given).time_ns;
    std::vector<double> values(fields.size());
    std::size_t late = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      bool any = false;
      for (std::size_t k = 0; k < fields.size(); ++k) {
        values[k] = fields[k] ? value(*fields[k], i) : std::nan("");
        if (!std::isfinite(values[k])) continue;
        any = true;
        refuse_impossible(*fields[k], values[k], i);
      }
      const std::int64_t time = times_[f](times[i]);
      if (!any || time < 0) {
        ++out_.files[f].left_out;
        continue;
      }
      if (!series.time_ns.empty() && time <= series.time_ns.back()) {
        if (time < series.time_ns.back()) backwards(f, series, time);
        ++late;
      }
      series.time_ns.push_back(time);
      for (std::size_t k = 0; k < values.size(); ++k) series.columns[k].push_back(values[k]);
      ++out_.files[f].values;
    }
    if (late > 0)
      out_.notes.push_back(fmt::format("{}: {}: {} samples at the time of the one before",
                                       files_[f].file, series.topic.name, late));
  }

  // Refuses a file whose columns have no value in the log.
  void refuse_empty_files() const {
    for (std::size_t f = 0; f < files_.size(); ++f) {
      const Span span = span_of(f);
      const ImportSummary& summary = out_.files[f];
      if (summary.values > 0 || (!span.any() && summary.left_out == 0)) continue;
      const auto seconds = [](std::int64_t ns) {
        return units::format_number(static_cast<double>(ns) / nanoseconds);
      };
      const std::string& start = mapping_.clock.start;
      if (times_[f](span.last) >= 0)
        config::fail(
            {files_[f].file, 0, 0}, "",
            fmt::format("{} values of channels, each empty or not finite", summary.left_out),
            "a finite number in at least one row");
      const std::string last = seconds(span.last) + " s of its clock, before the log's time 0";
      config::fail({start.empty() ? files_[f].file : "start", 0, 0}, "",
                   start.empty() ? "the last sample at " + last
                                 : fmt::format("{}, and the last sample of {} at {}",
                                               config::in_quotes(start), files_[f].file, last),
                   "a time 0 within the recording");
    }
  }

  // Refuses a value that the channel's quantity cannot have.
  void refuse_impossible(const Matched& of, double value, std::size_t row) const {
    const signals::Topic& topic = matches_.topics[of.target.topic];
    if (topic.name.starts_with("/recorded/")) return;
    const bool is_pressure = topic.fields[of.target.field].unit == "Pa";
    const double vacuum = is_gauge_channel(topic.name) ? -joining_.atmosphere : 0.0;
    constexpr double of_duty = 1e-6;  // error of a duty in another unit [-]
    const bool below_vacuum = is_pressure && value < vacuum - pressure_noise;
    const bool is_no_duty =
        topic.name.ends_with("_duty") && (value < -of_duty || value > 1 + of_duty);
    if (!below_vacuum && !is_no_duty) return;
    const Recorded& file = files_[of.file];
    const RecordedColumn& column = file.columns[of.column];
    config::fail(
        {file.file, column.stated ? 0 : file.header_line, column.stated ? 0 : column.column},
        name_of_field(topic, of.target.field),
        fmt::format(
            "{}{} at {} s", units::format_number(column.values[row]),
            column.unit.empty() ? "" : " " + column.unit,
            units::format_number(static_cast<double>(clock_of(of).time_ns[row]) / nanoseconds)),
        is_pressure ? "a pressure that is not below the vacuum" : "a duty from 0 to 1",
        fmt::format("another unit, or an offset, of the column {}",
                    config::in_quotes(column.name)));
  }

  // Stores only changes of the state; the valve is shut before the first edge.
  void edges(const Matched& of, signals::Series& series) {
    const signals::Times& times = clock_of(of).time_ns;
    double before = series.columns[0].empty() ? 0.0 : series.columns[0].back();
    bool other = false;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const double number = value(of, i);
      const std::int64_t time = times_[of.file](times[i]);
      if (!std::isfinite(number) || time < 0) {
        ++out_.files[of.file].left_out;
        continue;
      }
      ++out_.files[of.file].values;
      other = other || (number != 0 && number != 1);
      const double open = number >= 0.5 ? 1 : 0;
      if (open == before) continue;
      if (!series.time_ns.empty() && time < series.time_ns.back()) backwards(of.file, series, time);
      series.time_ns.push_back(time);
      series.columns[0].push_back(open);
      before = open;
    }
    if (other)
      out_.notes.push_back(fmt::format("{}: {}: values of 0.5 and more were taken as open",
                                       files_[of.file].file, series.topic.name));
  }

  // Marks the valves of tables whose rows are too far apart to give their pulses.
  void mark_coarse_edges() {
    for (std::size_t f = 0; f < files_.size(); ++f) {
      if (files_[f].kind == "MCAP") continue;
      for (std::size_t c = 0; c < files_[f].clocks.size(); ++c) mark_coarse_edges(f, c);
    }
  }

  void mark_coarse_edges(std::size_t file, std::size_t clock) {
    const Clock& rows = files_[file].clocks[clock];
    SampledValves valves(rows.time_ns, times_[file].scale);
    std::vector<std::string> topics;
    for (const Matched& m : matches_.columns) {
      const signals::Topic& topic = matches_.topics[m.target.topic];
      const RecordedColumn& column = files_[file].columns[m.file == file ? m.column : 0];
      if (m.file != file || column.clock != clock || !is_edges(topic)) continue;
      topics.push_back(topic.name);
      valves.add([&](std::size_t row) { return value(m, row); });
    }
    if (valves.give_pulses(joining_.pulse_period)) return;
    for (signals::Series& series : out_.table.series)
      if (std::ranges::find(topics, series.topic.name) != topics.end())
        series.topic.description = signals::coarse_edges;
  }

  double value(const Matched& m, std::size_t i) const {
    return m.conversion(files_[m.file].columns[m.column].values[i]);
  }

  [[noreturn]] void backwards(std::size_t f, const signals::Series& series,
                              std::int64_t time) const {
    config::fail({files_[f].file, 0, 0}, series.topic.name,
                 fmt::format("{} s after {} s", static_cast<double>(time) / nanoseconds,
                             static_cast<double>(series.time_ns.back()) / nanoseconds),
                 "times that do not run backwards", "a cut where a new recording begins");
  }

  void add_notes() {
    for (const std::string& guess : matches_.guessed) out_.notes.push_back(guess + ", by its name");
    for (const ImportSummary& file : out_.files) {
      if (!file.unused.empty())
        out_.notes.push_back(
            fmt::format("{}: {} not a channel of this machine, left out: {}", file.file,
                        file.unused.size() == 1 ? "1 column is"
                                                : fmt::format("{} columns are", file.unused.size()),
                        config::listed(file.unused, 10)));
      if (file.left_out > 0)
        out_.notes.push_back(
            fmt::format("{}: {} of {} values left out: empty, not finite, or before time 0",
                        file.file, file.left_out, file.left_out + file.values));
    }
  }

  const std::vector<Recorded>& files_;
  const Mapping& mapping_;
  const Joining& joining_;
  Matches matches_;
  AssembledRecording out_;
  std::vector<TimeConversion> times_;                 // one per file
  std::vector<std::optional<std::int64_t>> origins_;  // one per file, on one clock [ns]
  signals::PageFile pages_ = signals::PageFile::make();
};

// Requires that no file occurs twice and that every shift names a file.
void check_files(const std::vector<Recorded>& files, const Joining& joining) {
  if (files.empty()) config::fail({"files", 0, 0}, "", "none", "a recording");
  std::vector<std::string_view> names;
  for (const Recorded& file : files) {
    if (std::ranges::find(names, file.file) != names.end())
      config::fail({file.file, 0, 0}, "", "the same file a second time", "each file once");
    names.push_back(file.file);
  }
  for (const auto& [file, shift] : joining.shifts)
    if (std::ranges::find(names, file) == names.end())
      config::fail({"shift", 0, 0}, "", config::in_quotes(file), config::either(names),
                   config::closest_in_quotes(file, names));
}

}  // namespace

AssembledRecording assemble(const std::vector<Recorded>& files, const Mapping& mapping,
                            std::span<const signals::Topic> topics, const Joining& joining) {
  check_files(files, joining);
  return Assembler(files, mapping, joining,
                   match(files, mapping, topics, joining.atmosphere, joining.at_end))
      .take();
}

}  // namespace sinew::recording
