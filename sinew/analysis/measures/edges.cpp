#include "sinew/analysis/measures/edges.h"

#include <algorithm>
#include <stdexcept>

namespace sinew::analysis {

namespace {

std::string word(const signals::Series& s, std::size_t i) {
  return s.columns[0][i] != 0 ? "opens" : "shuts";
}

// Edges up to `end`.
std::size_t edges(const signals::Series& s, std::int64_t end) {
  const auto it = std::ranges::upper_bound(s.time_ns, end);
  return static_cast<std::size_t>(it - s.time_ns.begin());
}

// Finds the first edge at which two trains part.
std::optional<EdgeDifference> difference(const signals::Series& recorded,
                                         std::size_t recorded_edges,
                                         const signals::Series& replayed,
                                         std::size_t replayed_edges) {
  for (std::size_t i = 0; i < std::max(recorded_edges, replayed_edges); ++i) {
    const bool has_a = i < recorded_edges, has_b = i < replayed_edges;
    const std::int64_t a = has_a ? recorded.time_ns[i] : INT64_MAX;
    const std::int64_t b = has_b ? replayed.time_ns[i] : INT64_MAX;
    if (a == b && recorded.columns[0][i] == replayed.columns[0][i]) continue;
    return EdgeDifference{std::min(a, b), recorded.topic.name,
                          a <= b ? word(recorded, i) : "nothing",
                          b <= a ? word(replayed, i) : "nothing"};
  }
  return std::nullopt;
}

// A log that was cut off is compared as far as all of it was there.
std::int64_t end_of(const signals::Table& table) {
  std::int64_t end = INT64_MAX;
  if (table.complete) return end;
  for (const signals::Series& s : table.series)
    if (s.topic.name.starts_with("/sensor/") && !s.time_ns.empty())
      end = std::min(end, s.time_ns.back());
  return end;
}

}  // namespace

EdgeComparison compare_edges(const signals::Table& recorded, const signals::Table& replayed) {
  const std::int64_t end = end_of(recorded);
  EdgeComparison out;
  for (const signals::Series& now : replayed.series) {
    if (!signals::is_of_valve(now.topic.name)) continue;
    const signals::Series* then = recorded.find(now.topic.name);
    if (!then) throw std::invalid_argument("the log has no " + now.topic.name + " to compare with");
    const std::size_t a = edges(*then, end), b = edges(now, end);
    out.recorded += a;
    out.replayed += b;
    const auto found = difference(*then, a, now, b);
    if (found && (!out.first || found->time_ns < out.first->time_ns)) out.first = found;
  }
  return out;
}

}  // namespace sinew::analysis
