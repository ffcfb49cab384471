#include "sinew/recording/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "sinew/config/utf8.h"
#include "sinew/units/letters.h"
#include "sinew/units/spelling.h"
#include "sinew/units/unit.h"

namespace sinew::recording {

namespace {

using units::trimmed;

constexpr std::size_t most_columns = 20;  // maximum number in a message

// Splits a header at the last `mark` into name and unit; returns false if no unit follows it.
bool split_at(std::string_view mark, std::string_view text, Heading& h) {
  const std::size_t at = text.rfind(mark);
  if (at == text.npos || at == 0) return false;
  const std::string_view name = trimmed(text.substr(0, at));
  const std::string_view unit = without_brackets(text.substr(at + mark.size()));
  // A whole unit such as "m/s" as a column's name is not split.
  if (name.empty() || units::spellings(unit).empty()) return false;
  if (mark == "/" && !units::spellings(name).empty() && !units::spellings(text).empty())
    return false;
  h.name = name;
  h.unit = unit;
  return true;
}

// Splits "force (N)"; returns false if the text in the brackets is not a unit.
bool split_at_brackets(std::string_view text, char open, char close, Heading& h) {
  if (text.empty() || text.back() != close) return false;
  // Nested brackets, "p [MPa(g)]" or "p (MPa(g))": finds the one that matches the last.
  std::size_t at = text.size();
  int depth = 0;
  while (at-- > 0) {
    depth += text[at] == close ? 1 : text[at] == open ? -1 : 0;
    if (depth == 0) break;
  }
  if (depth != 0 || at > text.size()) return false;
  const std::string_view unit = trimmed(text.substr(at + 1, text.size() - at - 2));
  if (open == '(' && (at == 0 || units::spellings(unit).empty())) return false;
  h.name = trimmed(text.substr(0, at));
  h.unit = unit;
  return true;
}

// Adds the reference to a pressure unit if the name contains it: "Druck ABS. (MPa)".
void add_reference(Heading& h) {
  const std::vector<units::Spelling> meanings = units::spellings(h.unit);
  if (meanings.empty() || !units::is_unit(meanings.front().unit + " gauge")) return;
  constexpr std::pair<std::string_view, const char*> words[] = {
      {"abs", " abs"},     {"abs.", " abs"},  {"absolute", " abs"}, {"absolut", " abs"},
      {"gauge", " gauge"}, {"rel", " gauge"}, {"rel.", " gauge"},   {"relative", " gauge"}};
  const std::string name = units::lower(h.name);
  const std::string_view last = std::string_view(name).substr(name.find_last_of(" _,(") + 1);
  for (const auto& [word, reference] : words) {
    if (last != word || last == name) continue;
    h.unit += reference;
  }
}

}  // namespace

std::string_view without_brackets(std::string_view text) {
  text = trimmed(text);
  const bool square = text.size() > 2 && text.front() == '[' && text.back() == ']';
  const bool round = text.size() > 2 && text.front() == '(' && text.back() == ')';
  return square || round ? trimmed(text.substr(1, text.size() - 2)) : text;
}

std::string stated_setting(std::string_view setting, std::string_view name,
                           std::string_view value) {
  const bool is_word = std::ranges::all_of(name, [](char c) {
    const auto u = static_cast<unsigned char>(c);
    return u >= 128 || std::isalnum(u) != 0 || c == '_' || c == '/' || c == '.' || c == '-';
  });
  return is_word ? fmt::format("{}.{}=\"{}\"", setting, name, value)
                 : fmt::format("{}.\"{}={}\"", setting, name, value);
}

bool is_unit_cell(std::string_view text) {
  const std::string_view unit = without_brackets(text);
  return unit.empty() || !units::spellings(unit).empty();
}

Heading heading_of(const Cell& cell) {
  Heading h;
  h.column = cell.column;
  h.written = config::without_controls(cell.text);
  for (char& c : h.written)
    if (c == '\n' || c == '\r') c = ' ';  // a cell of two lines
  const std::string whole = h.written;
  std::string_view text = whole;
  const std::size_t at = text.find('@');
  if (at != text.npos) {
    const std::string_view condition = text.substr(at + 1);
    const std::size_t equals = condition.find('=');
    h.at_name = trimmed(condition.substr(0, equals));
    if (equals != condition.npos) h.at_value = trimmed(condition.substr(equals + 1));
    text = trimmed(text.substr(0, at));
  }
  // The slash is tried before round brackets: "p / bar(g)".
  const bool split = split_at_brackets(text, '[', ']', h) || split_at(" in ", text, h) ||
                     split_at("/", text, h) || split_at_brackets(text, '(', ')', h) ||
                     split_at(", ", text, h);
  if (!split) h.name = text;
  add_reference(h);
  return h;
}

std::optional<std::size_t> Header::called(std::string_view name) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (!name.empty() && columns[i].is_called(name)) return i;
  return std::nullopt;
}

