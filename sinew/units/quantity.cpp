#include "sinew/units/quantity.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "sinew/units/letters.h"
#include "sinew/units/shown.h"
#include "sinew/units/spelling.h"
#include "sinew/units/unit.h"

namespace sinew::units {

namespace {

constexpr int exact_digits = 15;  // precision that a double keeps of any decimal number

// Any double has a text of 14 digits in one of a hundred units; a text that a user wrote has fewer.
constexpr int most_written_digits = 10;

std::string joined(std::initializer_list<std::string_view> parts) {
  std::string out;
  for (const std::string_view part : parts) out += part;
  return out;
}

std::string with_unit(std::string number, std::string_view unit) {
  return unit == "1" || unit.empty() ? number : joined({number, " ", unit});
}

// Unit with the reference of a pressure: "abs", "gauge", "diff", or "" without one.
struct FullUnit {
  std::string_view text;  // without the reference
  std::string_view reference;
  UnitReading reading;
};

FullUnit split_unit(std::string_view text) {
  const auto [unit, reference] = unit_and_reference(trimmed(text));
  const std::string_view bare = trimmed(unit);
  // Empty text is a plain number.
  return {bare, reference, read_unit(bare.empty() ? "1" : bare)};
}

// Parses a field's own unit, which is in the source code: a wrong one is a bug, not a user's
// mistake.
FullUnit field_unit(std::string_view text) {
  const FullUnit full = split_unit(text);
  if (!full.reading.ok) throw std::logic_error("a field has the unit " + in_quotes(text));
  return full;
}

std::string base_units(Dimension d) {
  const std::pair<int, std::string_view> bases[] = {
      {d.mass, "kg"},   {d.length, "m"},    {d.time, "s"},    {d.temperature, "K"},
      {d.angle, "rad"}, {d.count, "count"}, {d.voltage, "V"}, {d.current, "A"}};
  std::string above, below;
  for (auto [power, name] : bases) {
    if (power == 0) continue;
    std::string& side = power > 0 ? above : below;
    if (!side.empty()) side += ' ';
    side += name;
    if (std::abs(power) > 1) side += std::to_string(std::abs(power));
  }
  const std::string_view top = above.empty() ? "1" : std::string_view(above);
  if (below.empty()) return std::string(top);
  if (below.find(' ') != below.npos) below = '(' + below + ')';
  return std::string(top) + '/' + below;
}

const DimensionName* name_of(Dimension dimension) {
  const auto at = std::ranges::find(dimension_names, dimension, &DimensionName::dimension);
  return at == dimension_names.end() ? nullptr : &*at;
}

std::string describe_dimension(Dimension dimension) {
  if (dimension == dimension::none) return "a plain number";
  const DimensionName* name = name_of(dimension);
  return name ? joined({name->unit, " (", name->word, ")"}) : base_units(dimension);
}

// Usual units of a quantity, and its plausible range in a robot, in SI: a bare 164 for a length can
// only be 164 mm.
struct UsualUnits {
  std::string_view si;
  std::initializer_list<std::string_view> units;
  double least = 0, most = std::numeric_limits<double>::infinity();
};

std::span<const UsualUnits> kinds_of_units() {
  static const UsualUnits kinds[] = {{"m", {"m", "mm", "in"}, 3e-3, 3},
                                     {"m2", {"in2", "m2"}},
                                     {"m3", {"L", "mL", "in3", "m3"}, 1e-7, 0.1},
                                     {"kg", {"kg", "g", "lb"}, 1e-3, 500},
                                     {"N", {"N", "lbf"}, 1e-2, 2e4},
                                     {"Pa", {"bar", "kPa", "psi", "Pa"}, 5e3, 2e6},
                                     {"s", {"s", "ms"}, 1e-4, 1e5},
                                     {"rad", {"deg", "rad"}, 1e-3, 13},
                                     {"m3/(s Pa)", {"L/(s bar)", "m3/(s Pa)"}},
                                     {"s/count", {"% s/count", "s/count"}}};
  return kinds;
}

const UsualUnits* kind_of_unit(std::string_view unit) {
  const std::string_view bare = unit_and_reference(unit)[0];
  const auto at = std::ranges::find(kinds_of_units(), bare, &UsualUnits::si);
  return at == kinds_of_units().end() ? nullptr : &*at;
}

// Returns the thesis's unit for one word of a longer unit; per radian stays per radian.
std::string_view usual_word(std::string_view word) {
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"m", "in"}, {"m2", "in2"}, {"m3", "in3"}, {"kg", "lb"}, {"N", "lbf"}, {"Pa", "psi"}};
  for (const auto& [si, usual] : words)
    if (word == si) return usual;
  return word;
}

