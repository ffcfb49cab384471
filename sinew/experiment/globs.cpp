#include "sinew/experiment/globs.h"

namespace sinew::experiment {

bool matches(std::string_view pattern, std::string_view text) {
  // Position of the last star in the pattern, and the end of the text that it has matched so far.
  std::size_t p = 0, t = 0, star = pattern.npos, swallowed = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      swallowed = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != pattern.npos) {
      p = star + 1;
      t = ++swallowed;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<std::string> select(const std::vector<std::string>& patterns,
                                const std::vector<std::string_view>& topics,
                                const config::Location& where, const std::string& key) {
  std::vector<bool> chosen(topics.size(), false);
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t i = 0; i < topics.size(); ++i) {
      if (!matches(pattern, topics[i]) && !matches(pattern + "/*", topics[i])) continue;
      chosen[i] = any = true;
    }
    if (any) continue;
    const std::string near = config::closest_in_quotes(pattern, topics);
    config::fail(where, key, config::in_quotes(pattern), "a topic, or * in place of its parts",
                 near.empty() ? "\"/joint/*\"" : near);
  }
  std::vector<std::string> out;
  for (std::size_t i = 0; i < topics.size(); ++i)
    if (chosen[i]) out.emplace_back(topics[i]);
  return out;
}

std::vector<std::string_view> names_of(const signals::Table& table) {
  std::vector<std::string_view> names;
  for (const signals::Series& series : table.series) names.push_back(series.topic.name);
  return names;
}

}  // namespace sinew::experiment
