#include "cli/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/terminal.h"
#include "cli/text_table.h"
#include "sinew/config/quantity.h"
#include "sinew/robot/legs.h"

namespace sinew::cli {

namespace {

bool finite(const signals::Series& s, std::size_t i) {
  return std::ranges::all_of(s.columns, [i](const auto& c) { return std::isfinite(c[i]); });
}

// Until when the simulated state was made of numbers.
std::int64_t last_good_time(const signals::Table& table) {
  std::int64_t end = INT64_MAX;
  for (const signals::Series& s : table.series) {
    if (!s.topic.name.starts_with("/true/")) continue;
    for (std::size_t i = 0; i < s.time_ns.size() && s.time_ns[i] <= end; ++i)
      if (!finite(s, i)) end = s.time_ns[i] - 1;
  }
  return end;
}

std::string record_text(const signals::Series& s, std::size_t i) {
  std::string text =
      fmt::format("{:.4f} s  {}", 1e-9 * static_cast<double>(s.time_ns[i]), s.topic.name);
  for (std::size_t f = 0; f < s.columns.size(); ++f) {
    const std::string& unit = s.topic.fields[f].unit;
    text += fmt::format("  {:.6g}{}", s.columns[f][i], unit == "1" ? "" : " " + unit);
  }
  return text;
}

// Until when the run was one: what is vented after a trip is not what led to it.
std::int64_t end_of_run(const experiment::Outcome& outcome) {
  const control::Trip& trip = outcome.supervised.trip;
  const std::int64_t end = last_good_time(outcome.table);
  if (trip.cause == control::Trip::Cause::none) return end;
  return std::min(end, trip.at * signals::tick_nanoseconds);
}

// "; the last records before:" and one line per topic, until `end` [ns].
std::string last_records(const signals::Table& table, std::int64_t end) {
  std::string text = "; the last records before:";
  for (const signals::Series& s : table.series) {
    const auto after = std::ranges::upper_bound(s.time_ns, end) - s.time_ns.begin();
    if (after > 0) text += "\n  " + record_text(s, static_cast<std::size_t>(after - 1));
  }
  return text;
}

// Prints the main figures of a run of which nothing is reported, so that no paper gives the units.
void print_main_figures(const analysis::Summary& summary, const analysis::Machine& machine) {
  std::vector<std::pair<std::string, std::string_view>> keys = {
      {"sequence_duration_s", "s"},
      {"trolley.distance_m", "mm"},
      {"trolley.mean_speed_m_per_s", "mm/s"},
  };
  for (std::size_t j = 0; j < machine.robot.joints.size(); ++j) {
    const std::string& name = machine.robot.joints[j].name;
    const std::size_t leg = robot::leg_of_joint(machine.robot, static_cast<int>(j));
    const bool one = machine.robot.legs.empty();
    const std::string of = one ? "" : machine.robot.legs[leg].name;
    const std::string at =
        (one ? "joints." : "legs." + of + ".joints.") + robot::name_in_leg(of, name);
    keys.push_back({at + ".excursion_rad", "deg"});
    keys.push_back({at + ".tracking_rms_rad", "deg"});
    keys.push_back({at + ".passiveness", "%"});
  }
  for (const robot::Leg& leg : machine.robot.legs)
    keys.push_back({"legs." + leg.name + ".foot.loaded_share_true", "%"});
  keys.push_back({"air_used_kg", "g"});

  TextTable table({"", "Sinew"});
  for (const auto& [key, unit] : keys)
    if (const double* value = summary.find(key))
      table.add({std::string(analysis::without_unit(key)),
                 analysis::show(*value, key, unit, machine.atmosphere)});
  if (!table.empty()) fmt::print("{}", table.text());
}

// Verdicts, colored on a terminal.
std::string shown(analysis::Verdict::Is is) {
  using enum analysis::Verdict::Is;
  const std::string_view word = to_text(is);
  if (is == agrees) return in_green(word);
  return is == differs || is == agrees_after_all ? in_red(word) : std::string(word);
}

// The class of a statement has a column of its own, or stands before the source where the window
// has no room for one.
TextTable verdict_table(const std::vector<analysis::Verdict>& verdicts, bool class_column) {
  std::vector<std::string> titles = {"", "reported", "Sinew", "accepted", "class", "", "source"};
  if (!class_column) titles = {"", "reported", "Sinew", "accepted", "", "class; source"};
  TextTable table(titles);
  for (const analysis::Verdict& v : verdicts) {
    const std::string statement_class(to_text(v.statement_class));
    std::vector<std::string> row = {std::string(analysis::without_unit(v.key)), v.reported,
                                    v.ours.empty() ? "-" : v.ours, v.accept};
    if (class_column) row.push_back(statement_class);
    row.push_back(shown(v.is));
    row.push_back(class_column || statement_class.empty() ? v.source
                                                          : statement_class + "; " + v.source);
    table.add(std::move(row));
  }
  return table;
}

bool print_reported(const analysis::Summary& summary,
                    const std::vector<analysis::Reported>& reported, double atmosphere) {
  fmt::print("{}", summary.title);
  if (!summary.reproduces.empty()) fmt::print(" ({})", summary.reproduces);
  fmt::print("\n");

  const std::vector<analysis::Verdict> verdicts = compare(summary, reported, atmosphere);
  if (verdicts.empty()) return false;
  const std::size_t width = width_of_output();
  const TextTable table = verdict_table(verdicts, true);
  const bool fits = width == 0 || table.width_before_last() <= width;
  fmt::print("{}", (fits ? table : verdict_table(verdicts, false)).text_within(width));
  return true;
}

// "1 reading was", "2 readings were".
std::string counted(std::int64_t count, std::string_view one, std::string_view more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

// Faults that changed nothing: the run was one without them. Of one that lasts less than the time
// between two readings nothing is said.
void add_idle_faults(const experiment::Experiment& e, const experiment::Outcome& outcome,
                     std::vector<std::string>& out) {
  for (std::size_t i = 0; i < e.faults.size(); ++i) {
    const experiment::Fault& fault = e.faults[i];
    if (fault.at > outcome.duration)
      out.push_back(
          fmt::format("fault[{}] never acted: it begins at {:.6g} s, the run lasted {:.4f} s", i,
                      fault.at, outcome.duration));
    else if (fault.amount == 0)
      out.push_back(fmt::format("fault[{}] never acted: its amount is 0", i));
  }
}

// Sensors whose readings were rejected or stood still, and whose counters the run did not record.
void add_sensors(const experiment::Experiment& e, const experiment::Outcome& outcome,
                 std::vector<std::string>& out) {
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s) {
    const std::string& name = e.robot.sensors[s].name;
    if (outcome.table.find("/sensor/" + name + "/rejected")) continue;
    const control::SensorSeen& seen = outcome.supervised.sensor[s];
    if (seen.rejected > 0)
      out.push_back(fmt::format("{}: {} not believed; the last good ones stood", name,
                                counted(seen.rejected, "reading was", "readings were")));
    if (seen.frozen > 0)
      out.push_back(
          fmt::format("{}: the same counts for {} scans in a row while its muscles were driven; {} "
                      "in all",
                      name, seen.longest, seen.frozen));
  }
}

}  // namespace

void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine) {
  if (!print_reported(summary, machine.reported, machine.atmosphere))
    print_main_figures(summary, machine);
}

