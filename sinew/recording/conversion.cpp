#include "sinew/recording/conversion.h"

#include <fmt/format.h>

#include <vector>

#include "sinew/config/spelling.h"

namespace sinew::recording {

namespace {

// Returns advice about a quantity as advice about its unit: "0 kPa gauge" -> "kPa gauge".
std::string without_number(std::string text) {
  for (std::size_t at = 0; (at = text.find("\"0 ", at)) != text.npos;) text.erase(at + 1, 2);
  return text;
}

}  // namespace

std::variant<FileUnit, std::string> file_unit(const std::string& unit, const std::string& wanted,
                                              double atmosphere) {
  std::vector<config::Spelling> meanings = config::spellings(unit);
  if (meanings.empty()) meanings.push_back({unit});
  std::string advice;
  for (const config::Spelling& meaning : meanings) {
    const auto parse = [&](int number) {
      return config::parse_quantity(fmt::format("{} {}", number, meaning.unit), wanted, atmosphere);
    };
    const config::Parsed zero = parse(0), one = parse(1);
    if (!zero.mistake)
      return FileUnit{{(one.si - zero.si) * meaning.factor, zero.si},
                      meaning.factor == 1 ? meaning.unit : ""};
    if (advice.empty()) advice = without_number(zero.mistake->try_this);
  }
  const bool is_pressure = wanted.starts_with("Pa ") && !unit.empty();
  if (is_pressure && config::is_unit(meanings.front().unit + " gauge"))
    return fmt::format("\"{0} gauge\" or \"{0} abs\"", unit);
  return advice;
}

config::Parsed parse_offset(const std::string& text, const std::string& wanted, double atmosphere) {
  return config::parse_quantity(text, std::string(config::difference_unit(wanted)), atmosphere);
}

}  // namespace sinew::recording
