#include "sinew/recording/heading.h"

#include <vector>

#include "sinew/config/quantity.h"
#include "sinew/config/spelling.h"
#include "sinew/config/utf8.h"

namespace sinew::recording {

namespace {

using config::trimmed;

// A header's unit and the name before it, where `text` ends with a unit behind `mark`.
bool split_at(std::string_view mark, std::string_view text, Heading& h) {
  const std::size_t at = text.rfind(mark);
  if (at == text.npos || at == 0) return false;
  const std::string_view name = trimmed(text.substr(0, at));
  const std::string_view unit = without_brackets(text.substr(at + mark.size()));
  // "m/s" as a column's name is one.
  if (name.empty() || config::spellings(unit).empty()) return false;
  if (mark == "/" && !config::spellings(name).empty() && !config::spellings(text).empty())
    return false;
  h.name = name;
  set_unit(h, unit);
  return true;
}

// "force (N)": what stands in round brackets is a unit or part of the name.
bool split_at_brackets(std::string_view text, char open, char close, Heading& h) {
  if (text.empty() || text.back() != close) return false;
  // "p [MPa(g)]", "p (MPa(g))": the bracket that matches the last one.
  std::size_t at = text.size();
  int depth = 0;
  while (at-- > 0) {
    depth += text[at] == close ? 1 : text[at] == open ? -1 : 0;
    if (depth == 0) break;
  }
  if (depth != 0 || at > text.size()) return false;
  const std::string_view unit = trimmed(text.substr(at + 1, text.size() - at - 2));
  if (open == '(' && (at == 0 || config::spellings(unit).empty())) return false;
  h.name = trimmed(text.substr(0, at));
  set_unit(h, unit);
  return true;
}

// "Druck ABS. (MPa)": a name has the reference that its unit lacks.
void add_reference(Heading& h) {
  if (h.unit.empty() || !config::is_unit(h.unit + " gauge")) return;
  constexpr std::pair<std::string_view, const char*> words[] = {
      {"abs", " abs"},     {"abs.", " abs"},  {"absolute", " abs"}, {"absolut", " abs"},
      {"gauge", " gauge"}, {"rel", " gauge"}, {"rel.", " gauge"},   {"relative", " gauge"}};
  std::string name = h.name;
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::string_view last = std::string_view(name).substr(name.find_last_of(" _,(") + 1);
  for (const auto& [word, reference] : words) {
    if (last != word || last == name) continue;
    h.unit += reference;
    h.file_unit = h.unit;
  }
}

}  // namespace

std::string_view without_brackets(std::string_view text) {
  text = trimmed(text);
  const bool square = text.size() > 2 && text.front() == '[' && text.back() == ']';
  const bool round = text.size() > 2 && text.front() == '(' && text.back() == ')';
  return square || round ? trimmed(text.substr(1, text.size() - 2)) : text;
}

bool is_unit_cell(std::string_view text) {
  const std::string_view unit = without_brackets(text);
  return unit.empty() || !config::spellings(unit).empty();
}

void set_unit(Heading& heading, std::string_view unit) {
  heading.file_unit = unit;
  heading.unit = unit;
  heading.factor = 1;
  const std::vector<config::Spelling> all = config::spellings(unit);
  if (all.empty()) return;
  heading.unit = all.front().unit;
  heading.factor = all.front().factor;
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
  // The stroke before the bracket: "p / bar(g)".
  const bool split = split_at_brackets(text, '[', ']', h) || split_at(" in ", text, h) ||
                     split_at("/", text, h) || split_at_brackets(text, '(', ')', h) ||
                     split_at(", ", text, h);
  if (!split) h.name = text;
  add_reference(h);
  return h;
}

}  // namespace sinew::recording