void print_verdicts(const analysis::Summary& summary, const analysis::StandFile& stand) {
  if (print_reported(summary, stand.reported, stand.atmosphere)) return;
  TextTable table({"", "Sinew"});
  for (const analysis::Entry& e : summary.entries()) {
    const std::string unit = analysis::unit_of_key(e.key);
    table.add({std::string(analysis::without_unit(e.key)),
               analysis::show(e.value, e.key, unit == "m" ? "mm" : unit, stand.atmosphere)});
  }
  if (!table.empty()) fmt::print("{}", table.text());
}

std::vector<std::string> warnings_beside_the_log(const experiment::Experiment& e,
                                                 const experiment::Outcome& outcome) {
  std::vector<std::string> out;
  const control::Seen& seen = outcome.seen;
  const control::Supervised& supervised = outcome.supervised;
  const bool logged = outcome.table.find("/low_level/gaps") != nullptr;
  const auto tell = [&](std::int64_t count, std::string_view one, std::string_view more,
                        std::string_view what) {
    if (count > 0) out.push_back(fmt::format("{} {}", counted(count, one, more), what));
  };
  tell(seen.late, "reading", "readings", "came late");
  tell(seen.invalid - supervised.rejected, "reading was", "readings were", "invalid");
  tell(logged ? 0 : supervised.rejected_commands, "command was", "commands were",
       "rejected: not numbers, out of range or too fast");
  tell(logged ? 0 : supervised.gaps, "tick", "ticks",
       fmt::format("came later than announced, by {} at worst", supervised.worst_gap));
  add_sensors(e, outcome, out);
  add_idle_faults(e, outcome, out);
  tell(seen.missed, "tick", "ticks",
       "came late by more than a tick: this machine cannot keep the pace that finely");
  if (!outcome.table.complete)
    out.emplace_back("more valve edges than there was room for; the table lacks the last ones");
  return out;
}

std::string black_box(const experiment::Experiment& e, const experiment::Outcome& outcome) {
  std::string text = fmt::format("{}: the run was ended: {}", e.path, cause_of(e, outcome));
  if (outcome.supervised.trip.cause != control::Trip::Cause::none)
    text += "; all muscles were vented";
  text += last_records(outcome.table, end_of_run(outcome));
  return text;
}

}  // namespace sinew::cli