std::string quoted_units(std::string_view number, const std::vector<std::string>& units) {
  std::string out;
  for (const std::string& unit : units)
    out += joined({out.empty() ? "\"" : " or \"", number, number.empty() ? "" : " ", unit, "\""});
  return out;
}

std::string dimension_hint(Dimension found, Dimension expected, std::string_view text,
                           std::string_view unit) {
  using namespace dimension;
  const bool mass_for_force = combine(found, acceleration) == expected;
  const bool force_for_mass = combine(found, acceleration, -1) == expected;
  const bool pounds = text.find("lb") != text.npos;
  if (mass_for_force)
    return pounds ? "lbf: lb is mass, lbf is force" : "N: kg and g are mass, N is force";
  if (force_for_mass) return pounds ? "lb: lbf is force, lb is mass" : "kg: N is force, kg is mass";
  if (combine(found, angle, -1) == expected || combine(found, angle) == expected)
    return quoted_units("", usual_units(unit)) + ": rad counts as a dimension here";
  if (unit == "1") return "a number without a unit, or in %";
  return joined({"a quantity such as \"1 ", unit, "\""});
}

const char* const number_range = "a number from 1e-307 to 1e308, or 0";

// Returns advice for "3,15 in", a comma at the end of the number.
std::string comma_hint(std::string_view text, std::string_view rest) {
  const bool comma = rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9';
  if (!comma) return {};
  std::string with_point(text);
  with_point[text.size() - rest.size()] = '.';
  const std::string point = joined({"a decimal point: \"", with_point, "\""});
  const std::size_t end = std::min(rest.find_first_not_of("0123456789", 1), rest.size());
  if (end != 4) return point;
  std::string without(text);
  without.erase(text.size() - rest.size(), 1);
  return joined({point, "; or \"", without, "\", if it parts the thousands"});
}

// Returns "psi gauge" for "psig", a unit in another spelling.
std::string spelling_hint(const FullUnit& found) {
  const std::vector<Spelling> meant = spellings(found.text);
  if (meant.empty()) return {};
  const auto& [unit, factor] = meant.front();
  const std::string whole =
      joined({"\"", unit, found.reference.empty() ? "" : " ", found.reference, "\""});
  if (factor == 1) return whole;
  return joined({whole, ": 1 ", found.text, " is ", format_number(factor, 10), " ", unit});
}

std::string unknown_unit_hint(std::string_view piece, const FullUnit& found) {
  if (std::string spelling = spelling_hint(found); !spelling.empty()) return spelling;
  if (piece == "lbs" || piece == "pound" || piece == "pounds")
    return "\"lb\" for mass, \"lbf\" for force";
  std::vector<std::string_view> names{"gauge", "abs", "diff"};
  for (const Unit& unit : known_units) names.push_back(unit.name);
  const std::string_view near = closest(piece, names);
  if (!near.empty()) return in_quotes(near);
  return "spaces between units, digits for powers, at most one \"/\": \"lbf in/rad\", \"1/psi2\"";
}

// Returns the mistake of a unit that is unknown or of another dimension.
std::optional<Mistake> wrong_dimension(std::string_view text, const FullUnit& found,
                                       const FullUnit& wanted, std::string_view unit) {
  if (!found.reading.ok) {
    const std::string_view piece = found.reading.trouble;
    return Mistake{
        in_quotes(text) + " with the unknown unit " + in_quotes(piece.empty() ? found.text : piece),
        describe_unit(unit), unknown_unit_hint(piece, found)};
  }
  const Dimension has = found.reading.unit.dimension;
  const Dimension needs = wanted.reading.unit.dimension;
  if (has == needs) return std::nullopt;
  return Mistake{in_quotes(text) + ", " + describe_dimension(has), describe_unit(unit),
                 dimension_hint(has, needs, found.text, unit)};
}

