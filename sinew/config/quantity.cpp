#include "sinew/config/quantity.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sinew/config/diagnostics.h"
#include "sinew/units/shown.h"
#include "sinew/units/spelling.h"
#include "sinew/units/unit.h"

namespace sinew::config {

namespace {

constexpr int exact_digits = 15;  // precision that a double keeps of any decimal number

// Any double has a text of 14 digits in one of a hundred units; a text that a user wrote has fewer.
constexpr int most_written_digits = 10;

// SI unit and its usual alternatives.
struct UnitAlternatives {
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

// Returns other units in which the quantity is usually written or shown.
std::vector<std::string> other_units(std::string_view unit) {
  if (unit == "1") return {"%"};
  std::vector<std::string> out = usual_units(unit);
  const std::string_view held = unit == "Pa abs" ? "Pa" : unit;
  for (const units::UnitSet set : {units::UnitSet::thesis, units::UnitSet::metric}) {
    std::string shown = units::ShownUnits(set).of(held).name;
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
  const std::string number = fmt::format("{:.{}g}", convert(si, unit, other), exact_digits);
  const int digits = digits_of_text(number);
  if (digits >= best.digits) return;
  std::string text = fmt::format("{} {}", number, other);
  const Parsed read = parse_quantity(text, unit);
  if (!read.mistake && read.si == si) best = {std::move(text), digits};
}

}  // namespace

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
  std::string text = fmt::format("{:.{}g}", si, exact_digits);
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
  const bool is_given = origin && !origin->is_default;
  return quantity_like(is_given ? std::string_view(origin->text) : std::string_view{}, si, unit,
                       otherwise, room);
}

namespace {

using units::Dimension;

// Reference of a pressure.
enum class Reference { none, absolute, gauge, difference };

struct FullUnit {
  std::string_view text;  // without the reference
  units::UnitReading reading;
  Reference reference = Reference::none;
};

FullUnit split_unit(std::string_view text) {
  const auto [unit, word] = units::unit_and_reference(trimmed(text));
  FullUnit full{trimmed(unit), {}, Reference::none};
  if (word == "abs") full.reference = Reference::absolute;
  if (word == "gauge") full.reference = Reference::gauge;
  if (word == "diff") full.reference = Reference::difference;
  // Empty text is a plain number.
  full.reading = units::read_unit(full.text.empty() ? "1" : full.text);
  return full;
}

// Parses a field's own unit, which is in the source code: a wrong one is a bug, not a user's
// mistake.
FullUnit field_unit(std::string_view text) {
  const FullUnit full = split_unit(text);
  if (!full.reading.ok) throw std::logic_error(fmt::format("a field has the unit \"{}\"", text));
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
  return below.find(' ') == below.npos ? fmt::format("{}/{}", top, below)
                                       : fmt::format("{}/({})", top, below);
}

const units::DimensionName* name_of(Dimension dimension) {
  for (const auto& name : units::dimension_names) {
    if (name.dimension == dimension) return &name;
  }
  return nullptr;
}

std::string describe_dimension(Dimension dimension) {
  const auto* name = name_of(dimension);
  if (!name) return base_units(dimension);
  if (dimension == units::dimension::none) return "a plain number";
  return fmt::format("{} ({})", name->unit, name->word);
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
  const std::string_view bare = units::unit_and_reference(unit)[0];
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

std::string with_usual_words(std::string_view unit) {
  std::string out;
  for (std::size_t at = 0; at < unit.size();) {
    const std::size_t end = std::min(unit.find_first_of(" /()", at), unit.size());
    out += usual_word(unit.substr(at, end - at));
    if (end < unit.size()) out += unit[end];
    at = end + 1;
  }
  return out;
}

std::string quoted_units(std::string_view number, const std::vector<std::string>& units) {
  std::string out;
  for (const std::string& unit : units)
    out += fmt::format("{}\"{}{}{}\"", out.empty() ? "" : " or ", number, number.empty() ? "" : " ",
                       unit);
  return out;
}

std::string dimension_hint(Dimension found, Dimension expected, std::string_view text,
                           std::string_view unit) {
  using namespace units::dimension;
  const bool mass_for_force = combine(found, acceleration) == expected;
  const bool force_for_mass = combine(found, acceleration, -1) == expected;
  const bool pounds = text.find("lb") != text.npos;
  if (mass_for_force)
    return pounds ? "lbf: lb is mass, lbf is force" : "N: kg and g are mass, N is force";
  if (force_for_mass) return pounds ? "lb: lbf is force, lb is mass" : "kg: N is force, kg is mass";
  if (combine(found, angle, -1) == expected || combine(found, angle) == expected)
    return quoted_units("", usual_units(unit)) + ": rad counts as a dimension here";
  if (unit == "1") return "a number without a unit, or in %";
  return fmt::format("a quantity such as \"1 {}\"", unit);
}

const char* const number_range = "a number from 1e-307 to 1e308, or 0";

struct NumberAndRest {
  double number = 0;
  std::string_view rest;  // text of the unit
  std::errc error{};
};

NumberAndRest split_number(std::string_view text) {
  const char* first = text.data();
  const char* last = first + text.size();
  if (first != last && *first == '+') ++first;
  NumberAndRest result;
  const auto [end, error] = std::from_chars(first, last, result.number);
  result.error = error;
  result.rest = error == std::errc{} ? trimmed({end, static_cast<std::size_t>(last - end)}) : text;
  return result;
}

// Returns advice for "3,15 in", a comma at the end of the number.
std::string comma_hint(std::string_view text, std::string_view rest) {
  const bool comma = rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9';
  if (!comma) return {};
  std::string with_point(text);
  with_point[text.size() - rest.size()] = '.';
  const std::string point = fmt::format("a decimal point: \"{}\"", with_point);
  const std::size_t end = std::min(rest.find_first_not_of("0123456789", 1), rest.size());
  if (end != 4) return point;
  std::string without(text);
  without.erase(text.size() - rest.size(), 1);
  return fmt::format("{}; or \"{}\", if it parts the thousands", point, without);
}

// Returns "psi gauge" for "psig", a unit in another spelling.
std::string spelling_hint(const FullUnit& found) {
  const std::vector<units::Spelling> meant = units::spellings(found.text);
  if (meant.empty()) return {};
  const auto& [unit, factor] = meant.front();
  constexpr std::string_view references[] = {"", " abs", " gauge", " diff"};
  const std::string_view reference = references[static_cast<std::size_t>(found.reference)];
  const std::string whole = unit + std::string(reference);
  if (factor == 1) return fmt::format("\"{}\"", whole);
  return fmt::format("\"{}\": 1 {} is {:.10g} {}", whole, found.text, factor, unit);
}

std::string unknown_unit_hint(std::string_view piece, const FullUnit& found) {
  if (std::string spelling = spelling_hint(found); !spelling.empty()) return spelling;
  if (piece == "lbs" || piece == "pound" || piece == "pounds") {
    return "\"lb\" for mass, \"lbf\" for force";
  }
  std::vector<std::string_view> names{"gauge", "abs", "diff"};
  for (const auto& unit : units::known_units) names.push_back(unit.name);
  const std::string_view near = closest(piece, names);
  if (!near.empty()) return fmt::format("\"{}\"", near);
  return "spaces between units, digits for powers, at most one \"/\": \"lbf in/rad\", \"1/psi2\"";
}

std::optional<Mistake> check_unit(std::string_view text, const FullUnit& found,
                                  const FullUnit& wanted, std::string_view unit) {
  if (!found.reading.ok) {
    const auto piece = found.reading.trouble;
    return Mistake{fmt::format("{} with the unknown unit {}", in_quotes(text),
                               in_quotes(piece.empty() ? found.text : piece)),
                   describe_unit(unit), unknown_unit_hint(piece, found)};
  }
  const Dimension has = found.reading.unit.dimension;
  const Dimension needs = wanted.reading.unit.dimension;
  if (has == needs) return std::nullopt;
  return Mistake{fmt::format("{}, {}", in_quotes(text), describe_dimension(has)),
                 describe_unit(unit), dimension_hint(has, needs, found.text, unit)};
}

std::optional<Mistake> check_reference(std::string_view text, const FullUnit& found,
                                       const FullUnit& wanted, std::string_view unit) {
  const std::string bare = found.reference == Reference::none
                               ? std::string(text)
                               : std::string(text.substr(0, text.rfind(' ')));
  if (wanted.reference == Reference::none) {
    if (found.reference == Reference::none) return std::nullopt;
    return Mistake{in_quotes(text), describe_unit(unit), in_quotes(bare)};
  }
  const bool want_difference = wanted.reference == Reference::difference;
  const bool have_difference = found.reference == Reference::difference;
  if (found.reference != Reference::none && want_difference == have_difference) return std::nullopt;
  const bool silent = found.reference == Reference::none;
  return Mistake{silent ? fmt::format("{}, a pressure without its reference", in_quotes(text))
                        : in_quotes(text),
                 describe_unit(unit),
                 want_difference ? fmt::format("\"{} diff\"", bare)
                                 : fmt::format("\"{} gauge\" or \"{} abs\"", bare, bare)};
}

double moved(double pressure, Reference from, Reference to, double atmosphere) {
  if (from == Reference::gauge && to == Reference::absolute) {
    return units::absolute(pressure, atmosphere);
  }
  if (from == Reference::absolute && to == Reference::gauge) {
    return units::gauge(pressure, atmosphere);
  }
  return pressure;
}

}  // namespace

std::vector<std::string> usual_units(std::string_view unit) {
  std::vector<std::string> out;
  if (const UsualUnits* kind = kind_of_unit(unit)) {
    for (const std::string_view one : kind->units)
      out.push_back(std::string(one) + std::string(unit.substr(kind->si.size())));
    return out;
  }
  std::string usual = with_usual_words(unit);
  const bool percent =
      usual.starts_with("1/") && (unit.find("count") != unit.npos || unit.find('N') != unit.npos);
  if (percent) usual.replace(0, 1, "%");
  out.emplace_back(unit);
  if (usual != unit) out.insert(percent ? out.begin() : out.end(), std::move(usual));
  return out;
}

namespace {

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
    const double least = one.ends_with(" abs") ? 0.5 * units::atmosphere : kind->least;
    const double si = std::abs(split_unit(one).reading.unit.to_si(number));
    if (si >= least && si <= kind->most) out.push_back(one);
  }
  return out.empty() ? all : out;
}

}  // namespace

Mistake missing_unit(std::string_view number, std::string_view unit, std::string_view before) {
  Mistake out{fmt::format("{} without a unit", number), describe_unit(unit), ""};
  if (!before.empty() && !parse_quantity(before, unit).mistake)
    out.try_this =
        fmt::format("\"{} {}\", the unit of what stood there", number, split_number(before).rest);
  else
    out.try_this = quoted_units(number, plausible_units(split_number(number).number, unit));
  return out;
}

Parsed parse_quantity(std::string_view text, std::string_view unit, double atmosphere,
                      std::string_view before) {
  const FullUnit wanted = field_unit(unit);
  const std::string_view body = trimmed(text);
  const auto [number, rest, error] = split_number(body);
  if (error == std::errc::result_out_of_range)
    return {0, Mistake{in_quotes(text), describe_finite(unit), number_range}};
  if (error != std::errc{}) {
    const std::string example = unit == "1" ? "0.5" : fmt::format("1 {}", unit);
    return {0, Mistake{in_quotes(text), describe_unit(unit),
                       fmt::format("a number first, as in \"{}\"", example)}};
  }
  if (!std::isfinite(number)) {
    return {0, Mistake{in_quotes(text), describe_finite(unit), ""}};
  }
  if (const auto hint = comma_hint(body, rest); !hint.empty()) {
    return {0, Mistake{in_quotes(text), describe_unit(unit), hint}};
  }
  if (rest.empty() && wanted.reading.unit.dimension != Dimension{}) {
    return {0, missing_unit(body, unit, before)};
  }
  const FullUnit found = split_unit(rest);
  if (auto mistake = check_unit(body, found, wanted, unit)) return {0, mistake};
  if (auto mistake = check_reference(body, found, wanted, unit)) return {0, mistake};
  const double si = wanted.reading.unit.from_si(found.reading.unit.to_si(number));
  if (!std::isfinite(si)) return {0, Mistake{in_quotes(text), describe_finite(unit), number_range}};
  return {moved(si, found.reference, wanted.reference, atmosphere), std::nullopt};
}

double quantity(std::string_view text, std::string_view unit, std::string_view key,
                double atmosphere) {
  const Parsed parsed = parse_quantity(text, unit, atmosphere);
  if (!parsed.mistake) return parsed.si;
  const Mistake& m = *parsed.mistake;
  fail({"text", 0, 0}, std::string(key), m.found, m.expected, m.try_this);
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

std::string format_quantity(double si, std::string_view unit) {
  return unit == "1" || unit.empty() ? format_number(si)
                                     : fmt::format("{} {}", format_number(si), unit);
}

std::string format_quantity(double si, std::string_view unit, std::string_view display,
                            int significant_digits, double atmosphere) {
  const double number = convert(si, unit, display, atmosphere);
  return fmt::format("{:.{}g}{}{}", number, significant_digits, display == "1" ? "" : " ",
                     display == "1" ? "" : display);
}

std::string range_text(double low, double high, std::string_view unit) {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (!has_low && !has_high) return "";
  if (!has_low) return "at most " + format_quantity(high, unit);
  if (!has_high) return "at least " + format_quantity(low, unit);
  return fmt::format("{} to {}", format_quantity(low, unit), format_quantity(high, unit));
}

double convert(double si, std::string_view unit, std::string_view display, double atmosphere) {
  const FullUnit from = field_unit(unit);
  const FullUnit to = field_unit(display);
  const bool same = from.reading.unit.dimension == to.reading.unit.dimension;
  const bool difference_from = from.reference == Reference::difference;
  const bool difference_to = to.reference == Reference::difference;
  if (!same || difference_from != difference_to) {
    throw std::logic_error(fmt::format("cannot show {} in {}", unit, display));
  }
  const double shifted = moved(si, from.reference, to.reference, atmosphere);
  return to.reading.unit.from_si(from.reading.unit.to_si(shifted));
}

std::string coefficient_unit(std::string_view unit, std::string_view per, int k) {
  if (unit == per && k > 0) {
    // x polynomial in x: m, 1, 1/m, 1/m2 ...
    return k == 1 ? "1" : coefficient_unit("1", per, k - 1);
  }
  if (k == 0 || per == "1") return std::string(unit);
  const bool compound_unit = unit.find('/') != unit.npos;
  const bool compound_per = per.find_first_of(" /*") != per.npos;
  std::string power = k == 1 ? std::string(per) : fmt::format("{}{}", per, k);
  if (compound_per) {
    power = fmt::format("({})", per);
    for (int i = 1; i < k; ++i) power += fmt::format(" ({})", per);
    if (k > 1) power = fmt::format("({})", power);
  }
  return compound_unit ? fmt::format("({})/{}", unit, power) : fmt::format("{}/{}", unit, power);
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
  const auto* name = name_of(dimension);
  return name ? fmt::format("{} ({})", unit, name->word) : std::string(unit);
}

}  // namespace sinew::config