std::optional<std::size_t> Header::find(std::string_view name) const {
  if (const auto column = called(name)) return column;
  std::optional<std::size_t> only;
  for (std::size_t i = 0; i < columns.size() && !name.empty(); ++i) {
    const std::string_view whole = columns[i].name;
    if (whole.size() <= name.size() || !whole.ends_with(name)) continue;
    const char before = whole[whole.size() - name.size() - 1];
    if (before != '.' && before != '/') continue;
    if (only) return std::nullopt;
    only = i;
  }
  return only;
}

std::vector<std::string_view> Header::names() const {
  std::vector<std::string_view> out;
  for (const Heading& h : columns) {
    out.push_back(h.name);
    if (!h.at_name.empty()) out.push_back(h.at_name);
  }
  return out;
}

std::string Header::all_names() const {
  std::vector<std::string> out;
  for (const std::string_view name : names())
    if (std::ranges::find(out, name) == out.end()) out.emplace_back(name);
  return config::listed(out, most_columns);
}

namespace {

// Returns the place of a heading; a value that is stated for a whole file has none.
config::Location place_of(const Header& header, const Heading& heading) {
  return {header.file, heading.column > 0 ? header.line : 0, heading.column};
}

// Returns advice about a quantity as advice about its unit: "0 kPa gauge" -> "kPa gauge".
std::string without_number(std::string text) {
  for (std::size_t at = 0; (at = text.find("\"0 ", at)) != text.npos;) text.erase(at + 1, 2);
  return text;
}

}  // namespace

std::variant<FileUnit, std::string> file_unit(const std::string& unit, const std::string& wanted,
                                              double atmosphere) {
  std::vector<units::Spelling> meanings = units::spellings(unit);
  if (meanings.empty()) meanings.push_back({unit});
  std::string advice;
  for (const units::Spelling& meaning : meanings) {
    const auto parse = [&](int number) {
      return units::parse_quantity(fmt::format("{} {}", number, meaning.unit), wanted, atmosphere);
    };
    const units::Parsed zero = parse(0), one = parse(1);
    if (!zero.mistake)
      return FileUnit{{(one.si - zero.si) * meaning.factor, zero.si},
                      meaning.factor == 1 ? meaning.unit : ""};
    if (advice.empty()) advice = without_number(zero.mistake->try_this);
  }
  const bool is_pressure = wanted.starts_with("Pa ") && !unit.empty();
  if (is_pressure && units::is_unit(meanings.front().unit + " gauge"))
    return fmt::format("\"{0} gauge\" or \"{0} abs\"", unit);
  return advice;
}

bool is_gauge_channel(std::string_view name) {
  return name.starts_with("/sensor/") || name.ends_with("/gauge_pressure");
}

FileUnit own_unit(const std::string& unit) {
  const std::vector<units::Spelling> meanings = units::spellings(unit);
  if (meanings.empty()) return {{}, unit};
  return {{meanings.front().factor, 0}, meanings.front().unit};
}

units::Parsed parse_offset(const std::string& text, std::string_view wanted, double atmosphere) {
  if (!units::is_unit(wanted))
    return {0, units::Mistake{config::in_quotes(text),
                              fmt::format("no offset: Sinew does not have the unit {}",
                                          config::in_quotes(wanted)),
                              "another unit for the column"}};
  const auto [bare, reference] = units::unit_and_reference(wanted);
  return units::parse_quantity(
      text, reference.empty() ? std::string(wanted) : fmt::format("{} diff", bare), atmosphere);
}

std::optional<std::size_t> column_of(const Header& header, const Names& names,
                                     std::string_view wanted) {
  const auto given = names.find(std::string(wanted));
  return given == names.end() ? header.called(wanted) : header.find(given->second);
}

std::optional<std::string> given_unit(const Header& header, const Names& units,
                                      std::size_t column) {
  for (const auto& [name, unit] : units)
    if (header.find(name) == column) return unit;
  for (const auto& [name, unit] : units)
    if (header.columns[column].is_called(name)) return unit;
  return std::nullopt;
}

