#include "cli/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/text_table.h"
#include "sinew/config/quantity.h"

namespace sinew::cli {

namespace {

std::string_view word(signals::Status status) {
  switch (status) {
    case signals::Status::ok:
      return "ok";
    case signals::Status::late:
      return "a late reading";
    case signals::Status::invalid:
      return "an invalid reading";
    case signals::Status::ended:
      return "the body ended";
    case signals::Status::fault:
      return "a fault";
  }
  return "";
}

// Readings that the converter cut off.
void warn_of_clipping(const experiment::Experiment& e, const signals::Table& table,
                      const Messages& messages) {
  const double top = e.robot.converter.top();
  for (const robot::Sensor& sensor : e.robot.sensors) {
    const auto* counts = table.column("/sensor/" + sensor.name + "/count");
    if (!counts || sensor.kind == robot::Sensor::Kind::fixed) continue;
    // A slack muscle reads 0 and is right.
    const bool angle = sensor.kind == robot::Sensor::Kind::angle;
    const auto clipped =
        std::ranges::count_if(*counts, [&](double c) { return c >= top || (angle && c <= 0); });
    if (clipped > 0)
      messages.warning(fmt::format("{}: {} of {} samples at the converter's end", sensor.name,
                                   clipped, counts->size()));
  }
}

}  // namespace

void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine) {
  fmt::print("{}", summary.title);
  if (!summary.reproduces.empty()) fmt::print(" ({})", summary.reproduces);
  fmt::print("\n");

  TextTable table({"", "reported", "Sinew", "accepted", "", "source"});
  for (const analysis::Verdict& v : compare(summary, machine.reported, machine.atmosphere))
    table.add({v.key, v.reported, v.ours.empty() ? "-" : v.ours, v.accept,
               std::string(to_text(v.is)), v.source});
  if (!table.empty()) fmt::print("{}", table.text());
}

void warn_of(const experiment::Experiment& e, const experiment::Outcome& outcome,
             const Messages& messages) {
  const control::Seen& seen = outcome.seen;
  const auto tell = [&](std::int64_t count, std::string_view what) {
    if (count > 0) messages.warning(fmt::format("{} {}", count, what));
  };
  tell(seen.late, "readings came late");
  tell(seen.invalid, "readings were invalid");
  tell(seen.missed, "ticks were missed: this machine did not keep the pace");
  tell(outcome.unreachable_periods,
       "periods with a foot out of reach: the nearest point was aimed at");
  if (!outcome.table.complete)
    messages.warning("more valve edges than there was room for; the table lacks the last ones");
  warn_of_clipping(e, outcome.table, messages);
}

std::string black_box(const experiment::Experiment& e, const experiment::Outcome& outcome) {
  const control::Seen& seen = outcome.seen;
  std::string text = fmt::format("{}: the run was ended by {}", e.path, word(outcome.status));
  if (seen.fault != signals::Status::ok && seen.fault_channel.index < e.robot.sensors.size())
    text += fmt::format(" of sensor {} ({})", e.robot.sensors[seen.fault_channel.index].name,
                        word(seen.fault));
  text += "; try a smaller plant_steps.body, or a look at the last records:";
  for (const signals::Series& s : outcome.table.series) {
    if (s.time_ns.empty()) continue;
    text +=
        fmt::format("\n  {:.4f} s  {}", 1e-9 * static_cast<double>(s.time_ns.back()), s.topic.name);
    for (std::size_t f = 0; f < s.columns.size(); ++f)
      text += fmt::format("  {:.6g} {}", s.columns[f].back(), s.topic.fields[f].unit);
  }
  return text;
}

}  // namespace sinew::cli
