#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sinew/config/quantity.h"
#include "sinew/report/compare/comparison.h"

namespace sinew::report {
namespace {

// One channel of a run, and what it differs by from the first one's.
struct Residual {
  std::string heading;  // "B /joint/hip/angle [rad]"
  analysis::Meetings met;
  std::size_t at = 0;  // the next one to be written
};

// The channel's samples, logged or derived.
analysis::Recording recording_of(const ComparedRun& run, const Channel& channel) {
  for (const signals::Table* table : {&run.logged, &run.derived}) {
    const signals::Series* s = table->find(channel.topic);
    if (s) return {&s->time_ns, table->column(channel.topic, channel.field)};
  }
  return {};
}

std::vector<Residual> residuals_of(const Comparison& c) {
  std::vector<Residual> out;
  for (std::size_t i = 1; i < c.runs.size(); ++i)
    for (const ChannelRow& row : c.channels) {
      if (!row.differences[i] || analysis::is_edges(row.channel.topic)) continue;
      const analysis::Recording a = recording_of(c.runs.front(), row.channel);
      const analysis::Recording b = recording_of(c.runs[i], row.channel);
      if (!a.values || !b.values) continue;
      analysis::Meetings met = analysis::meet(a, b);
      if (met.time_ns.empty()) continue;
      const std::string field = row.channel.field == "value" ? "" : "." + row.channel.field;
      out.push_back({fmt::format("{} {}{} [{}]", static_cast<char>('A' + i), row.channel.topic,
                                 field, config::difference_unit(row.unit)),
                     std::move(met)});
    }
  return out;
}

}  // namespace

std::string residuals_csv(const Comparison& comparison) {
  std::vector<Residual> all = residuals_of(comparison);
  std::string out = "time [s]";
  for (const Residual& r : all) out += "," + r.heading;
  out += "\n";
  for (;;) {
    // The earliest time that is not written yet.
    std::optional<std::int64_t> now;
    for (const Residual& r : all)
      if (r.at < r.met.time_ns.size())
        now = std::min(now.value_or(r.met.time_ns[r.at]), r.met.time_ns[r.at]);
    if (!now) return out;
    out += config::format_number(1e-9 * static_cast<double>(*now));
    for (Residual& r : all) {
      out += ",";
      if (r.at >= r.met.time_ns.size() || r.met.time_ns[r.at] != *now) continue;
      const double d = r.met.difference[r.at++];
      if (std::isfinite(d)) out += config::format_number(d);
    }
    out += "\n";
  }
}

}  // namespace sinew::report
