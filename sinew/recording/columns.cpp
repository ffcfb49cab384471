#include "sinew/recording/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/config/spelling.h"
#include "sinew/recording/clock.h"
#include "sinew/recording/stated.h"
#include "sinew/units/unit.h"

namespace sinew::recording {

namespace {

// Returns a hint about a quantity as one about its unit alone: "0 kPa gauge" -> "kPa gauge".
std::string without_number(std::string text) {
  for (std::size_t at = 0; (at = text.find("\"0 ", at)) != text.npos;) text.erase(at + 1, 2);
  return text;
}

bool is_pressure(std::string_view unit) { return unit.starts_with("Pa "); }

// Returns the unit that the header has. Sinew's own channels have "Pa" alone: one that is called
// pressure is absolute, unless its name says gauge.
std::string unit_in(const Heading& h) {
  const bool channel = h.name.starts_with('/') && h.name.ends_with("pressure");
  if (!channel || h.file_unit != "Pa") return h.file_unit;
  return h.name.ends_with("/gauge_pressure") ? "Pa gauge" : "Pa abs";
}

}  // namespace

std::vector<Found> ColumnFinder::find(std::span<const Wanted> wanted) {
  std::vector<Found> out;
  const auto is_found = [&](std::string_view name) {
    return std::ranges::any_of(out, [&](const Found& f) { return f.wanted->name == name; });
  };
  for (const Wanted& w : wanted) {
    if (w.replaces.empty() || !is_found(w.replaces))
      find_one(w, out);
    else
      refuse_beside_stated(w, out);
  }
  check_names(wanted);
  return out;
}

std::vector<std::string_view> ColumnFinder::names() const {
  std::vector<std::string_view> out;
  for (const Heading& h : grid_.headings()) {
    out.push_back(h.name);
    if (!h.at_name.empty()) out.push_back(h.at_name);
  }
  return out;
}

// A column would be left out unnoticed where a value is stated for what it replaces.
void ColumnFinder::refuse_beside_stated(const Wanted& w, const std::vector<Found>& found) {
  const auto at =
      std::ranges::find_if(found, [&](const Found& f) { return f.wanted->name == w.replaces; });
  const bool has_column =
      std::ranges::any_of(grid_.headings(), [&](const Heading& h) { return h.is_called(w.name); });
  if (at->index < grid_.headings().size() || !has_column) return;
  problems_.add(grid_.header_line(), 1, std::string(w.name),
                fmt::format("a column, and a value of {} for the whole file", w.replaces),
                "one of the two");
}

void ColumnFinder::find_one(const Wanted& w, std::vector<Found>& out) {
  const auto mapped = source_.names.find(std::string(w.name));
  const bool said = mapped != source_.names.end();
  const std::string name = said ? mapped->second : std::string(w.name);
  const bool header_rate = grid_.dialect.period > 0 && (!said || name == grid_.headings()[0].name);
  if (find_stated(w, out)) return;
  if (w.name == "time" && (!source_.rate.empty() || header_rate)) {
    out.push_back({.wanted = &w, .index = grid_.headings().size()});  // no column has its values
    return;
  }
  for (std::size_t i = 0; i < grid_.headings().size(); ++i) {
    const Heading& h = grid_.headings()[i];
    const bool at = h.at_name == name;
    if (!at && !h.is_called(name)) continue;
    Found f{.wanted = &w, .index = i, .is_at = at};
    if (!at) convert(h, w, f);
    add_offset(w, f);
    refuse_twice(h.name, i);
    out.push_back(std::move(f));
    return;
  }
  if (w.optional && !said) return;
  const std::string near = near_name(name);
  problems_.add(grid_.header_line(), 1, std::string(w.name),
                fmt::format("no column {} among {}", config::in_quotes(name), all_names()),
                fmt::format("`{} [{}]`, {}", w.name, w.unit, w.doc),
                near.empty() ? fmt::format("names.{}=NAME with the file's name for it", w.name)
                             : fmt::format("names.{}={}", w.name, near));
}

// A value that is stated for the whole file.
bool ColumnFinder::find_stated(const Wanted& w, std::vector<Found>& out) {
  // The longest part of the file's name decides.
  std::optional<std::string> text;
  std::size_t longest = 0;
  for (const std::string& setting : source_.values) {
    const Stated stated = stated_in(setting);
    if (stated.name != w.name || !stated.is_for(source_.path)) continue;
    const std::size_t length = stated.part.size();
    if (text && length == longest && *text != stated.value)
      problems_.add(0, 0, fmt::format("values.{}", w.name),
                    fmt::format("{} and {} for one file", config::in_quotes(*text),
                                config::in_quotes(stated.value)),
                    "one value", "a longer part of the file's name before the colon");
    if (!text || length > longest) text = stated.value, longest = length;
  }
  if (!text) return false;
  if (source_.names.contains(std::string(w.name)) ||
      std::ranges::any_of(grid_.headings(), [&](const Heading& h) { return h.is_called(w.name); }))
    problems_.add(
        grid_.header_line(), 1, std::string(w.name),
        fmt::format("a column, and the value {} for the whole file", config::in_quotes(*text)),
        "one of the two");
  Found f{.wanted = &w, .index = grid_.headings().size()};
  for (const auto& [word, meant] : w.words)
    if (*text == word) f.constant = meant;
  if (w.words.empty()) {
    const config::Parsed parsed = config::parse_quantity(*text, w.unit, source_.atmosphere);
    if (parsed.mistake)
      problems_.add(0, 0, fmt::format("values.{}", w.name), parsed.mistake->found,
                    parsed.mistake->expected, parsed.mistake->try_this);
    f.constant = parsed.si;
  } else if (!f.constant) {
    problems_.add(0, 0, fmt::format("values.{}", w.name), config::in_quotes(*text),
                  std::string(w.doc));
  }
  out.push_back(std::move(f));
  return true;
}

void ColumnFinder::add_offset(const Wanted& w, Found& f) {
  const auto said = source_.offsets.find(std::string(w.name));
  if (said == source_.offsets.end()) return;
  const config::Parsed added = config::parse_quantity(
      said->second, std::string(config::difference_unit(w.unit)), source_.atmosphere);
  if (added.mistake)
    problems_.add(0, 0, fmt::format("offsets.{}", w.name), added.mistake->found,
                  added.mistake->expected, added.mistake->try_this);
  f.conversion.offset += added.si;
}

// Two columns of one name: nobody knows which is meant. Those with an @ belong together.
void ColumnFinder::refuse_twice(const std::string& name, std::size_t first) {
  for (std::size_t i = first + 1; i < grid_.headings().size(); ++i) {
    const Heading& h = grid_.headings()[i];
    if (h.name == name && h.at_name.empty())
      problems_.add(grid_.header_line(), h.column, name, "a second column of this name", "one",
                    "another name for it in the header");
  }
}

// The only channel whose last part is the name, or else a name that differs by a few letters.
std::string ColumnFinder::near_name(const std::string& name) const {
  std::vector<std::string_view> channels;
  for (const std::string_view one : names())
    if (one.starts_with('/') && one.ends_with("/" + name)) channels.push_back(one);
  if (channels.size() == 1) return std::string(channels.front());
  return config::closest_in_quotes(name, names());
}

std::string ColumnFinder::all_names() const {
  std::string out;
  for (const std::string_view name : names()) {
    if (out.find(name) != out.npos) continue;
    if (!out.empty()) out += ", ";
    out += name;
  }
  return out;
}

// Every name in `names` and `units` must be somewhere.
void ColumnFinder::check_names(std::span<const Wanted> wanted) {
  const auto known = config::names_of(wanted);
  for (const auto& [name, file_name] : source_.names)
    if (std::ranges::find(known, name) == known.end())
      problems_.add(0, 0, "names", config::in_quotes(name), config::either(known),
                    config::closest_in_quotes(name, known));
  for (const auto& [name, offset] : source_.offsets)
    if (std::ranges::find(known, name) == known.end())
      problems_.add(0, 0, "offsets", config::in_quotes(name), config::either(known),
                    config::closest_in_quotes(name, known));
  for (const std::string& setting : source_.values)
    if (const std::string name = stated_in(setting).name;
        std::ranges::find(known, name) == known.end())
      problems_.add(0, 0, "values", config::in_quotes(name), config::either(known),
                    config::closest_in_quotes(name, known));
  const auto columns = names();
  for (const auto& [column, unit] : source_.units) {
    const bool there = std::ranges::find(columns, column) != columns.end() ||
                       std::ranges::any_of(grid_.headings(), [&name = column](const Heading& h) {
                         return h.written == name;
                       });
    if (!there)
      problems_.add(0, 0, "units", config::in_quotes(column),
                    "a column of the file: " + all_names(),
                    config::closest_in_quotes(column, columns));
  }
}

std::vector<std::pair<std::size_t, std::string>> ColumnFinder::conditions() {
  std::vector<std::pair<std::size_t, std::string>> out;
  for (const auto& [name, values] : source_.where) {
    const auto at = std::ranges::find_if(
        grid_.headings(), [&wanted = name](const Heading& h) { return h.is_called(wanted); });
    if (at == grid_.headings().end()) {
      problems_.add(0, 0, "where", config::in_quotes(name), "a column of the file: " + all_names(),
                    config::closest_in_quotes(name, names()));
      continue;
    }
    out.emplace_back(static_cast<std::size_t>(at - grid_.headings().begin()), values);
  }
  return out;
}

// The first meaning of the unit's text that has the wanted dimension.
void ColumnFinder::convert(const Heading& h, const Wanted& w, Found& f) {
  const bool stamps = tells_time(grid_.dialect.kinds[f.index]) || source_.dates == "excel" ||
                      (w.name == "time" && split_seconds(grid_, f.index));
  if (!w.words.empty() || (w.name == "time" && stamps)) return;
  auto said = source_.units.find(h.name);
  if (said == source_.units.end()) said = source_.units.find(h.written);
  f.unit = said != source_.units.end() ? said->second : unit_in(h);
  std::vector<config::Spelling> meanings = config::spellings(f.unit);
  if (meanings.empty()) meanings.push_back({f.unit});
  std::string try_this;
  for (const config::Spelling& meaning : meanings) {
    const auto parse = [&](int number) {
      return config::parse_quantity(fmt::format("{} {}", number, meaning.unit), w.unit,
                                    source_.atmosphere);
    };
    const config::Parsed zero = parse(0), one = parse(1);
    if (zero.mistake) {
      if (try_this.empty()) try_this = without_number(zero.mistake->try_this);
      continue;
    }
    f.conversion = {(one.si - zero.si) * meaning.factor, zero.si};
    if (meaning.factor == 1) f.shown = meaning.unit;
    return;
  }
  if (is_pressure(w.unit) && !f.unit.empty() && config::is_unit(meanings.front().unit + " gauge"))
    try_this = fmt::format("\"{0} gauge\" or \"{0} abs\"", f.unit);
  refuse_unit(h, w, f.unit, try_this);
}

void ColumnFinder::refuse_unit(const Heading& h, const Wanted& w, const std::string& unit,
                               const std::string& try_this) {
  if (unit.empty()) {
    problems_.add(grid_.header_line(), h.column, std::string(w.name),
                  fmt::format("the column {} without a unit", config::in_quotes(h.name)),
                  config::describe_unit(w.unit),
                  fmt::format("`{0} [{1}]` in the header, or units.{0}=\"{1}\"", h.name, w.unit));
    return;
  }
  problems_.add(grid_.header_line(), h.column, std::string(w.name),
                fmt::format("the unit {}", config::in_quotes(unit)), config::describe_unit(w.unit),
                try_this);
}

std::string possible_units(const Wanted& wanted, double number) {
  std::string_view unit = wanted.unit, reference;
  for (const std::string_view word : {" gauge", " abs", " diff"}) {
    if (!unit.ends_with(word)) continue;
    reference = word;
    unit.remove_suffix(word.size());
  }
  std::string out;
  const units::Dimension dimension = units::read_unit(unit).unit.dimension;
  for (const units::Unit& u : units::known_units) {
    const double size = std::abs(number) * u.numerator / u.denominator;
    if (!(u.dimension == dimension) || size < wanted.least || size > wanted.most) continue;
    if (!out.empty()) out += " or ";
    out += fmt::format("{}{}", u.name, reference);
  }
  return out;
}

}  // namespace sinew::recording
