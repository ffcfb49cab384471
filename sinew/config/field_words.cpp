#include "sinew/config/field_words.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/units/ranges.h"

namespace sinew::config {

namespace {

std::string bounds_text(const units::Field& field) {
  const std::string low = format_quantity(field.min, field.unit);
  const std::string high = format_quantity(field.max, field.unit);
  if (field.max == units::unbounded) return "at least " + low;
  if (field.min == -units::unbounded) return "at most " + high;
  return fmt::format("{} to {}", low, high);
}

}  // namespace

std::string default_text(double value, std::string_view unit) {
  return std::isfinite(value) ? format_quantity(value, unit) : "not set";
}

std::string joined(const std::vector<double>& values, std::string_view unit) {
  std::string text;
  for (double v : values) text += (text.empty() ? "" : ", ") + default_text(v, unit);
  return text;
}

std::string number_text(const units::Field& field) {
  std::string text = describe_unit(field.unit);
  if (field.min != -units::unbounded || field.max != units::unbounded)
    text += ", " + bounds_text(field);
  return text;
}

std::string whole_text(const units::Field& field) {
  const bool low = field.min != -units::unbounded, high = field.max != units::unbounded;
  if (low && high) return fmt::format("a whole number, {:.0f} to {:.0f}", field.min, field.max);
  if (low) return fmt::format("a whole number, at least {:.0f}", field.min);
  return high ? fmt::format("a whole number, at most {:.0f}", field.max) : "a whole number";
}

std::string words_text(const std::vector<std::string_view>& words) {
  std::vector<std::string> quoted;
  for (const std::string_view word : words) quoted.push_back(in_quotes(word));
  return either({quoted.begin(), quoted.end()});
}

std::string with_reason(std::string text, std::string_view why) {
  return why.empty() ? text : fmt::format("{}: {}", text, why);
}

std::string out_of_bounds(const units::Field& field, double value) {
  if (!(value >= field.min && value <= field.max)) {
    return with_reason(bounds_text(field), field.why);
  }
  if (value != 0 && std::abs(value) < field.least) {
    const std::string least = format_quantity(field.least, field.unit);
    return with_reason("0, or at least " + least, field.why);
  }
  const units::Range& range = units::range_of(field.unit);
  if (std::abs(value) <= range.most) return {};
  const double end = std::copysign(range.most, value);
  const std::string text = format_quantity(end, field.unit);
  return with_reason((value > 0 ? "at most " : "at least ") + text, range.why);
}

}  // namespace sinew::config
