#include "sinew/recording/stated.h"

#include <algorithm>
#include <filesystem>

#include "sinew/config/diagnostics.h"
#include "sinew/recording/number.h"

namespace sinew::recording {

bool Stated::is_for(const std::string& file) const {
  return std::filesystem::path(file).filename().string().find(part) != std::string::npos;
}

Stated stated_in(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    config::fail({"values", 0, 0}, "", config::in_quotes(text),
                 "NAME=VALUE or PART:NAME=VALUE, such as \"pressure=2 bar gauge\"");
  const std::string name = text.substr(0, equals);
  const std::size_t colon = name.find(':');
  if (colon == name.npos) return {"", name, text.substr(equals + 1)};
  return {name.substr(0, colon), name.substr(colon + 1), text.substr(equals + 1)};
}

void add_stated(const std::vector<std::string>& values, Recorded& file) {
  for (const std::string& text : values) {
    const Stated stated = stated_in(text);
    if (!stated.is_for(file.file) || file.clocks.empty()) continue;
    const std::size_t blank = std::min(stated.value.find(' '), stated.value.size());
    const auto number = number_in(stated.value.substr(0, blank));
    if (!number)
      config::fail({"values", 0, 0}, "", config::in_quotes(text),
                   "a number with its unit, such as \"/muscle/flexor/pressure=2 bar gauge\"");
    const std::size_t rows = file.clocks.front().time_ns.size();
    const Heading heading{.name = stated.name,
                          .unit = blank < stated.value.size() ? stated.value.substr(blank + 1) : "",
                          .column = 0};
    file.columns.push_back(
        {{heading}, 0, signals::Column(std::vector<double>(rows, *number)), true});
  }
}

void check_stated(const std::vector<std::string>& values, const std::vector<std::string>& files) {
  for (const std::string& text : values) {
    const Stated stated = stated_in(text);
    if (!std::ranges::any_of(files, [&](const std::string& f) { return stated.is_for(f); }))
      config::fail({"values", 0, 0}, "", config::in_quotes(text),
                   "a part of the name of one of the files before the colon");
  }
}

}  // namespace sinew::recording
