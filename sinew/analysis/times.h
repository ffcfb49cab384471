// analysis/times.h - samples of a channel that fulfil a condition: their count and time spans.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sinew/analysis/warnings.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// Holds how many samples fulfilled a condition, of how many, and when.
struct Occasions {
  std::size_t count = 0, of = 0;  // samples that fulfilled it, all samples
  std::vector<Span> spans;

  // Adds a sample. Samples less than 0.1 s apart form one span.
  void add(std::int64_t time_ns) {
    constexpr double apart = 0.1;  // least distance of two spans [s]
    const double t = static_cast<double>(time_ns) / 1e9;
    if (spans.empty() || t - spans.back().to >= apart) spans.push_back({t, t});
    spans.back().to = t;
    ++count;
  }
};

// Returns the samples of a topic for which `is` holds; empty if the topic is missing.
inline Occasions times_when(const signals::Table& table, const std::string& topic,
                            const std::function<bool(double)>& is) {
  Occasions out;
  const signals::Series* series = table.find(topic);
  if (!series || series->columns.empty()) return out;
  const signals::Column& values = series->columns.front();
  out.of = values.size();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is(values[i])) out.add(series->time_ns[i]);
  return out;
}

}  // namespace sinew::analysis
