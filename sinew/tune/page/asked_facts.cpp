#include "sinew/tune/page/asked_facts.h"

#include <optional>
#include <sstream>

namespace sinew::tune {
namespace {

// "vary = KEY [unit]: values" without its name; nothing for another line.
std::optional<std::string> value_after(const std::string& line, const std::string& name) {
  const std::string begin = name + " = ";
  if (!line.starts_with(begin)) return std::nullopt;
  return line.substr(begin.size());
}

}  // namespace

std::string fact(const Asked& asked, const std::string& name) {
  std::istringstream lines(asked.text);
  for (std::string line; std::getline(lines, line);)
    if (const auto value = value_after(line, name)) return *value;
  return "";
}

std::size_t count(const Asked& asked, const std::string& name) {
  std::size_t out = 0;
  std::istringstream lines(asked.text);
  for (std::string line; std::getline(lines, line);) out += value_after(line, name) ? 1 : 0;
  return out;
}

}  // namespace sinew::tune
