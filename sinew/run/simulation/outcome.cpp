#include "sinew/run/simulation/run.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "sinew/control/setup/supervision.h"
#include "sinew/experiment/faults.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/run/setup/installation.h"
#include "sinew/units/quantity.h"

namespace sinew::run {

namespace {

std::string_view word(signals::Status status) {
  using signals::Status;
  if (status == Status::late) return "a late reading";
  if (status == Status::invalid) return "an invalid reading";
  return status == Status::ended ? "the body's end" : "a fault";
}

std::string inches(double metres) { return units::format_quantity(metres, "m", "in"); }

// Returns the length at which the braid's chamber has no volume, if that is the cause.
std::string describe_length(const air::Failure& failure, const actuator::Actuator& actuator) {
  const double thread = actuator.braid.thread_length, caps = actuator.caps.length;
  if (failure.length <= caps)
    return fmt::format(
        "it was {} long, where a muscle has no volume; try a smaller moment arm or "
        "a longer mount_length",
        inches(failure.length));
  if (failure.length - caps >= thread)
    return fmt::format(
        "it was {} long, where its thread of {} is straight and holds no air; try "
        "an external_volume above 0, or a smaller moment arm",
        inches(failure.length), inches(thread));
  return {};
}

}  // namespace

std::string cause_of(const experiment::Experiment& e, const Outcome& outcome) {
  const ControllerTotals& controller = outcome.controller;
  if (e.stand && outcome.failure) {
    actuator::Actuator its;
    for (const actuator::Actuator& a : e.actuators)
      if (a.name == e.stand->element.actuator) its = a;
    return to_text(outcome.failure, "element " + e.stand->element.name, its, "step");
  }
  if (outcome.failure) {
    const auto m = static_cast<std::size_t>(outcome.failure.muscle);
    if (m >= e.robot.muscles.size()) return to_text(outcome.failure, "", {}, "plant_steps.body");
    const robot::Muscle& muscle = e.robot.muscles[m];
    return to_text(outcome.failure, "muscle " + muscle.name,
                   robot::actuator_of(muscle, e.actuators), "plant_steps.body");
  }
  const robot::Robot parts = named_parts(e);
  const std::string tripped =
      control::to_text(outcome.supervised.trip, parts, outcome.supervised.board);
  if (!tripped.empty()) return tripped;
  if (!outcome.line.empty()) return outcome.line + fmt::format(" at {:.4f} s", outcome.duration);
  const bool by_sensor = controller.fault != signals::Status::ok;
  std::string text(word(by_sensor ? controller.fault : outcome.status));
  if (by_sensor && controller.fault_channel.index < parts.sensors.size())
    text += " of sensor " + parts.sensors[controller.fault_channel.index].name;
  return text + fmt::format(" at {:.4f} s", outcome.duration);
}

std::string to_text(const air::Failure& failure, const std::string& who,
                    const actuator::Actuator& actuator, const std::string& step) {
  using Of = air::Failure::Of;
  std::string what = "the motion";
  if (failure.of == Of::air) what = "the air of " + who;
  if (failure.of == Of::cylinder) what = "the air of the cylinder";
  what += fmt::format(" was not finite at {:.4f} s: ", failure.time);
  const std::string remedy = "less stiffness or damping, or a smaller " + step;
  const double thread = actuator.braid.thread_length;
  const bool near = failure.length > -thread && failure.length < 2 * thread;
  const std::string length =
      failure.of == Of::air && near ? describe_length(failure, actuator) : std::string();
  if (length.empty()) return what + "the motion ran away; try " + remedy;
  return failure.time > 0 ? what + length + "; or, where the motion ran away, " + remedy
                          : what + length;
}

namespace {

bool finite(const signals::Series& s, std::size_t i) {
  return std::ranges::all_of(s.columns, [i](const auto& c) { return std::isfinite(c[i]); });
}

// Returns the last time at which all simulated values were finite [ns].
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

// Returns the end of the part of a run that led to its end [ns]; the vent after a trip is excluded.
std::int64_t end_of_run(const run::Outcome& outcome) {
  const control::Trip& trip = outcome.supervised.trip;
  const std::int64_t end = last_good_time(outcome.table);
  if (trip.cause == control::Trip::Cause::none) return end;
  return std::min(end, trip.at * signals::tick_nanoseconds);
}

// Returns "; the last records before:" and one line per topic, until `end` [ns].
std::string last_records(const signals::Table& table, std::int64_t end) {
  std::string text = "; the last records before:";
  for (const signals::Series& s : table.series) {
    const auto after = std::ranges::upper_bound(s.time_ns, end) - s.time_ns.begin();
    if (after > 0) text += "\n  " + record_text(s, static_cast<std::size_t>(after - 1));
  }
  return text;
}

// Returns "1 reading was", "2 readings were".
std::string counted(std::int64_t count, std::string_view one, std::string_view more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

// Adds the faults that had no effect.
void add_idle_faults(const experiment::Experiment& e, const run::Outcome& outcome,
                     std::vector<std::string>& out) {
  const auto end =
      static_cast<signals::Tick>(std::llround(outcome.duration / signals::tick_seconds));
  for (std::size_t i = 0; i < e.faults.size(); ++i)
    if (const std::string why = why_idle(e, e.faults[i], end); !why.empty())
      out.push_back(fmt::format("fault[{}] never acted: {}", i, why));
}

// Adds the changes that had no effect, as the plan or the run ended before their time.
void add_idle_changes(const experiment::Experiment& e, const run::Outcome& outcome,
                      std::vector<std::string>& out) {
  for (std::size_t i = 0; i < e.plan.changes.size(); ++i)
    if (const std::string why = why_idle(e, e.plan.changes[i], outcome.duration); !why.empty())
      out.push_back(fmt::format("change[{}] never acted: {}", i, why));
}

// Adds sensors with rejected or repeated readings whose counters the run did not record. Repeated
// readings share a line, since they are common in a machine that does not move.
void add_sensors(const experiment::Experiment& e, const run::Outcome& outcome,
                 std::vector<std::string>& out) {
  std::string first;
  std::size_t others = 0;
  std::uint32_t longest = 0;
  for (std::size_t s = 0; s < e.robot.sensors.size(); ++s) {
    const std::string& name = e.robot.sensors[s].name;
    if (outcome.table.find("/sensor/" + name + "/rejected")) continue;
    const control::SensorStatistics& sensor = outcome.supervised.sensor[s];
    if (sensor.rejected > 0)
      out.push_back(fmt::format("{}: {} not accepted; the last good ones were used", name,
                                counted(sensor.rejected, "reading was", "readings were")));
    if (sensor.frozen == 0) continue;
    first.empty() ? void(first = name) : void(++others);
    longest = std::max(longest, sensor.longest);
  }
  if (first.empty()) return;
  const std::string who =
      others == 0
          ? first
          : fmt::format("{} and {}", first,
                        counted(static_cast<std::int64_t>(others), "more sensor", "more sensors"));
  out.push_back(
      fmt::format("{}: the same counts for up to {} scans in a row while the muscles were driven: "
                  "the joints did "
                  "not move, or the sensor gives no readings",
                  who, longest));
}

}  // namespace

std::vector<std::string> warnings_outside_log(const experiment::Experiment& e,
                                              const run::Outcome& outcome) {
  std::vector<std::string> out;
  const run::ControllerTotals& controller = outcome.controller;
  const run::SupervisedTotals& supervised = outcome.supervised;
  const bool logged = outcome.table.find("/low_level/gaps") != nullptr;
  const auto add = [&](std::int64_t count, std::string_view one, std::string_view more,
                       std::string_view what) {
    if (count > 0) out.push_back(fmt::format("{} {}", counted(count, one, more), what));
  };
  add(controller.late, "reading", "readings", "came late");
  add(controller.invalid - supervised.rejected, "reading was", "readings were", "invalid");
  add(logged ? 0 : supervised.rejected_commands, "command was", "commands were",
      "rejected: not numbers, out of range or too fast");
  add(logged ? 0 : supervised.gaps, "tick", "ticks",
      fmt::format("came later than announced, by {} at worst", supervised.worst_gap));
  add(outcome.lost, "period", "periods",
      "of the board's telemetry did not come: they are gaps in the log");
  add(outcome.foreign, "message", "messages",
      "named a valve or a time that the board does not have, and were left out: is it another "
      "robot's board, or a line that spoils what it carries?");
  add_sensors(e, outcome, out);
  add_idle_faults(e, outcome, out);
  add_idle_changes(e, outcome, out);
  add(controller.missed, "tick", "ticks",
      "came late by more than a tick: this machine cannot keep the pace that finely");
  if (!outcome.table.complete)
    out.push_back(outcome.no_room.empty()
                      ? "more valve edges than there was room for; the table lacks the last ones"
                      : outcome.no_room + "; the figures are those up to there");
  return out;
}

std::string last_records(const experiment::Experiment& e, const run::Outcome& outcome) {
  std::string text = fmt::format("{}: the run was ended: {}", e.path, cause_of(e, outcome));
  if (outcome.supervised.trip.cause != control::Trip::Cause::none)
    text += "; all muscles were vented";
  text += last_records(outcome.table, end_of_run(outcome));
  return text;
}

}  // namespace sinew::run
