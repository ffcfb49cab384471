#include "cli/arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"

namespace sinew::cli {

namespace {

constexpr double most_values = 10000;

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(at, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

[[noreturn]] void refuse(std::string_view option, std::string_view text, std::string expected,
                         std::string try_this) {
  config::fail({std::string(option), 0, 0}, "", config::in_quotes(text), std::move(expected),
               std::move(try_this));
}

// "1 in:2 in:0.1 in" in the unit that was written, or else in a usual one; a step of pressures is
// neither gauge nor absolute.
std::string example_of(std::string_view unit, std::string_view written) {
  if (unit == "1") return "\"0:1:0.1\"";
  std::string usual = unit_text(written);
  if (config::parse_quantity("1 " + usual, unit).mistake) usual = config::usual_units(unit).front();
  std::string step = usual;
  for (const std::string_view point : {" gauge", " abs"})
    if (step.ends_with(point)) step.resize(step.size() - point.size());
  return fmt::format("\"1 {0}:2 {0}:0.1 {1}\"", usual, step);
}

}  // namespace

std::string unit_text(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" +"), text.size()));
  double number = 0;
  const char* last = text.data() + text.size();
  std::string unit(std::from_chars(text.data(), last, number).ptr, last);
  unit.erase(unit.find_last_not_of(' ') + 1);
  unit.erase(0, std::min(unit.find_first_not_of(' '), unit.size()));
  return unit.empty() ? "1" : unit;
}

Range gauge_air_pressure(double atmosphere) {
  Range out = air_pressure;
  out.low -= atmosphere;
  out.high -= atmosphere;
  return out;
}

Values arguments(std::string_view option, std::string_view text, std::string_view unit,
                 double atmosphere, const Range& range) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() != 1 && parts.size() != 3)
    refuse(option, text, "a quantity, or from:to:step", example_of(unit, parts[0]));
  Values out{{argument(option, parts[0], unit, atmosphere, range)}, unit_text(parts[0])};
  if (parts.size() == 1) return out;

  const std::string_view step_unit = config::difference_unit(unit);
  std::string step_text(parts[2]);
  for (const std::string_view point : {" gauge", " abs"})
    if (step_unit == "Pa diff" && step_text.ends_with(point))
      refuse(option, parts[2], "a step, which is a difference of two pressures",
             config::in_quotes(step_text.substr(0, step_text.size() - point.size())));
  if (step_unit == "Pa diff" && !step_text.ends_with("diff")) step_text += " diff";
  const double first = out.si[0];
  const double last = argument(option, parts[1], unit, atmosphere, range);
  const double step = argument(option, step_text, step_unit, atmosphere);

  // The last value belongs to it although steps round.
  const double steps = step != 0 ? std::floor((last - first) / step + 1e-9) : -1;
  if (!(steps >= 0))
    refuse(option, text, "a step that leads from the first to the last",
           example_of(unit, parts[0]));
  if (steps >= most_values) refuse(option, text, "at most 10000 values", "a larger step");
  for (int i = 1; i <= static_cast<int>(steps); ++i) out.si.push_back(first + i * step);
  return out;
}

std::vector<double> argument_list(std::string_view option, std::string_view text,
                                  std::string_view unit, const Range& range) {
  std::vector<double> out;
  for (const std::string_view part : split(text, ','))
    out.push_back(argument(option, part, unit, units::atmosphere, range));
  return out;
}

}  // namespace sinew::cli
