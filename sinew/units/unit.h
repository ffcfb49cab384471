// units/unit.h - the units that Sinew reads, and their grammar: "lbf in s/rad".
//
//   expression = product ["/" factor]         at most one "/", so that its scope is unambiguous
//   product    = factor {(" " | "*") factor}
//   factor     = name [digit] | "1" | "(" expression ")"
//
// A digit is a power: in2, 1/psi2. Reading is constexpr, so a field table can be checked at compile
// time.
#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include "sinew/units/constants.h"
#include "sinew/units/dimension.h"

namespace sinew::units {

// SI value = number x numerator / denominator + offset. The factors are separate because 55 % is
// 0.55 to the last bit if divided by 100, and is not if multiplied by 0.01.
struct Unit {
  std::string_view name;
  Dimension dimension;
  double numerator = 1;
  double denominator = 1;
  double offset = 0;

  // Returns a number of this unit in SI.
  constexpr double to_si(double number) const {
    const double scaled = number * numerator / denominator;
    return offset == 0 ? scaled : scaled + offset;  // adding 0 would lose the sign of -0
  }
  // Returns an SI number in this unit.
  constexpr double from_si(double si) const { return (si - offset) * denominator / numerator; }
};

inline constexpr std::array known_units = {
    Unit{"%", dimension::none, 1, 100},
    Unit{"m", dimension::length},
    Unit{"km", dimension::length, 1000},
    Unit{"cm", dimension::length, 1, 100},
    Unit{"mm", dimension::length, 1, 1000},
    Unit{"in", dimension::length, inch},
    Unit{"ft", dimension::length, foot},
    Unit{"L", dimension::volume, 1, 1000},
    Unit{"mL", dimension::volume, 1, 1'000'000},
    Unit{"gal", dimension::volume, 231 * inch* inch* inch},
    Unit{"s", dimension::time},
    Unit{"ms", dimension::time, 1, 1000},
    Unit{"us", dimension::time, 1, 1'000'000},
    Unit{"min", dimension::time, 60},
    Unit{"h", dimension::time, 3600},
    Unit{"Hz", dimension::frequency},
    Unit{"kHz", dimension::frequency, 1000},
    Unit{"kg", dimension::mass},
    Unit{"g", dimension::mass, 1, 1000},
    Unit{"mg", dimension::mass, 1, 1'000'000},
    Unit{"lb", dimension::mass, pound_mass},
    Unit{"slug", dimension::mass, slug},
    Unit{"N", dimension::force},
    Unit{"kN", dimension::force, 1000},
    Unit{"lbf", dimension::force, pound_force},
    Unit{"Pa", dimension::pressure},
    Unit{"kPa", dimension::pressure, 1000},
    Unit{"MPa", dimension::pressure, 1'000'000},
    Unit{"bar", dimension::pressure, bar},
    Unit{"psi", dimension::pressure, psi},
    Unit{"K", dimension::temperature},
    Unit{"degR", dimension::temperature, 5, 9},
    Unit{"degC", dimension::temperature, 1, 1, celsius_zero},
    Unit{"rad", dimension::angle},
    Unit{"deg", dimension::angle, std::numbers::pi, 180},
    Unit{"rpm", {.time = -1, .angle = 1}, 2 * std::numbers::pi, 60},
    Unit{"count", dimension::count},
    Unit{"V", dimension::voltage},
    Unit{"mV", dimension::voltage, 1, 1000},
    Unit{"A", dimension::current},
    Unit{"mA", dimension::current, 1, 1000},
    Unit{"ohm", dimension::resistance},
    Unit{"H", dimension::inductance},
    Unit{"mH", dimension::inductance, 1, 1000},
    Unit{"J", dimension::energy},
    Unit{"W", dimension::power},
};

// Returns known_units.end() if the unit is unknown. Not a null pointer: with -fsanitize=undefined
// GCC 12 does not treat a comparison with it as a constant.
constexpr auto find_unit(std::string_view name) {
  return std::find_if(known_units.begin(), known_units.end(),
                      [name](const Unit& u) { return u.name == name; });
}

// Result of reading a unit: the unit, or the part of the text that is not valid.
struct UnitReading {
  Unit unit;
  bool ok = true;
  std::string_view trouble;  // part of the text; empty if the text ends too early
};

// Reads one expression from left to right; `ok` stays false after the first error.
class UnitReader {
 public:
  // Takes the text of a unit, "lbf in s/rad".
  constexpr explicit UnitReader(std::string_view text) : text_(text) {}

