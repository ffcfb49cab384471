#include "sinew/log/steady.h"

#include <bit>

namespace sinew::log {

void Steadiness::add(std::int64_t time_ns, std::string_view message) {
  if (count_ == 0)
    first_ = message;
  else if (steady_ && message != first_)
    steady_ = false;
  ++count_;
  constexpr std::uint64_t odd = 0x9E3779B97F4A7C15;  // distributes close times over all bits
  hash_ = (std::rotl(hash_, 5) ^ static_cast<std::uint64_t>(time_ns)) * odd;
}

SteadyTopics steady_topics(const std::vector<std::string>& names,
                           const std::vector<Steadiness>& topics) {
  SteadyTopics out;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (!topics[i].is_steady()) continue;
    // Prefers a topic that changes; if all of them are steady, the first is written in full.
    for (std::size_t k = 0; k < topics.size(); ++k) {
      const bool whole = !topics[k].is_steady() || k < i;
      if (k == i || !whole || !topics[i].has_times_of(topics[k])) continue;
      if (out.contains(static_cast<std::uint16_t>(k + 1))) continue;
      out.emplace(static_cast<std::uint16_t>(i + 1), names[k]);
      break;
    }
  }
  return out;
}

void repeat(signals::Series& series, const signals::Series& times) {
  if (series.time_ns.size() != 1 || times.time_ns.size() < 2) return;
  for (std::size_t i = 0; i < times.time_ns.size(); ++i) {
    const std::int64_t at = times.time_ns[i];
    if (i == 0) {
      if (at != series.time_ns[0]) return;  // belongs to another log
      continue;
    }
    series.time_ns.push_back(at);
    for (auto& column : series.columns) column.push_back(column[0]);
  }
}

}  // namespace sinew::log