// Returns the mistake of a pressure with another reference, or without one.
std::optional<Mistake> wrong_reference(std::string_view text, const FullUnit& found,
                                       const FullUnit& wanted, std::string_view unit) {
  const bool silent = found.reference.empty();
  const std::string_view bare = silent ? text : text.substr(0, text.rfind(' '));
  if (wanted.reference.empty()) {
    if (silent) return std::nullopt;
    return Mistake{in_quotes(text), describe_unit(unit), in_quotes(bare)};
  }
  const bool want_difference = wanted.reference == "diff";
  if (!silent && want_difference == (found.reference == "diff")) return std::nullopt;
  return Mistake{in_quotes(text) + (silent ? ", a pressure without its reference" : ""),
                 describe_unit(unit),
                 want_difference ? joined({"\"", bare, " diff\""})
                                 : joined({"\"", bare, " gauge\" or \"", bare, " abs\""})};
}

double moved(double pressure, std::string_view from, std::string_view to, double room) {
  if (from == "gauge" && to == "abs") return absolute(pressure, room);
  if (from == "abs" && to == "gauge") return gauge(pressure, room);
  return pressure;
}

// Returns the usual units in which the number is plausible; all of them if it is plausible in none.
// A pressure without a reference may be gauge or absolute.
std::vector<std::string> plausible_units(double number, std::string_view unit) {
  std::vector<std::string> all;
  for (const std::string& one : usual_units(unit)) {
    if (one.ends_with(" abs")) all.push_back(one.substr(0, one.size() - 3) + "gauge");
    all.push_back(one);
  }
  const UsualUnits* kind = kind_of_unit(unit);
  if (!kind) return all;
  std::vector<std::string> out;
  for (const std::string& one : all) {
    const double least = one.ends_with(" abs") ? 0.5 * atmosphere : kind->least;
    const double si = std::abs(split_unit(one).reading.unit.to_si(number));
    if (si >= least && si <= kind->most) out.push_back(one);
  }
  return out.empty() ? all : out;
}

int digits_of_text(std::string_view number) {
  const std::string_view mantissa = number.substr(0, number.find('e'));
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == mantissa.npos) return 1;
  return static_cast<int>(
      std::ranges::count_if(mantissa.substr(first), [](char c) { return c >= '0' && c <= '9'; }));
}

// SI unit and its usual alternatives.
struct UnitAlternatives {
  std::string_view si;
  std::initializer_list<std::string_view> others;
};

// Returns other units in which the quantity is usually written or shown.
std::vector<std::string> other_units(std::string_view unit) {
  if (unit == "1") return {"%"};
  std::vector<std::string> out = usual_units(unit);
  const std::string_view held = unit == "Pa abs" ? "Pa" : unit;
  for (const UnitSet set : {UnitSet::thesis, UnitSet::metric}) {
    std::string shown = ShownUnits(set).of(held).name;
    // A gauge pressure depends on the atmosphere.
    if (shown.ends_with(" gauge")) shown.replace(shown.size() - 5, 5, "abs");
    out.push_back(std::move(shown));
  }
  if (unit == "m") out.insert(out.end(), {"mm", "cm", "ft"});
  std::erase(out, std::string(unit));
  return out;
}

// Returns alternatives for one word of a unit: for "m2" itself first, then "mm2", "cm2" and so on.
std::vector<std::string> words_for(std::string_view word) {
  static const std::initializer_list<UnitAlternatives> all = {{"m", {"mm", "cm", "in", "ft"}},
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
  for (const UnitAlternatives& w : all)
    if (w.si == word.substr(0, letters))
      for (const std::string_view other : w.others)
        out.push_back(std::string(other) + std::string(word.substr(letters)));
  return out;
}

// Returns all units with some words replaced by alternatives: "kg mm2", "g m2", "g mm2" and so on.
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

// Shortest text so far, and its number of digits.
struct Shortest {
  std::string text;
  int digits;
};

// Takes the text in another unit if it is shorter and reads back to the same bits.
void try_unit(double si, std::string_view unit, const std::string& other, Shortest& best) {
  const std::string number = format_number(convert(si, unit, other), exact_digits);
  const int digits = digits_of_text(number);
  if (digits >= best.digits) return;
  std::string text = number + ' ' + other;
  const Parsed read = parse_quantity(text, unit);
  if (!read.mistake && read.si == si) best = {std::move(text), digits};
}

}  // namespace