std::string ColumnResolver::name_of(std::string_view wanted) const {
  const auto given = names_.find(std::string(wanted));
  return given == names_.end() ? std::string(wanted) : given->second;
}

void ColumnResolver::refuse_missing(const WantedColumn& wanted) {
  const std::string name = name_of(wanted.name);
  const auto end = header_.find(name);  // end of a longer name, such as a channel's
  const std::string near =
      end ? header_.columns[*end].name : config::closest_in_quotes(name, header_.names());
  problems_.add({{header_.file, header_.line, 1},
                 wanted.name,
                 fmt::format("no column {} among {}", config::in_quotes(name), header_.all_names()),
                 fmt::format("`{} [{}]`, {}", wanted.name, wanted.unit, wanted.meaning),
                 near.empty()
                     ? fmt::format("names.{}=NAME with the file's name for it", wanted.name)
                     : fmt::format("names.{}={}", wanted.name, near)});
}

void ColumnResolver::refuse_repeated(std::size_t column) {
  const std::string& name = header_.columns[column].name;
  for (std::size_t i = column + 1; i < header_.columns.size(); ++i) {
    const Heading& h = header_.columns[i];
    if (h.name == name && h.at_name.empty())
      problems_.add({place_of(header_, h), name, "a second column of this name", "one",
                     "another name for it in the header"});
  }
}

std::string ColumnResolver::unit_of(std::size_t column) const {
  const Heading& h = header_.columns[column];
  if (const auto given = given_unit(header_, units_, column)) return *given;
  // Sinew's own channels have only "Pa".
  const bool is_channel = h.name.starts_with('/') && h.name.ends_with("pressure");
  if (!is_channel || h.unit != "Pa") return h.unit;
  return is_gauge_channel(h.name) ? "Pa gauge" : "Pa abs";
}

std::optional<FileUnit> ColumnResolver::convert(std::size_t column, const WantedColumn& wanted) {
  const auto unit = file_unit(unit_of(column), wanted.unit, atmosphere_);
  if (const auto* found = std::get_if<FileUnit>(&unit)) return *found;
  refuse_unit(column, wanted, std::get<std::string>(unit));
  return std::nullopt;
}

void ColumnResolver::refuse_unit(std::size_t column, const WantedColumn& wanted,
                                 const std::string& advice) {
  const Heading& h = header_.columns[column];
  const std::string unit = unit_of(column);
  config::Problem problem{place_of(header_, h), wanted.name};
  problem.expected = units::describe_unit(wanted.unit);
  const std::string usual = units::usual_units(wanted.unit).front();
  if (unit.empty()) {
    problem.found = fmt::format("the column {} without a unit", config::in_quotes(h.name));
    problem.try_this = stated_setting("units", h.name, usual);
    if (header_.line > 0)
      problem.try_this =
          fmt::format("`{} [{}]` in the header, or {}", h.name, usual, problem.try_this);
  } else {
    problem.found = fmt::format("the unit {}", config::in_quotes(unit));
    if (h.name != wanted.name)
      problem.found += fmt::format(" of the column {}", config::in_quotes(h.name));
    problem.try_this = advice;
    if (advice.starts_with("a quantity such as"))  // unit of another dimension
      problem.try_this = fmt::format("names.{}=NAME of another column, or {} if this unit is wrong",
                                     wanted.name, stated_setting("units", h.name, usual));
    // A weight in kg is a force in kgf, which is a unit of tables.
    const std::string weight = unit + "f";
    if (wanted.unit == "N" && units::is_unit(unit) &&
        (units::is_unit(weight) || !units::spellings(weight).empty()))
      problem.try_this = fmt::format("{} for the weight of that mass: {} is mass, {} is force",
                                     stated_setting("units", h.name, weight), unit, weight);
  }
  problems_.add(std::move(problem));
}

void check_columns(const Header& header, const char* setting, const Names& values,
                   config::Problems& problems) {
  std::vector<std::string_view> names = header.names();
  // A condition after an @ has a unit, but no cells by which rows could be selected.
  if (std::string_view(setting) == "where")
    std::erase_if(names, [&](std::string_view name) { return !header.find(name); });
  for (const auto& [name, value] : values) {
    if (header.find(name) || std::ranges::find(names, name) != names.end()) continue;
    problems.add({{header.file, 0, 0},
                  setting,
                  config::in_quotes(name),
                  "a column of the file: " + header.all_names(),
                  config::closest_in_quotes(name, names)});
  }
}

}  // namespace sinew::recording
