#include "sinew/config/short_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "sinew/config/quantity.h"
#include "sinew/units/shown.h"

namespace sinew::config {
namespace {

constexpr int people_digits = 15;  // what a double keeps of any decimal number

// Any double has a text of 14 digits in one of a hundred units; a text that somebody wrote has
// fewer.
constexpr int digits_somebody_wrote = 10;

// A word of SI, and what people write in its place.
struct Words {
  std::string_view si;
  std::initializer_list<std::string_view> others;
};

int digits_of_text(std::string_view number) {
  const std::string_view mantissa = number.substr(0, number.find('e'));
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == mantissa.npos) return 1;
  return static_cast<int>(
      std::ranges::count_if(mantissa.substr(first), [](char c) { return c >= '0' && c <= '9'; }));
}

// The units in which a quantity of that one is written, shown, or both.
std::vector<std::string> other_units(std::string_view unit) {
  if (unit == "1") return {"%"};
  std::vector<std::string> out = usual_units(unit);
  const std::string_view held = unit == "Pa abs" ? "Pa" : unit;
  for (const units::UnitSet set : {units::UnitSet::thesis, units::UnitSet::metric}) {
    std::string shown = units::ShownUnits(set).of(held).name;
    // A gauge's number depends on the room.
    if (shown.ends_with(" gauge")) shown.replace(shown.size() - 5, 5, "abs");
    out.push_back(std::move(shown));
  }
  if (unit == "m") out.insert(out.end(), {"mm", "cm", "ft"});
  std::erase(out, std::string(unit));
  return out;
}

// The words for one of a unit's, "m2": itself first, then "mm2", "cm2" and so on.
std::vector<std::string> words_for(std::string_view word) {
  static const std::initializer_list<Words> all = {{"m", {"mm", "cm", "in", "ft"}},
                                                   {"kg", {"g", "mg", "lb"}},
                                                   {"N", {"kN", "lbf"}},
                                                   {"Pa", {"kPa", "MPa", "bar", "psi"}},
                                                   {"s", {"ms", "min"}},
                                                   {"rad", {"deg"}},
                                                   {"V", {"mV"}},
                                                   {"A", {"mA"}},
                                                   {"1", {"%"}}};
  std::vector<std::string> out{std::string(word)};
  if (word == "m3") out.insert(out.end(), {"mL", "L"});
  const std::size_t letters =
      word == "1" ? 1 : std::min(word.find_first_of("0123456789"), word.size());
  for (const Words& w : all)
    if (w.si == word.substr(0, letters))
      for (const std::string_view other : w.others)
        out.push_back(std::string(other) + std::string(word.substr(letters)));
  return out;
}

// Every unit that differs from that one in some of its words: "kg mm2", "g m2", "g mm2" and so on.
std::vector<std::string> mixed_units(std::string_view unit) {
  std::vector<std::string> out{""};
  for (std::size_t at = 0; at < unit.size();) {
    const std::size_t end = std::min(unit.find_first_of(" /()", at), unit.size());
    std::vector<std::string> longer;
    for (const std::string& begun : out)
      for (const std::string& word : words_for(unit.substr(at, end - at)))
        longer.push_back(begun + word + std::string(unit.substr(end, 1)));
    out = std::move(longer);
    at = end + 1;
  }
  std::erase_if(out, [&](const std::string& other) {
    return other == unit || parse_quantity("1 " + other, unit).mistake;
  });
  return out;
}

// The shortest text so far, and how many digits it has.
struct Shortest {
  std::string text;
  int digits;
};

// Takes the text in another unit where it is shorter and reads back to the same bits.
void try_unit(double si, std::string_view unit, const std::string& other, Shortest& best) {
  const std::string number = fmt::format("{:.{}g}", convert(si, unit, other), people_digits);
  const int digits = digits_of_text(number);
  if (digits >= best.digits) return;
  std::string text = fmt::format("{} {}", number, other);
  const Parsed read = parse_quantity(text, unit);
  if (!read.mistake && read.si == si) best = {std::move(text), digits};
}

}  // namespace

std::string short_quantity(double si, std::string_view unit) {
  Shortest best{format_quantity(si, unit), digits_of_text(format_number(si))};
  if (best.digits <= digits_somebody_wrote || !std::isfinite(si)) return best.text;
  const bool nobody_wrote_it = best.digits > people_digits;
  Shortest written{best.text, nobody_wrote_it ? best.digits : digits_somebody_wrote + 1};
  for (const std::string& other : other_units(unit)) try_unit(si, unit, other, written);
  if (written.digits <= digits_somebody_wrote) return written.text;
  Shortest mixed{written.text, digits_somebody_wrote + 1};
  for (const std::string& other : mixed_units(unit)) try_unit(si, unit, other, mixed);
  return mixed.text;
}

std::string rounded_quantity(double si, std::string_view unit) {
  std::string text = fmt::format("{:.{}g}", si, people_digits);
  double rounded = si;
  if (const Parsed read = parse_quantity(text, "1"); !read.mistake) rounded = read.si;
  return format_quantity(rounded, unit);
}

std::string quantity_like(std::string_view written, double si, std::string_view unit,
                          std::string_view otherwise, double room) {
  const std::size_t letter =
      written.find_first_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ%");
  std::string_view display = letter == written.npos ? otherwise : written.substr(letter);
  if (parse_quantity(fmt::format("1 {}", display), unit, room).mistake) display = otherwise;
  return format_quantity(si, unit, display, 6, room);
}

std::string quantity_like(const Origins& origins, std::string_view path, double si,
                          std::string_view unit, std::string_view otherwise, double room) {
  const Origin* origin = find_origin(origins, path);
  const bool said = origin && !origin->is_default;
  return quantity_like(said ? std::string_view(origin->text) : std::string_view{}, si, unit,
                       otherwise, room);
}

}  // namespace sinew::config
