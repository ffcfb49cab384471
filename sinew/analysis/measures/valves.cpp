#include "sinew/analysis/measures/valves.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "sinew/gas/delay.h"

namespace sinew::analysis {

namespace {

std::string word(const signals::Series& s, std::size_t i) {
  return s.columns[0][i] != 0 ? "opens" : "shuts";
}

// Counts the edges up to `end`.
std::size_t edges(const signals::Series& s, std::int64_t end) {
  const auto it = std::ranges::upper_bound(s.time_ns, end);
  return static_cast<std::size_t>(it - s.time_ns.begin());
}

// Finds the first edge at which two trains differ.
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

constexpr std::int64_t near_ns = 5'000'000;

// An edge that has no equal on the other side.
struct UnmatchedEdge {
  std::int64_t time_ns;
  bool opens;
};

// Appends the edges of both trains that have no equal in the other one.
void leave_out_equal(const signals::Series& a, std::size_t of_a, const signals::Series& b,
                     std::size_t of_b, std::vector<UnmatchedEdge>& unmatched_a,
                     std::vector<UnmatchedEdge>& unmatched_b) {
  std::size_t i = 0, k = 0;
  while (i < of_a || k < of_b) {
    const std::int64_t ta = i < of_a ? a.time_ns[i] : INT64_MAX;
    const std::int64_t tb = k < of_b ? b.time_ns[k] : INT64_MAX;
    const bool equal = ta == tb && a.columns[0][i] == b.columns[0][k];
    if (!equal && ta <= tb) unmatched_a.push_back({ta, a.columns[0][i] != 0});
    if (!equal && tb <= ta) unmatched_b.push_back({tb, b.columns[0][k] != 0});
    if (ta <= tb) ++i;
    if (tb <= ta) ++k;
  }
}

ValveEdges compared(const signals::Series& recorded, std::size_t of_recorded,
                    const signals::Series& replayed, std::size_t of_replayed) {
  ValveEdges out{recorded.topic.name, of_recorded, of_replayed};
  std::vector<UnmatchedEdge> then, now;
  leave_out_equal(recorded, of_recorded, replayed, of_replayed, then, now);
  std::vector<bool> taken(now.size(), false);
  std::size_t from = 0;
  double sum = 0;
  for (const UnmatchedEdge& edge : then) {
    while (from < now.size() && now[from].time_ns < edge.time_ns - near_ns) ++from;
    std::size_t best = now.size();
    for (std::size_t k = from; k < now.size() && now[k].time_ns <= edge.time_ns + near_ns; ++k) {
      if (taken[k] || now[k].opens != edge.opens) continue;
      const auto apart = [&](std::size_t at) { return std::abs(now[at].time_ns - edge.time_ns); };
      if (best == now.size() || apart(k) < apart(best)) best = k;
    }
    if (best == now.size()) {
      ++out.only_recorded;
      continue;
    }
    taken[best] = true;
    ++out.moved;
    const double move = 1e-9 * static_cast<double>(now[best].time_ns - edge.time_ns);
    sum += move;
    if (std::abs(move) > std::abs(out.largest_move)) out.largest_move = move;
  }
  out.only_replayed = now.size() - out.moved;
  if (out.moved > 0) out.mean_move = sum / static_cast<double>(out.moved);
  return out;
}

// Returns the time up to which a log is compared: for one that was cut off, the earliest end of its
// sensors' channels.
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
  std::string missing;
  for (const signals::Series& now : replayed.series)
    if (signals::is_of_valve(now.topic.name) && !recorded.find(now.topic.name))
      missing += (missing.empty() ? "" : ", ") + now.topic.name;
  if (!missing.empty())
    throw std::invalid_argument("the log has no " + missing + " to compare with");

  EdgeComparison out;
  for (const signals::Series& now : replayed.series) {
    if (!signals::is_of_valve(now.topic.name)) continue;
    const signals::Series& then = *recorded.find(now.topic.name);
    const std::size_t a = edges(then, end), b = edges(now, end);
    out.recorded += a;
    out.replayed += b;
    out.valves.push_back(compared(then, a, now, b));
    const auto found = difference(then, a, now, b);
    if (found && (!out.first || found->time_ns < out.first->time_ns)) out.first = found;
  }
  return out;
}

constexpr double never = std::numeric_limits<double>::infinity();

Edges edges_of(const signals::Times& time_ns, const signals::Column& open) {
  Edges out(time_ns.file());
  bool before = false;
  for (std::size_t i = 0; i < time_ns.size() && i < open.size(); ++i) {
    const bool now = open[i] > 0.5;
    if (now != std::exchange(before, now))
      out.push_back({static_cast<double>(time_ns[i]) / 1e9, now});
  }
  return out;
}

Edges delivered(const Edges& electrical, double opening_delay, double closing_delay) {
  Edges out(electrical.file());
  for (const Edge& e : electrical) {
    const bool too_early = !out.empty() && out.back().time >= e.time - gas::Shutter::simultaneous;
    if (too_early) {
      out.pop_back();
    } else {
      out.push_back({e.time + (e.open ? opening_delay : closing_delay), e.open});
    }
  }
  return out;
}

namespace {

// Returns the total time of pulses within [from, to), counting the first `longest` of each pulse
// [s].
double time_in_pulses(const Edges& edges, double from, double to, double longest) {
  double sum = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!edges[i].open) continue;
    const double shut = i + 1 < edges.size() ? edges[i + 1].time : never;
    const double end = std::min({shut, edges[i].time + longest, to});
    sum += std::max(0.0, end - std::max(edges[i].time, from));
  }
  return sum;
}

}  // namespace

double open_time(const Edges& edges, double from, double to) {
  return time_in_pulses(edges, from, to, never);
}

double coil_energy(const Edges& electrical, const gas::Coil& coil, double from, double to) {
  const double boosted = time_in_pulses(electrical, from, to, coil.boost_time);
  return coil.power * open_time(electrical, from, to) + (coil.boost_power - coil.power) * boosted;
}

int openings(const Edges& edges, double from, double to) {
  return static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](const Edge& e) {
    return e.open && e.time >= from && e.time < to;
  }));
}

}  // namespace sinew::analysis
