#include "sinew/tune/figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/config/diagnostics.h"
#include "sinew/tune/axis.h"
#include "sinew/units/key_endings.h"
#include "sinew/units/quantity.h"

namespace sinew::tune {
namespace {

// Returns the key of summary.json that a heading without its unit is of, by a quantity: "air_used"
// and "3 g" are of "air_used_kg". Empty if no key can be of such a quantity.
std::string key_of_heading(std::string_view name, const std::string& quantity) {
  if (analysis::unit_of_key(name) != "1") return std::string(name);
  for (const auto& [ending, unit] : units::key_endings)
    if (!units::parse_quantity(quantity, unit).mistake) return fmt::format("{}{}", name, ending);
  return "";
}

Figure parse_figure(std::string_view text, std::string_view setting) {
  const std::size_t bracket = text.find('[');
  Figure out{.key = std::string(trimmed(text.substr(0, bracket))),
             .unit = {},
             .setting = std::string(setting)};
  const std::string si = analysis::unit_of_key(out.key);
  out.unit = si;
  if (out.key.empty() || out.key.find(' ') != out.key.npos)
    refuse(setting, text,
           "a key of summary.json, and in brackets the unit to print it in, if another",
           "\"trolley.distance_m [in]\"");
  if (bracket == text.npos) return out;
  if (!text.ends_with(']')) refuse(setting, text, "a bracket that closes");
  out.named = true;
  out.unit = trimmed(text.substr(bracket + 1, text.size() - bracket - 2));
  const units::Parsed parsed = units::parse_quantity("1 " + out.unit, si);
  if (!parsed.mistake) return out;
  const std::string key = si == "1" ? key_of_heading(out.key, "1 " + out.unit) : "";
  refuse(setting, text,
         key.empty() ? "a unit of " + units::describe_unit(si)
                     : "a key of summary.json, which ends in its unit",
         key.empty() ? parsed.mistake->try_this : fmt::format("\"{} [{}]\"", key, out.unit));
}

// Returns the condition that a heading in front of a sign and a value means: "air_used [g]", "<"
// and "3" are "air_used_kg < 3 g".
std::string condition_of_heading(std::string_view heading, std::size_t bracket,
                                 std::string_view sign, std::string_view value) {
  const std::string_view name = trimmed(heading.substr(0, bracket));
  const std::string unit(trimmed(heading.substr(bracket + 1, heading.size() - bracket - 2)));
  const std::string key = key_of_heading(name, "1 " + unit);
  const bool has_unit = value.find_first_not_of("+-.0123456789eE ") != value.npos;
  return fmt::format("\"{} {} {}{}{}\"", key.empty() ? std::string(name) : key, sign, value,
                     has_unit ? "" : " ", has_unit ? "" : unit);
}

}  // namespace

std::string Figure::heading() const {
  return unit == "1" ? key : fmt::format("{} [{}]", analysis::without_unit(key), unit);
}

std::string Figure::cell(const analysis::Summary& summary, double atmosphere) const {
  const double* si = summary.find(key);
  if (!si) return "";
  const std::string own = analysis::unit_of_key(key);
  if (unit == own) return units::format_number(*si);
  return fmt::format("{:.9g}", units::convert(*si, own, unit, atmosphere));
}

std::vector<Figure> parse_figures(std::string_view text, std::string_view setting) {
  std::vector<Figure> out;
  for (const std::string_view part : list_of(text)) out.push_back(parse_figure(part, setting));
  return out;
}

void show_in(const units::ShownUnits& units, std::vector<Figure>& figures) {
  // One unit for a whole column, independent of the values.
  for (Figure& figure : figures)
    if (!figure.named && figure.unit != "1")
      figure.unit = analysis::shown_unit(figure.key, units, 0);
}

std::vector<Figure> reported_figures(const std::vector<config::Reported>& reported,
                                     double atmosphere) {
  std::vector<Figure> out;
  for (const config::Reported& r : reported)
    if (std::ranges::find(out, r.key, &Figure::key) == out.end())
      out.push_back({r.key, analysis::quoted_unit(r, atmosphere)});
  return out;
}

bool Condition::holds(const analysis::Summary& summary) const {
  const double* value = summary.find(key);
  if (!value) return false;
  switch (is) {
    case Is::below:
      return *value < limit;
    case Is::at_most:
      return *value <= limit;
    case Is::above:
      return *value > limit;
    case Is::at_least:
      return *value >= limit;
  }
  return false;
}

Condition parse_condition(std::string_view text, std::string_view setting) {
  const std::size_t sign = text.find_first_of("<>");
  const std::string example = "\"joints.hip.tracking_rms_rad < 5 deg\"";
  Condition out{.key = std::string(trimmed(text.substr(0, sign))),
                .text = std::string(text),
                .setting = std::string(setting)};
  const bool equal = sign + 1 < text.size() && text[sign + 1] == '=';
  const std::size_t bracket = out.key.find('[');
  if (sign != text.npos && bracket != out.key.npos && out.key.ends_with(']'))
    refuse(setting, text, "key < value, with the unit at the value",
           condition_of_heading(out.key, bracket, text.substr(sign, equal ? 2 : 1),
                                trimmed(text.substr(sign + (equal ? 2 : 1)))));
  if (sign == text.npos || out.key.empty() || out.key.find(' ') != out.key.npos)
    refuse(setting, text, "key < value, or with <=, > or >=", example);
  if (text[sign] == '<') out.is = equal ? Condition::Is::at_most : Condition::Is::below;
  if (text[sign] == '>') out.is = equal ? Condition::Is::at_least : Condition::Is::above;

  const std::string_view value = trimmed(text.substr(sign + (equal ? 2 : 1)));
  const units::Parsed parsed = units::parse_quantity(value, analysis::unit_of_key(out.key));
  if (parsed.mistake) {
    const bool has_unit = analysis::unit_of_key(out.key) != "1";
    const std::string key = has_unit ? "" : key_of_heading(out.key, std::string(value));
    config::fail(
        {std::string(setting), 0, 0}, "", out.key + ": " + parsed.mistake->found,
        key.empty() ? parsed.mistake->expected : "a key of summary.json, which ends in its unit",
        key.empty() ? parsed.mistake->try_this : config::in_quotes(key));
  }
  out.limit = parsed.si;
  return out;
}

}  // namespace sinew::tune
