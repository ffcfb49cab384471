#include "sinew/config/setting.h"

#include <algorithm>

#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"

namespace sinew::config {

namespace {

std::string in_words(const Range& range, std::string_view unit) {
  const std::string low = format_quantity(range.low, unit, unit);
  const std::string high = format_quantity(range.high, unit, unit);
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
  const std::string plain = format_quantity(si, unit, unit);
  if (text != in_quotes(plain) && text != plain) found += ", which is " + plain;
  fail({std::string(name), 0, 0}, "", found, in_words(range, unit));
}

}  // namespace

double quantity_setting(std::string_view name, std::string_view text, std::string_view unit,
                        double atmosphere, const Range& range) {
  const Parsed parsed = parse_quantity(text, unit, atmosphere);
  if (parsed.mistake) {
    const Mistake& m = *parsed.mistake;
    fail({std::string(name), 0, 0}, "", m.found, m.expected, m.try_this);
  }
  refuse_outside(name, in_quotes(text), parsed.si, unit, range);
  return parsed.si;
}

double number_setting(std::string_view name, double value, const Range& range) {
  refuse_outside(name, format_number(value), value, "1", range);
  return value;
}

std::vector<std::string> at_commas(const std::string& text) {
  std::vector<std::string> out;
  std::size_t from = 0;
  while (from <= text.size() && !text.empty()) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    const std::string piece = text.substr(from, to - from);
    const std::size_t first = piece.find_first_not_of(' ');
    out.push_back(first == piece.npos ? "" : piece.substr(first));
    from = to + 1;
  }
  return out;
}

}  // namespace sinew::config