NumberAndUnit split_number(std::string_view text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  NumberAndUnit out;
  const auto [end, error] = std::from_chars(first, last, out.number);
  out.error = error;
  if (error == std::errc{}) out.unit = trimmed({end, static_cast<std::size_t>(last - end)});
  return out;
}

std::vector<std::string> usual_units(std::string_view unit) {
  std::vector<std::string> out;
  if (const UsualUnits* kind = kind_of_unit(unit)) {
    for (const std::string_view one : kind->units)
      out.push_back(std::string(one) + std::string(unit.substr(kind->si.size())));
    return out;
  }
  std::string usual = with_words(unit, " /()", usual_word);
  const bool percent =
      usual.starts_with("1/") && (unit.find("count") != unit.npos || unit.find('N') != unit.npos);
  if (percent) usual.replace(0, 1, "%");
  out.emplace_back(unit);
  if (usual != unit) out.insert(percent ? out.begin() : out.end(), std::move(usual));
  return out;
}

Mistake missing_unit(std::string_view number, std::string_view unit, std::string_view before) {
  Mistake out{std::string(number) + " without a unit", describe_unit(unit), ""};
  if (!before.empty() && !parse_quantity(before, unit).mistake)
    out.try_this = quoted_units(number, {written_unit(before)}) + ", the unit of what stood there";
  else
    out.try_this = quoted_units(number, plausible_units(split_number(number).number, unit));
  return out;
}

Parsed parse_quantity(std::string_view text, std::string_view unit, double room,
                      std::string_view before) {
  const FullUnit wanted = field_unit(unit);
  const std::string_view body = trimmed(text);
  const auto [number, rest, error] = split_number(body);
  const auto wrong = [&](std::string expected, std::string try_this) {
    return Parsed{0, Mistake{in_quotes(text), std::move(expected), std::move(try_this)}};
  };
  if (error == std::errc::result_out_of_range) return wrong(describe_finite(unit), number_range);
  if (error != std::errc{})
    return wrong(describe_unit(unit), unit == "1"
                                          ? "a number first, as in \"0.5\""
                                          : joined({"a number first, as in \"1 ", unit, "\""}));
  if (!std::isfinite(number)) return wrong(describe_finite(unit), "");
  if (std::string hint = comma_hint(body, rest); !hint.empty())
    return wrong(describe_unit(unit), std::move(hint));
  if (rest.empty() && wanted.reading.unit.dimension != Dimension{})
    return {0, missing_unit(body, unit, before)};
  const FullUnit found = split_unit(rest);
  if (auto mistake = wrong_dimension(body, found, wanted, unit)) return {0, mistake};
  if (auto mistake = wrong_reference(body, found, wanted, unit)) return {0, mistake};
  const double si = wanted.reading.unit.from_si(found.reading.unit.to_si(number));
  if (!std::isfinite(si)) return wrong(describe_finite(unit), number_range);
  return {moved(si, found.reference, wanted.reference, room), std::nullopt};
}

std::string written_unit(std::string_view text) {
  const std::string_view unit = split_number(trimmed(text)).unit;
  return unit.empty() ? "1" : std::string(unit);
}

std::string format_number(double value) {
  char buffer[64];
  // Writes 100000 rather than 1e+05, as long as the zeros can be counted.
  const double size = std::abs(value);
  const bool plain = size == 0 || (size >= 1e-5 && size < 1e9);
  const auto result =
      plain ? std::to_chars(std::begin(buffer), std::end(buffer), value, std::chars_format::fixed)
            : std::to_chars(std::begin(buffer), std::end(buffer), value);
  return {buffer, result.ptr};
}

