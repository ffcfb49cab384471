#include "sinew/units/spelling.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sinew/units/constants.h"
#include "sinew/units/letters.h"
#include "sinew/units/unit.h"

namespace sinew::units {

namespace {

using namespace std::string_view_literals;

// Characters outside ASCII, and powers, in Sinew's spelling.
constexpr std::pair<std::string_view, std::string_view> signs[] = {
    {"\u00B0C", "degC"},   {"\u2103", "degC"}, {"\u00B0", "deg"},
    {"\u00BA", "deg"},     {"\u00B2", "2"},    {"\u00B3", "3"},
    {"\u00B5", "u"},       {"\u03BC", "u"},    {"\u00B7", " "},
    {"\u22C5", " "},       {"\u2219", " "},    {"\u00D7", " "},
    {"\u2022", " "},       {"*", " "},         {"^", ""},
    {"\u03A9", "ohm"},     {"\u2126", "ohm"},  {"\u2033", "in"},
    {"\u201D", "in"},      {"''", "in"},       {"\"", "in"},
    {"\u207B\u00B9", "-1"}};

std::string with_plain_signs(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto* sign = std::find_if(std::begin(signs), std::end(signs), [&](const auto& s) {
      return text.substr(at).starts_with(s.first);
    });
    const bool found = sign != std::end(signs);
    out += found ? sign->second : text.substr(at, 1);
    at += found ? sign->first.size() : 1;
  }
  return out;
}

// Spellings of a whole unit in lower case, separated by commas, and the value of one of them in a
// unit of Sinew.
struct Whole {
  std::string_view ours, theirs;
  double factor = 1;
};
constexpr double kilopond = standard_gravity;  // [N]
// clang-format off
constexpr Whole wholes[] = {
    {"N m", "nm, n-m"},
    {"N mm", "nmm"},
    {"N cm", "ncm"},
    {"kN m", "knm"},
    {"lbf in", "lbin, lb-in, inlb, in-lb, in lb, lbfin, lbf-in, in-lbf, inlbf"},
    {"lbf ft", "lbft, lb-ft, ftlb, ft-lb, ft lb, ftlbf, ft-lbf, lbf-ft"},
    {"N", "kgf, kp", kilopond},
    {"N", "dan", 10},
    {"lbf", "ozf", 1.0 / 16},
    {"N m", "kgf m, kp m", kilopond},
    {"N cm", "kgf cm, kp cm, kgf-cm", kilopond},
    {"Pa", "kgf/cm2, kp/cm2, at", kilopond * 1e4},
    {"bar", "mbar", 1e-3},
    {"Pa", "hpa", 100},
    {"Pa", "torr", 101325.0 / 760},
    {"Pa", "mmhg", 133.322387415},
    {"Pa", "inhg", 3386.389},
    {"Pa", "inh2o", 249.08891},
    {"Pa", "mmh2o", kilopond},
    {"Pa", "atm", 101325},
    {"psi", "ksi", 1000},
    {"rpm", "u/min, rev/min, r/min, umdr/min, rpm"},
    {"rpm", "rps, rev/s", 60},
    {"1/min", "min-1"},
    {"1/s", "s-1"},
    {"m/s2", "m/s-2, ms-2"},
    {"deg/s", "dps"},
    {"L/min", "lpm"},
    {"cm3", "ccm, cc"},
    {"ft3/min", "cfm"},
    {"1", "-, none"},
    {"us", "ns", 1e-3},
    {"mm", "um, micron", 1e-3},
    {"in", "mil", 1e-3},
    {"mA", "ua", 1e-3},
    {"mV", "uv", 1e-3},
    {"ohm", "kohm", 1e3},
    {"J", "kj", 1e3},
    {"W", "kw", 1e3},
    {"mL", "nl", 1e-6},
};
// clang-format on

// Units distinguished by capitals: milli and mega in "mN" and "MN", nano and newton in "nm" and
// "Nm". An empty one is refused.
// clang-format off
constexpr Whole by_capitals[] = {
    {"N", "mN", 1e-3},
    {"kN", "MN", 1e3},
    {"N", "nN", 1e-9},
    {"mm", "nm", 1e-6},
    {"N m", "mNm", 1e-3},
    {"kN m", "MNm", 1e3},
    {"kHz", "MHz", 1e3},
    {"Hz", "mHz", 1e-3},
    {"W", "mW", 1e-3},
    {"W", "MW", 1e6},
    {"ohm", "mohm, mOhm", 1e-3},
    {"ohm", "Mohm, MOhm", 1e6},
    {"Pa", "mPa", 1e-3},
    {"", "mpa"},
    {"N s", "Ns"},
};
// clang-format on

// Names of a unit within a longer one, in lower case.
// clang-format off
constexpr Whole known_words[] = {
    {"s", "sec, secs, second, seconds, sek, sekunden, s"},
    {"ms", "msec, msecs, millis, millisecond, milliseconds"},
    {"us", "usec, micros, microseconds"},
    {"min", "minute, minutes, mins"},
    {"h", "hr, hrs, hour, hours, std"},
    {"in", "inch, inches, zoll, in"},
    {"ft", "foot, feet, ft"},
    {"m", "meter, meters, metre, metres, m"},
    {"mm", "millimeter, millimeters, millimetre, millimetres, mm"},
    {"cm", "centimeter, centimeters, cm"},
    {"deg", "degree, degrees, degs, deg"},
    {"rad", "radian, radians, rad"},
    {"degC", "celsius, degc"},
    {"K", "kelvin"},
    {"V", "volt, volts, v"},
    {"A", "ampere, amp, amps"},
    {"ohm", "ohms"},
    {"count", "counts, cts, lsb, digits, ticks"},
    {"kg", "kilogram, kilograms, kg"},
    {"g", "gram, grams, gramm"},
    {"N", "newton, newtons, n"},
    {"Pa", "pascal, pascals, pa"},
    {"L", "liter, litre, liters, litres, l"},
    {"mL", "ml"},
    {"%", "percent, pct, prozent"},
    {"psi", "psi"},
    {"bar", "bar, bars"},
    {"kPa", "kpa"},
    {"Hz", "hz"},
    {"kHz", "khz"},
    {"kN", "kn"},
    {"km", "km"},
    {"lbf", "lbf, lbsf, poundforce"},
    {"mV", "mv"},
    {"mA", "ma"},
    {"J", "joule"},
    {"W", "watt, watts"},
};
// clang-format on

// Returns the row of a table that lists the spelling; nullptr if none does.
template <std::size_t count>
const Whole* row_with(const Whole (&table)[count], std::string_view spelling) {
  const auto lists = [&](const Whole& row) {
    for (std::string_view rest = row.theirs; !rest.empty();) {
      const std::size_t end = std::min(rest.find(','), rest.size());
      if (rest.substr(0, end) == spelling) return true;
      rest.remove_prefix(std::min(end + 2, rest.size()));
    }
    return false;
  };
  const Whole* row = std::ranges::find_if(table, lists);
  return row == std::end(table) ? nullptr : row;
}

// Endings that give the reference of a pressure, in the order in which they are tried.
constexpr std::pair<std::string_view, std::string_view> reference_words[] = {
    {" gauge", "gauge"},   {" abs", "abs"},      {" diff", "diff"},   {"(g)", "gauge"},
    {"(a)", "abs"},        {"(d)", "diff"},      {" g", "gauge"},     {" a", "abs"},
    {" rel", "gauge"},     {"(rel)", "gauge"},   {" rel.", "gauge"},  {"(abs)", "abs"},
    {" abs.", "abs"},      {"(gauge)", "gauge"}, {"\u00FC", "gauge"}, {" \u00FC", "gauge"},
    {"(\u00FC)", "gauge"}, {"(rel.)", "gauge"},  {"(abs.)", "abs"},   {"_g", "gauge"},
    {"_a", "abs"},         {"g", "gauge"},       {"a", "abs"},        {"d", "diff"}};

bool is_pressure(std::string_view unit) {
  const UnitReading reading = read_unit(unit);
  return reading.ok && reading.unit.dimension == dimension::pressure;
}

bool reads(std::string_view unit) { return !unit.empty() && read_unit(unit).ok; }

// Replaces each name between signs: "lbf/sec" -> "lbf/s". A hyphen between names multiplies.
std::string with_our_words(std::string_view text) {
  std::string out = with_words(text, " /()-23456789", [](std::string_view piece) {
    // Sinew's own names are kept: the capitals in "MPa" and "mm" matter.
    const bool ours = find_unit(piece) != known_units.end();
    const Whole* word = ours ? nullptr : row_with(known_words, lower(piece));
    return word ? word->ours : piece;
  });
  std::ranges::replace(out, '-', ' ');
  return out;
}

// "1/min" is a frequency or a rotational speed.
void add_turns(std::vector<Spelling>& out) {
  if (out.size() == 1 && out[0].unit == "1/min") out.push_back({"rpm"});
  if (out.size() == 1 && out[0].unit == "1/s") out.push_back({"rpm", 60});
}

// Returns the spellings of a unit without a reference.
std::vector<Spelling> bare_spellings(std::string_view text) {
  std::vector<Spelling> out;
  if (reads(text)) {
    out.push_back({std::string(text)});
    add_turns(out);
    return out;
  }
  const std::string plain = with_plain_signs(text);
  const std::string_view text_in_ascii = trimmed(plain);
  if (const Whole* whole = row_with(by_capitals, text_in_ascii)) {
    if (!whole->ours.empty()) out.push_back({std::string(whole->ours), whole->factor});
    return out;
  }
  if (const Whole* whole = row_with(wholes, lower(text_in_ascii))) {
    out.push_back({std::string(whole->ours), whole->factor});
  } else {
    std::string ours = with_our_words(text_in_ascii);
    if (lower(ours) == "mpa") ours = "MPa";  // "Mpa"; "mpa" was refused above
    if (reads(ours)) out.push_back({std::move(ours)});
  }
  add_turns(out);
  return out;
}

}  // namespace

bool is_unit(std::string_view unit) {
  const auto [bare, reference] = unit_and_reference(trimmed(unit));
  return reference.empty() ? reads(bare) : is_pressure(bare);
}

std::vector<Spelling> spellings(std::string_view unit) {
  std::string_view text = trimmed(unit);
  while (text.size() > 2 && text.front() == '[' && text.back() == ']')
    text = trimmed(text.substr(1, text.size() - 2));
  if (text.empty()) return {};

  // Pressures with a reference: "psig", "bar abs", and "bar g", which is not a bar times a gram.
  for (const auto& [ending, reference] : reference_words) {
    const std::string small = lower(text);
    if (!small.ends_with(ending) || small.size() == ending.size()) continue;
    const std::string_view bare = trimmed(text.substr(0, text.size() - ending.size()));
    std::vector<Spelling> out = bare_spellings(bare);
    if (out.empty() || !is_pressure(out.front().unit)) continue;
    out.front().unit.append(1, ' ').append(reference);
    return out;
  }
  return bare_spellings(text);
}

}  // namespace sinew::units
