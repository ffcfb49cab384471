#include "sinew/analysis/measures/valves.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace sinew::analysis {

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
  // Edge and instant count as simultaneous within this  [s].
  constexpr double simultaneous = 1e-9;
  Edges out(electrical.file());
  for (const Edge& e : electrical) {
    const bool too_early = !out.empty() && out.back().time >= e.time - simultaneous;
    if (too_early) {
      out.pop_back();
    } else {
      out.push_back({e.time + (e.open ? opening_delay : closing_delay), e.open});
    }
  }
  return out;
}

namespace {

// How long each pulse, at most `longest` of it, lies within [from, to), summed up  [s].
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
