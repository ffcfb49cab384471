#include "sinew/config/spelling.h"

#include <algorithm>
#include <array>
#include <utility>

#include "sinew/units/constants.h"
#include "sinew/units/unit.h"

namespace sinew::config {

namespace {

using namespace std::string_view_literals;

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

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

// Whole units in lower case that are written as one word or that Sinew lacks, and their value in a
// unit of Sinew.
struct Whole {
  std::string_view theirs, ours;
  double factor = 1;
};
constexpr double kilopond = units::standard_gravity;  // [N]
constexpr Whole wholes[] = {
    {"nm", "N m"},
    {"n-m", "N m"},
    {"nmm", "N mm"},
    {"ncm", "N cm"},
    {"knm", "kN m"},
    {"lbin", "lbf in"},
    {"lb-in", "lbf in"},
    {"inlb", "lbf in"},
    {"in-lb", "lbf in"},
    {"in lb", "lbf in"},
    {"lbfin", "lbf in"},
    {"lbf-in", "lbf in"},
    {"in-lbf", "lbf in"},
    {"inlbf", "lbf in"},
    {"lbft", "lbf ft"},
    {"lb-ft", "lbf ft"},
    {"ftlb", "lbf ft"},
    {"ft-lb", "lbf ft"},
    {"ft lb", "lbf ft"},
    {"ftlbf", "lbf ft"},
    {"ft-lbf", "lbf ft"},
    {"lbf-ft", "lbf ft"},
    {"kgf", "N", kilopond},
    {"kp", "N", kilopond},
    {"dan", "N", 10},
    {"ozf", "lbf", 1.0 / 16},
    {"kgf m", "N m", kilopond},
    {"kp m", "N m", kilopond},
    {"kgf cm", "N cm", kilopond},
    {"kp cm", "N cm", kilopond},
    {"kgf-cm", "N cm", kilopond},
    {"kgf/cm2", "Pa", kilopond * 1e4},
    {"kp/cm2", "Pa", kilopond * 1e4},
    {"mbar", "bar", 1e-3},
    {"hpa", "Pa", 100},
    {"torr", "Pa", 101325.0 / 760},
    {"mmhg", "Pa", 133.322387415},
    {"inhg", "Pa", 3386.389},
    {"inh2o", "Pa", 249.08891},
    {"mmh2o", "Pa", kilopond},
    {"at", "Pa", kilopond * 1e4},
    {"atm", "Pa", 101325},
    {"ksi", "psi", 1000},
    {"u/min", "rpm"},
    {"rev/min", "rpm"},
    {"r/min", "rpm"},
    {"umdr/min", "rpm"},
    {"rpm", "rpm"},
    {"rps", "rpm", 60},
    {"rev/s", "rpm", 60},
    {"min-1", "1/min"},
    {"s-1", "1/s"},
    {"m/s-2", "m/s2"},
    {"ms-2", "m/s2"},
    {"dps", "deg/s"},
    {"lpm", "L/min"},
    {"ccm", "cm3"},
    {"cc", "cm3"},
    {"cfm", "ft3/min"},
    {"-", "1"},
    {"none", "1"},
    {"ns", "us", 1e-3},
    {"um", "mm", 1e-3},
    {"micron", "mm", 1e-3},
    {"mil", "in", 1e-3},
    {"ua", "mA", 1e-3},
    {"uv", "mV", 1e-3},
    {"kohm", "ohm", 1e3},
    {"kj", "J", 1e3},
    {"kw", "W", 1e3},
    {"nl", "mL", 1e-6},
};

// Units distinguished by capitals: milli and mega in "mN" and "MN", nano and newton in "nm" and
// "Nm".
constexpr std::pair<std::string_view, Whole> by_capitals[] = {
    {"mN", {"", "N", 1e-3}},    {"MN", {"", "kN", 1e3}},     {"nN", {"", "N", 1e-9}},
    {"nm", {"", "mm", 1e-6}},   {"mNm", {"", "N m", 1e-3}},  {"MNm", {"", "kN m", 1e3}},
    {"MHz", {"", "kHz", 1e3}},  {"mHz", {"", "Hz", 1e-3}},   {"mW", {"", "W", 1e-3}},
    {"MW", {"", "W", 1e6}},     {"mohm", {"", "ohm", 1e-3}}, {"mOhm", {"", "ohm", 1e-3}},
    {"Mohm", {"", "ohm", 1e6}}, {"MOhm", {"", "ohm", 1e6}},  {"mPa", {"", "Pa", 1e-3}},
    {"mpa", {"", ""}},          {"Ns", {"", "N s"}},
};

// Names of a unit within a longer one, in lower case.
using Word = std::pair<std::string_view, std::string_view>;
constexpr Word known_words[] = {{"sec", "s"},
                                {"secs", "s"},
                                {"second", "s"},
                                {"seconds", "s"},
                                {"sek", "s"},
                                {"sekunden", "s"},
                                {"msec", "ms"},
                                {"msecs", "ms"},
                                {"millis", "ms"},
                                {"millisecond", "ms"},
                                {"milliseconds", "ms"},
                                {"usec", "us"},
                                {"micros", "us"},
                                {"microseconds", "us"},
                                {"minute", "min"},
                                {"minutes", "min"},
                                {"mins", "min"},
                                {"hr", "h"},
                                {"hrs", "h"},
                                {"hour", "h"},
                                {"hours", "h"},
                                {"std", "h"},
                                {"inch", "in"},
                                {"inches", "in"},
                                {"zoll", "in"},
                                {"foot", "ft"},
                                {"feet", "ft"},
                                {"meter", "m"},
                                {"meters", "m"},
                                {"metre", "m"},
                                {"metres", "m"},
                                {"millimeter", "mm"},
                                {"millimeters", "mm"},
                                {"millimetre", "mm"},
                                {"millimetres", "mm"},
                                {"centimeter", "cm"},
                                {"centimeters", "cm"},
                                {"degree", "deg"},
                                {"degrees", "deg"},
                                {"degs", "deg"},
                                {"radian", "rad"},
                                {"radians", "rad"},
                                {"celsius", "degC"},
                                {"kelvin", "K"},
                                {"volt", "V"},
                                {"volts", "V"},
                                {"ampere", "A"},
                                {"amp", "A"},
                                {"amps", "A"},
                                {"ohms", "ohm"},
                                {"counts", "count"},
                                {"cts", "count"},
                                {"lsb", "count"},
                                {"digits", "count"},
                                {"ticks", "count"},
                                {"kilogram", "kg"},
                                {"kilograms", "kg"},
                                {"gram", "g"},
                                {"grams", "g"},
                                {"gramm", "g"},
                                {"newton", "N"},
                                {"newtons", "N"},
                                {"pascal", "Pa"},
                                {"pascals", "Pa"},
                                {"liter", "L"},
                                {"litre", "L"},
                                {"liters", "L"},
                                {"litres", "L"},
                                {"l", "L"},
                                {"ml", "mL"},
                                {"percent", "%"},
                                {"pct", "%"},
                                {"prozent", "%"},
                                {"psi", "psi"},
                                {"bar", "bar"},
                                {"bars", "bar"},
                                {"kpa", "kPa"},
                                {"pa", "Pa"},
                                {"hz", "Hz"},
                                {"khz", "kHz"},
                                {"n", "N"},
                                {"kn", "kN"},
                                {"v", "V"},
                                {"mm", "mm"},
                                {"cm", "cm"},
                                {"m", "m"},
                                {"km", "km"},
                                {"in", "in"},
                                {"ft", "ft"},
                                {"s", "s"},
                                {"deg", "deg"},
                                {"rad", "rad"},
                                {"lbf", "lbf"},
                                {"kg", "kg"},
                                {"degc", "degC"},
                                {"mv", "mV"},
                                {"ma", "mA"},
                                {"joule", "J"},
                                {"watt", "W"},
                                {"watts", "W"},
                                {"lbsf", "lbf"},
                                {"poundforce", "lbf"}};

// Endings that give the reference of a pressure.
constexpr std::pair<std::string_view, std::string_view> reference_words[] = {
    {" gauge", "gauge"},   {" abs", "abs"},      {" diff", "diff"},   {"(g)", "gauge"},
    {"(a)", "abs"},        {"(d)", "diff"},      {" g", "gauge"},     {" a", "abs"},
    {" rel", "gauge"},     {"(rel)", "gauge"},   {" rel.", "gauge"},  {"(abs)", "abs"},
    {" abs.", "abs"},      {"(gauge)", "gauge"}, {"\u00FC", "gauge"}, {" \u00FC", "gauge"},
    {"(\u00FC)", "gauge"}, {"(rel.)", "gauge"},  {"(abs.)", "abs"},   {"_g", "gauge"},
    {"_a", "abs"},         {"g", "gauge"},       {"a", "abs"},        {"d", "diff"}};

bool is_pressure(std::string_view unit) {
  const units::UnitReading reading = units::read_unit(unit);
  return reading.ok && reading.unit.dimension == units::dimension::pressure;
}

bool reads(std::string_view unit) { return !unit.empty() && units::read_unit(unit).ok; }

// Replaces each name between signs: "lbf/sec" -> "lbf/s". A hyphen between names multiplies.
std::string with_our_words(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" /()-23456789", at), text.size());
    const std::string_view piece = text.substr(at, end - at);
    const std::string small = lower(piece);
    const auto* word = std::ranges::find(known_words, small, &Word::first);
    // Sinew's own names are kept: the capitals in "MPa" and "mm" matter.
    const bool ours = units::find_unit(piece) != units::known_units.end();
    if (!ours && word != std::end(known_words))
      out += word->second;
    else
      out += piece;
    if (end < text.size()) out += text[end] == '-' ? ' ' : text[end];
    at = end + 1;
  }
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
  const std::string_view trimmed = without_blanks(plain);
  for (const auto& [name, whole] : by_capitals) {
    if (trimmed != name) continue;
    if (!whole.ours.empty()) out.push_back({std::string(whole.ours), whole.factor});
    return out;
  }
  const std::string small = lower(trimmed);
  const auto* whole = std::ranges::find(wholes, small, &Whole::theirs);
  if (whole != std::end(wholes)) {
    out.push_back({std::string(whole->ours), whole->factor});
  } else {
    std::string ours = with_our_words(trimmed);
    if (lower(ours) == "mpa") ours = "MPa";  // "Mpa"; "mpa" was refused above
    if (reads(ours)) out.push_back({std::move(ours)});
  }
  add_turns(out);
  return out;
}

}  // namespace

bool is_unit(std::string_view unit) {
  std::string_view bare = without_blanks(unit);
  for (const std::string_view reference : {" gauge", " abs", " diff"})
    if (bare.ends_with(reference)) {
      bare.remove_suffix(reference.size());
      return is_pressure(bare);
    }
  return reads(bare);
}

std::vector<Spelling> spellings(std::string_view unit) {
  std::string_view text = without_blanks(unit);
  while (text.size() > 2 && text.front() == '[' && text.back() == ']')
    text = without_blanks(text.substr(1, text.size() - 2));
  if (text.empty()) return {};

  // Pressures with a reference: "psig", "bar abs", and "bar g", which is not a bar times a gram.
  for (const auto& [ending, reference] : reference_words) {
    const std::string small = lower(text);
    if (!small.ends_with(ending) || small.size() == ending.size()) continue;
    const std::string_view bare = without_blanks(text.substr(0, text.size() - ending.size()));
    std::vector<Spelling> out = bare_spellings(bare);
    if (out.empty() || !is_pressure(out.front().unit)) continue;
    out.front().unit.append(1, ' ').append(reference);
    return out;
  }
  return bare_spellings(text);
}

}  // namespace sinew::config