std::string format_number(double value, int digits) {
  char buffer[64];
  const auto result = std::to_chars(std::begin(buffer), std::end(buffer), value,
                                    std::chars_format::general, digits);
  return {buffer, result.ptr};
}

double with_digits(double value, int digits) {
  const std::string text = format_number(value, digits);
  const NumberAndUnit read = split_number(text);
  return read.error == std::errc{} ? read.number : value;
}

std::string format_quantity(double si, std::string_view unit) {
  return with_unit(format_number(si), unit);
}

std::string format_quantity(double si, std::string_view unit, std::string_view display,
                            int significant_digits, double room) {
  return with_unit(format_number(convert(si, unit, display, room), significant_digits), display);
}

std::string range_text(double low, double high, std::string_view unit) {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (!has_low && !has_high) return "";
  if (!has_low) return "at most " + format_quantity(high, unit);
  if (!has_high) return "at least " + format_quantity(low, unit);
  return format_quantity(low, unit) + " to " + format_quantity(high, unit);
}

double convert(double si, std::string_view unit, std::string_view display, double room) {
  const FullUnit from = field_unit(unit);
  const FullUnit to = field_unit(display);
  const bool same = from.reading.unit.dimension == to.reading.unit.dimension;
  if (!same || (from.reference == "diff") != (to.reference == "diff"))
    throw std::logic_error(joined({"cannot show ", unit, " in ", display}));
  const double shifted = moved(si, from.reference, to.reference, room);
  return to.reading.unit.from_si(from.reading.unit.to_si(shifted));
}

std::string coefficient_unit(std::string_view unit, std::string_view per, int k) {
  if (unit == per && k > 0) {
    // x polynomial in x: m, 1, 1/m, 1/m2 ...
    return k == 1 ? "1" : coefficient_unit("1", per, k - 1);
  }
  if (k == 0 || per == "1") return std::string(unit);
  std::string power(per);
  if (per.find_first_of(" /*") == per.npos) {
    if (k > 1) power += std::to_string(k);
  } else {
    power = joined({"(", per, ")"});
    for (int i = 1; i < k; ++i) power += joined({" (", per, ")"});
    if (k > 1) power = joined({"(", power, ")"});
  }
  const bool compound = unit.find('/') != unit.npos;
  return joined({compound ? "(" : "", unit, compound ? ")/" : "/", power});
}

std::string_view difference_unit(std::string_view unit) {
  return unit == "Pa abs" || unit == "Pa gauge" ? "Pa diff" : unit;
}

std::string describe_finite(std::string_view unit) {
  const std::string what = describe_unit(unit);
  return what == "a number" ? "a finite number" : "a finite number of " + what;
}

std::string describe_unit(std::string_view unit) {
  const Dimension dimension = field_unit(unit).reading.unit.dimension;
  if (dimension == Dimension{}) return "a number";
  const DimensionName* name = name_of(dimension);
  return name ? joined({unit, " (", name->word, ")"}) : std::string(unit);
}

std::string short_quantity(double si, std::string_view unit) {
  Shortest best{format_quantity(si, unit), digits_of_text(format_number(si))};
  if (best.digits <= most_written_digits || !std::isfinite(si)) return best.text;
  const bool is_computed = best.digits > exact_digits;
  Shortest written{best.text, is_computed ? best.digits : most_written_digits + 1};
  for (const std::string& other : other_units(unit)) try_unit(si, unit, other, written);
  if (written.digits <= most_written_digits) return written.text;
  Shortest mixed{written.text, most_written_digits + 1};
  for (const std::string& other : mixed_units(unit)) try_unit(si, unit, other, mixed);
  return mixed.text;
}

std::string rounded_quantity(double si, std::string_view unit) {
  return format_quantity(with_digits(si, exact_digits), unit);
}

std::string quantity_like(std::string_view written, double si, std::string_view unit,
                          std::string_view otherwise, double room) {
  std::string_view display = split_number(trimmed(written)).unit;
  if (display.empty() || parse_quantity(joined({"1 ", display}), unit, room).mistake)
    display = otherwise;
  return format_quantity(si, unit, display, 6, room);
}

}  // namespace sinew::units