  // Returns the unit, or the invalid part of the text.
  constexpr UnitReading read() {
    Unit unit = expression(0);
    skip_spaces();
    if (ok_ && at_ < text_.size()) fail(text_.substr(at_));
    return {unit, ok_, trouble_};
  }

 private:
  static constexpr int deepest = 8;

  constexpr Unit expression(int depth) {
    Unit result = product(depth);
    if (!ok_ || peek() != '/') return result;
    ++at_;
    skip_spaces();
    multiply(result, factor(depth), -1);
    skip_spaces();
    // "a/b c" is ambiguous and therefore rejected.
    if (ok_ && peek() != ')' && peek() != '\0') fail(text_.substr(at_));
    return result;
  }

  constexpr Unit product(int depth) {
    skip_spaces();
    Unit result = factor(depth);
    while (ok_) {
      skip_spaces();
      if (peek() == '*') {
        ++at_;
        skip_spaces();
      } else if (peek() == '/' || peek() == ')' || peek() == '\0') {
        break;
      }
      multiply(result, factor(depth), 1);
    }
    return result;
  }

  constexpr Unit factor(int depth) {
    if (peek() == '(' && depth < deepest) return group(depth);
    if (peek() == '1') {
      ++at_;
      return {};
    }
    const std::size_t start = at_;
    while (is_letter(peek())) ++at_;
    const std::string_view name = text_.substr(start, at_ - start);
    const auto base = find_unit(name);
    // A temperature with an offset is a point on a scale and cannot be multiplied.
    if (base == known_units.end() || (base->offset != 0 && name != text_)) {
      fail(name.empty() ? text_.substr(start) : name);
      return {};
    }
    const int power = peek() >= '2' && peek() <= '9' ? text_[at_++] - '0' : 1;
    return raised(*base, power);
  }

  constexpr Unit group(int depth) {
    ++at_;
    const Unit inner = expression(depth + 1);
    skip_spaces();
    if (ok_ && peek() != ')') fail(text_.substr(at_));
    if (ok_) ++at_;
    return inner;
  }

  static constexpr Unit raised(Unit base, int power) {
    Unit result = base;
    for (int i = 1; i < power; ++i) multiply(result, base, 1);
    return result;
  }

  static constexpr void multiply(Unit& left, const Unit& right, int power) {
    left.dimension = combine(left.dimension, right.dimension, power);
    left.numerator *= power > 0 ? right.numerator : right.denominator;
    left.denominator *= power > 0 ? right.denominator : right.numerator;
  }

  static constexpr bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%';
  }
  constexpr char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  constexpr void skip_spaces() {
    while (peek() == ' ') ++at_;
  }
  constexpr void fail(std::string_view piece) {
    if (ok_) trouble_ = piece;
    ok_ = false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool ok_ = true;
  std::string_view trouble_;
};

// Splits "psi gauge" into the unit and the reference of a pressure: "gauge", "abs", "diff" or "".
constexpr std::array<std::string_view, 2> unit_and_reference(std::string_view text) {
  for (const std::string_view word : {"gauge", "abs", "diff"}) {
    if (text == word) return {"", word};
    if (text.ends_with(word) && text[text.size() - word.size() - 1] == ' ')
      return {text.substr(0, text.find_last_not_of(' ', text.size() - word.size() - 1) + 1), word};
  }
  return {text, ""};
}

// Returns the unit that the text names, or its invalid part.
constexpr UnitReading read_unit(std::string_view text) { return UnitReader(text).read(); }

}  // namespace sinew::units
