#include "sinew/recording/match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "sinew/config/quantity.h"
#include "sinew/config/spelling.h"

namespace sinew::recording {

namespace {

constexpr std::size_t most_names = 20;  // that a message lists

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i)
    out += (i > 0 ? ", " : "") + names[i];
  return names.size() > most_names ? fmt::format("{} and {} more", out, names.size() - most_names)
                                   : out;
}

std::string near(std::string_view word, const std::vector<std::string>& names) {
  return config::closest_in_quotes(word, {names.begin(), names.end()});
}

// "/recorded/Kraft_A" of "Kraft A": what a topic's name can hold.
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
        topics_(topics),
        names_(topics),
        atmosphere_(atmosphere),
        at_end_(at_end) {
    out_.topics.assign(topics.begin(), topics.end());
    out_.unused.resize(files.size());
    out_.used = mapping;
    out_.used.columns.clear();
  }

  Matches take() {
    check_columns();
    for (std::size_t f = 0; f < files_.size(); ++f)
      for (std::size_t c = 0; c < files_[f].columns.size(); ++c) column(f, c);
    check_clocks();
    if (!problems_.empty()) throw config::Error(problems_);
    if (out_.columns.empty()) nothing_matched();
    return std::move(out_);
  }

 private:
  void problem(std::string file, std::string key, std::string found, std::string expected,
               std::string try_this = "") {
    config::Problem& problem = problems_.emplace_back();
    problem.where.file = std::move(file);
    problem.key = std::move(key);
    problem.found = std::move(found);
    problem.expected = std::move(expected);
    problem.try_this = std::move(try_this);
  }

  std::vector<std::string> all_columns() const {
    std::vector<std::string> out;
    for (const Recorded& file : files_)
      for (const RecordedColumn& column : file.columns)
        if (std::ranges::find(out, column.name) == out.end()) out.push_back(column.name);
    return out;
  }

  // Every row of the mapping has to find its column, and its channel.
  void check_columns() {
    const std::vector<std::string> all = all_columns();
    for (const ColumnMapping& c : mapping_.columns) {
      const bool there = std::ranges::any_of(files_, [&](const Recorded& file) {
        return file.find(c.name) || std::ranges::count(file.clocks, c.name, &Clock::column) > 0;
      });
      if (!there)
        problem(files_.size() == 1 ? files_.front().file : "names", "",
                fmt::format("no column {} among {}", config::in_quotes(c.name), listed(all)),
                "a column of the recording", near(c.name, all));
      if (c.channel.empty() || c.channel.starts_with("/recorded/") || names_.exact(c.channel))
        continue;
      problem("names", "", config::in_quotes(c.channel),
              fmt::format("a channel of this machine, such as {}", some_channels()),
              near(c.channel, names_.all()));
    }
  }

  // Those that are measured, and not the many others.
  std::string some_channels() const {
    std::vector<std::string> some;
    for (const std::string& name : names_.all())
      if (name.starts_with("/joint/") || name.starts_with("/muscle/") ||
          name.starts_with("/stand/"))
        some.push_back(name);
    if (some.size() > 8) some.resize(8);
    return listed(some.empty() ? names_.all() : some);
  }

  const ColumnMapping* row_for(const Recorded& file, const RecordedColumn& column) const {
    for (const ColumnMapping& c : mapping_.columns)
      if (file.find(c.name) == &column) return &c;
    return nullptr;
  }

  void column(std::size_t f, std::size_t c) {
    const Recorded& file = files_[f];
    const RecordedColumn& column = file.columns[c];
    const ColumnMapping* row = row_for(file, column);
    ColumnMapping use = row ? *row : ColumnMapping{.name = column.name};
    const std::string unit = use.unit.empty() ? column.unit : use.unit;
    const std::optional<Target> target = target_of(use, unit);
    if (!target) {
      out_.unused[f].push_back(column.name);
      return;
    }
    if (!is_free(*target, f, column)) return;
    const std::size_t before = problems_.size();
    Matched matched{f, c, *target, conversion(file, column, use, unit, *target)};
    if (problems_.size() > before) return;
    out_.columns.push_back(matched);
    if (std::ranges::find(out_.used.columns, use.channel, &ColumnMapping::channel) ==
        out_.used.columns.end())
      out_.used.columns.push_back(std::move(use));
  }

  // Fills in the channel that it finds.
  std::optional<Target> target_of(ColumnMapping& use, const std::string& unit) {
    if (use.channel.starts_with("/recorded/")) return added(use.channel, unit);
    std::optional<Target> found = names_.exact(use.channel.empty() ? use.name : use.channel);
    if (!found && use.channel.empty()) {
      found = names_.obvious(use.name, unit);
      if (found) out_.guessed.push_back(fmt::format("{} is {}", use.name, names_.name_of(*found)));
    }
    if (!found && use.channel.empty() && mapping_.keep_others) {
      use.channel = recorded_name(use.name);
      return added(use.channel, unit);
    }
    if (found) use.channel = names_.name_of(*found);
    return found;
  }

  Target added(const std::string& name, const std::string& unit) {
    const auto at = std::ranges::find(out_.topics, name, &signals::Topic::name);
    if (at != out_.topics.end()) return {static_cast<std::size_t>(at - out_.topics.begin()), 0};
    out_.topics.push_back({name,
                           "recorded elsewhere; no channel of this machine",
                           {{"value", unit.empty() ? "1" : unit}}});
    return {out_.topics.size() - 1, 0};
  }

  // Within a file a channel has one column; in several files only where they follow each other.
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

  std::string name_of(Target t) const {
    const signals::Topic& topic = out_.topics[t.topic];
    return topic.fields.size() > 1 ? topic.name + "." + topic.fields[t.field].name : topic.name;
  }

  Scaling conversion(const Recorded& file, const RecordedColumn& column, const ColumnMapping& use,
                     const std::string& unit, Target target) {
    const std::string& wanted = out_.topics[target.topic].fields[target.field].unit;
    const bool raw = out_.topics[target.topic].name.starts_with("/recorded/");
    const bool bare = unit.empty() && (wanted == "1" || wanted == "count");
    Scaling out;
    if (unit != wanted && !raw && !bare) out = by_units(file, column, unit, target);
    if (use.scale != 1) {
      out.slope *= use.scale;
      out.same = false;
    }
    if (!use.offset.empty()) {
      const std::string quantity(
          config::difference_unit(quantity_unit(out_.topics[target.topic], target.field)));
      const config::Parsed added = config::parse_quantity(use.offset, quantity, atmosphere_);
      if (added.mistake)
        problem(file.file, fmt::format("{}.offset", use.name), added.mistake->found,
                added.mistake->expected, added.mistake->try_this);
      out.offset += added.si;
      out.same = false;
    }
    return out;
  }

  Scaling by_units(const Recorded& file, const RecordedColumn& column, const std::string& unit,
                   Target target) {
    const std::string wanted = quantity_unit(out_.topics[target.topic], target.field);
    const auto parse = [&](int number, const std::string& in) {
      return config::parse_quantity(fmt::format("{} {}", number, in), wanted, atmosphere_);
    };
    // As it is written, or as others write it: psig.
    for (const config::Spelling& meant : config::spellings(unit)) {
      const config::Parsed zero = parse(0, meant.unit), one = parse(1, meant.unit);
      if (zero.mistake) continue;
      const double slope = (one.si - zero.si) * meant.factor;
      return {slope, zero.si, slope == 1 && zero.si == 0};
    }
    const config::Parsed zero = parse(0, unit);
    const std::string expected =
        fmt::format("{}, for {}", config::describe_unit(wanted), name_of(target));
    const std::string usual = config::usual_units(wanted).front();
    if (unit.empty() && column.stated)
      problem(file.file, column.name, "a stated number without a unit", expected,
              fmt::format("a value such as \"{}={} {}\"", column.name,
                          config::format_number(column.values.front()), usual));
    else if (unit.empty())
      problem(file.file, column.name, "a column without a unit", expected,
              fmt::format("units.{}={}", column.name, usual));
    else
      problem(file.file, column.name, fmt::format("the unit {}", config::in_quotes(unit)), expected,
              without_number(zero.mistake->try_this));
    return {};
  }

  // Turns what a quantity is told to try into words for a unit alone: "0 kPa gauge" -> "kPa gauge".
  static std::string without_number(std::string text) {
    for (std::size_t at = 0; (at = text.find("\"0 ", at)) != text.npos;) text.erase(at + 1, 2);
    return text;
  }

  // The fields of a topic are of one instant.
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

  [[noreturn]] void nothing_matched() const {
    config::fail({files_.front().file, 0, 0}, "",
                 fmt::format("no column that is a channel of this machine by its name: {}",
                             listed(all_columns())),
                 fmt::format("columns for channels such as {}", some_channels()),
                 "names.CHANNEL=COLUMN for each, or a mapping's file");
  }

  const std::vector<Recorded>& files_;
  const Mapping& mapping_;
  std::span<const signals::Topic> topics_;
  ChannelNames names_;
  double atmosphere_;
  bool at_end_;
  Matches out_;
  std::vector<config::Problem> problems_;
};

}  // namespace

Matches match(const std::vector<Recorded>& files, const Mapping& mapping,
              std::span<const signals::Topic> topics, double atmosphere, bool at_end) {
  return Matcher(files, mapping, topics, atmosphere, at_end).take();
}

}  // namespace sinew::recording
