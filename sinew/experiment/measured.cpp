#include "sinew/experiment/measured.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace sinew::experiment {
namespace {

std::string_view unit_of(robot::Transducer::Of of) {
  using Of = robot::Transducer::Of;
  return of == Of::length ? "m" : of == Of::force ? "N" : of == Of::pressure ? "Pa gauge" : "m/s2";
}

// Returns the counts of each sensor, in order; empty if the table lacks one.
std::vector<const signals::Series*> counts_of(const Experiment& e, const signals::Table& table) {
  std::vector<const signals::Series*> out;
  for (const robot::Transducer& t : e.stand->sensors)
    if (const signals::Series* s = table.find("/sensor/" + t.name + "/count")) out.push_back(s);
  if (out.size() != e.stand->sensors.size()) out.clear();
  return out;
}

// Returns the time at which every sensor has been converted once: a stand's board converts them at
// the end of each of its periods. Earlier counts are 0 and no readings [ns].
std::int64_t first_reading(const Experiment& e) {
  return std::llround(1e9 * e.stand->drive.period) - signals::tick_nanoseconds;
}

// Returns the rows to write: the first at or after each instant, without those before the first
// reading.
std::vector<std::size_t> rows_of(const Experiment& e, const signals::Times& time_ns) {
  const double period = e.stand->measured.period > 0 ? e.stand->measured.period : e.log.period;
  std::vector<std::size_t> out;
  std::size_t row = 0;
  for (std::int64_t k = 0;; ++k) {
    const auto at = std::llround(1e9 * (e.stand->measured.from + static_cast<double>(k) * period));
    while (row < time_ns.size() && time_ns[row] < at) ++row;
    if (row == time_ns.size()) return out;
    if (time_ns[row] >= first_reading(e)) out.push_back(row);
  }
}

}  // namespace

Notes notes(const Experiment& e, const signals::Table& table) {
  Notes out;
  const std::vector<const signals::Series*> counts = counts_of(e, table);
  if (counts.empty() || e.stand->sweep.step > 0) return out;
  const signals::Times& time_ns = counts[0]->time_ns;
  const std::vector<std::size_t> rows = rows_of(e, time_ns);
  for (const std::size_t row : rows) out.time.push_back(static_cast<double>(time_ns[row]) * 1e-9);
  for (std::size_t s = 0; s < counts.size(); ++s) {
    out.values.emplace_back();
    for (const std::size_t row : rows)
      out.values[s].push_back(robot::shown(e.stand->sensors[s], counts[s]->columns[0][row]));
  }
  return out;
}

std::string measured_csv(const Experiment& e, const signals::Table& table) {
  const Notes read = notes(e, table);
  if (read.time.empty()) return {};
  std::string out = "time [s]";
  for (const robot::Transducer& t : e.stand->sensors)
    out += fmt::format(",{} [{}]", t.name, unit_of(t.of));
  out += '\n';
  for (std::size_t row = 0; row < read.time.size(); ++row) {
    out += fmt::format("{:.10g}", read.time[row]);
    for (const std::vector<double>& values : read.values)
      out += fmt::format(",{:.7g}", values[row]);
    out += '\n';
  }
  return out;
}

}  // namespace sinew::experiment
