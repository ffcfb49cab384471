#include "sinew/tune/page/asked_facts.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "sinew/config/diagnostics.h"
#include "sinew/run/setup/buildable.h"

namespace sinew::tune {
namespace {

constexpr std::size_t most_sets = 40;  // more differences than that: another machine

// "vary = KEY [unit]: values" without its name; nothing for another line.
std::optional<std::string> value_after(const std::string& line, const std::string& name) {
  const std::string begin = name + " = ";
  if (!line.starts_with(begin)) return std::nullopt;
  return line.substr(begin.size());
}

using Values = std::map<std::string, std::string>;

// Lines "key = value" below "[table]" as table.key and what stands behind it. `ends`: names of
// lines behind the first block of values. Empty where a value is a table of a list.
Values values_of(std::istream& lines, const std::set<std::string>& ends) {
  Values out;
  std::string table;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t is = line.find(" = ");
    if (line.starts_with('[') && line.ends_with(']')) {
      table = line.substr(1, line.size() - 2) + ".";
    } else if (is != line.npos) {
      if (ends.contains(line.substr(0, is))) break;
      if (table.starts_with('[')) continue;
      out[table + line.substr(0, is)] = line.substr(is + 3);
    }
  }
  return out;
}

Values values_asked(const Asked& asked) {
  std::set<std::string> ends{"case"};
  for (const Column& column : asked.columns)
    if (!column.number) ends.insert(column.heading);  // the values of words follow the first block
  std::istringstream lines(asked.text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("allow_unreachable = ")) break;
  return values_of(lines, ends);
}

Values values_now(const Asked& asked) try {
  experiment::Experiment e = run::buildable(asked.experiment);
  e.origins.clear();
  e.title.clear();
  e.reproduces.clear();
  std::istringstream lines(experiment::resolved(e, fact(asked, "sinew")));
  return values_of(lines, {});
} catch (const config::Error&) {
  return {};
}

std::string unquoted(const std::string& value) {
  if (value.size() < 2 || value.front() != '"' || value.find('\\') != value.npos) return value;
  return value.substr(1, value.size() - 2);
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

std::vector<std::string> sets_of(const Asked& asked) {
  const Values then = values_asked(asked), now = values_now(asked);
  std::vector<std::string> out;
  if (now.empty()) return out;
  for (const auto& [key, value] : then) {
    const auto found = now.find(key);
    if (found == now.end() || found->second != value) out.push_back(key + "=" + unquoted(value));
  }
  return out.size() > most_sets ? std::vector<std::string>{} : out;
}

}  // namespace sinew::tune
