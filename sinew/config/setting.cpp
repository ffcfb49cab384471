#include "sinew/config/setting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sinew/config/diagnostics.h"
#include "sinew/units/quantity.h"
#include "sinew/units/unit.h"

namespace sinew::config {

namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(at, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

std::string describe_range(const Range& range, std::string_view unit) {
  const std::string low = units::format_quantity(range.low, unit, unit);
  const std::string high = units::format_quantity(range.high, unit, unit);
  std::string out = range.above ? "more than " + low : low;
  if (range.low == -units::unbounded)
    out = "at most " + high;
  else if (range.high == units::unbounded)
    out = range.above ? out : "at least " + low;
  else
    out += (range.above ? ", at most " : " to ") + high;
  return out + (range.why.empty() ? "" : ": ") + std::string(range.why);
}

void refuse_outside(std::string_view name, const std::string& text, double si,
                    std::string_view unit, const Range& range) {
  if ((range.above ? si > range.low : si >= range.low) && si <= range.high) return;
  std::string found = text;
  const std::string plain = units::format_quantity(si, unit, unit);
  if (text != in_quotes(plain) && text != plain) found += ", which is " + plain;
  fail({std::string(name), 0, 0}, "", found, describe_range(range, unit));
}

}  // namespace

double quantity_setting(std::string_view name, std::string_view text, std::string_view unit,
                        double atmosphere, const Range& range) {
  const units::Parsed parsed = units::parse_quantity(text, unit, atmosphere);
  if (parsed.mistake) fail({std::string(name), 0, 0}, "", *parsed.mistake);
  refuse_outside(name, in_quotes(text), parsed.si, unit, range);
  return parsed.si;
}

double quantity(std::string_view text, std::string_view unit, std::string_view key,
                double atmosphere) {
  const units::Parsed parsed = units::parse_quantity(text, unit, atmosphere);
  if (parsed.mistake) fail({"text", 0, 0}, std::string(key), *parsed.mistake);
  return parsed.si;
}

std::string quantity_like(const Origins& origins, std::string_view path, double si,
                          std::string_view unit, std::string_view otherwise, double room) {
  const Origin* origin = find_origin(origins, path);
  const bool is_given = origin && !origin->is_default;
  return units::quantity_like(is_given ? std::string_view(origin->text) : std::string_view{}, si,
                              unit, otherwise, room);
}

double number_setting(std::string_view name, double value, const Range& range) {
  refuse_outside(name, units::format_number(value), value, "1", range);
  return value;
}

namespace {

// Returns the text of a difference of pressures, which has no reference.
std::string without_reference(std::string_view text) {
  const auto [unit, word] = units::unit_and_reference(text);
  return std::string(word == "diff" ? text : unit);
}

// Returns "1 in:2 in:0.1 in" in the unit that was written, or else in a usual one.
std::string range_example(std::string_view unit, std::string_view written) {
  if (unit == "1") return "\"0:1:0.1\"";
  std::string usual = units::written_unit(written);
  if (units::parse_quantity("1 " + usual, unit).mistake) usual = units::usual_units(unit).front();
  return in_quotes("1 " + usual + ":2 " + usual + ":0.1 " + without_reference(usual));
}

}  // namespace

QuantityRange range_setting(std::string_view name, std::string_view text, std::string_view unit,
                            double atmosphere, const Range& range) {
  constexpr double most = 10000;
  const auto refuse = [&](std::string_view found, std::string expected, std::string try_this) {
    fail({std::string(name), 0, 0}, "", in_quotes(found), std::move(expected), std::move(try_this));
  };
  const std::vector<std::string_view> parts = split(text, ':');
  const bool has_units = parts.size() != 3 || unit == "1" || units::written_unit(parts[0]) != "1";
  if ((parts.size() != 1 && parts.size() != 3) || !has_units)
    refuse(text, "a quantity, or from:to:step, each with its unit",
           range_example(unit, has_units ? parts[0] : parts[2]));
  QuantityRange out{{quantity_setting(name, parts[0], unit, atmosphere, range)},
                    units::written_unit(parts[0])};
  if (parts.size() == 1) return out;

  const std::string_view step_unit = units::difference_unit(unit);
  std::string step_text(parts[2]);
  if (step_unit == "Pa diff" && without_reference(step_text) != step_text)
    refuse(step_text, "a step, which is a difference of two pressures",
           in_quotes(without_reference(step_text)));
  if (step_unit == "Pa diff" && !step_text.ends_with("diff")) step_text += " diff";
  const double first = out.si[0];
  const double last = quantity_setting(name, parts[1], unit, atmosphere, range);
  const double step = quantity_setting(name, step_text, step_unit, atmosphere);

  // The last value is included although steps are rounded.
  const double steps = step != 0 ? std::floor((last - first) / step + 1e-9) : -1;
  if (!(steps >= 0))
    refuse(text, "a step that leads from the first to the last", range_example(unit, parts[0]));
  if (steps >= most) refuse(text, "at most 10000 values", "a larger step");
  for (int i = 1; i <= static_cast<int>(steps); ++i) out.si.push_back(first + i * step);
  return out;
}

std::vector<double> list_setting(std::string_view name, std::string_view text,
                                 std::string_view unit, const Range& range) {
  std::vector<double> out;
  for (const std::string_view part : split(text, ','))
    out.push_back(quantity_setting(name, part, unit, units::atmosphere, range));
  return out;
}

std::vector<std::string> at_commas(const std::string& text) {
  std::vector<std::string> out;
  if (text.empty()) return out;
  for (const std::string_view piece : split(text, ','))
    out.emplace_back(piece.substr(std::min(piece.find_first_not_of(' '), piece.size())));
  return out;
}

void refuse_setting(std::string_view name, const std::string& found, const std::string& expected,
                    const std::string& try_this) {
  fail({std::string(name), 0, 0}, "", found, expected, try_this);
}

}  // namespace sinew::config
