#include "sinew/config/short_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sinew/config/quantity.h"
#include "sinew/units/shown.h"

namespace sinew::config {
namespace {

constexpr int people_digits = 15;  // what a double keeps of any decimal number

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

}  // namespace

std::string short_quantity(double si, std::string_view unit) {
  std::string best = format_quantity(si, unit);
  const int needed = digits_of_text(format_number(si));
  if (needed <= people_digits || !std::isfinite(si)) return best;
  int fewest = needed;
  for (const std::string& other : other_units(unit)) {
    const std::string number = fmt::format("{:.{}g}", convert(si, unit, other), people_digits);
    const int digits = digits_of_text(number);
    const std::string text = fmt::format("{} {}", number, other);
    const Parsed read = parse_quantity(text, unit);
    if (digits >= fewest || read.mistake || read.si != si) continue;
    fewest = digits;
    best = text;
  }
  return best;
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
