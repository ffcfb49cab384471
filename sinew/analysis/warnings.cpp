#include "sinew/analysis/warnings.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/analysis/summary.h"
#include "sinew/analysis/times.h"
#include "sinew/robot/legs.h"

namespace sinew::analysis {
namespace {

constexpr double whole_period = 0.9999;  // a duty of 100 % as a double [-]

// "<before> 3 of 100 <after>", where it ever was.
void add(std::vector<Warning>& out, Occasions times, std::string_view before,
         std::string_view after) {
  if (times.count == 0) return;
  out.push_back({fmt::format("{} {} of {} {}", before, times.count, times.of, after),
                 std::move(times.spans)});
}

void append(std::vector<Warning>& all, std::vector<Warning> more) {
  std::ranges::move(more, std::back_inserter(all));
}

}  // namespace

std::vector<Warning> clipped_sensors(const signals::Table& table, const robot::Robot& robot) {
  std::vector<Warning> out;
  const double top = robot.converter.top();
  for (const robot::Sensor& sensor : robot.sensors) {
    if (sensor.kind == robot::Sensor::Kind::fixed) continue;
    const bool angle = sensor.kind == robot::Sensor::Kind::angle;
    add(out,
        times_when(table, "/sensor/" + sensor.name + "/count",
                   [&](double count) { return count >= top || (angle && count <= 0); }),
        sensor.name + ":", "samples at the converter's end");
  }
  return out;
}

std::vector<Warning> clipped_transducers(const signals::Table& table) {
  constexpr double top = 4095;
  std::vector<Warning> out;
  for (const signals::Series& s : table.series) {
    const std::string& topic = s.topic.name;
    if (!topic.starts_with("/sensor/") || !topic.ends_with("/count") || s.columns.empty()) continue;
    const std::string sensor = topic.substr(0, topic.rfind('/'));
    const std::string name = sensor.substr(sensor.rfind('/') + 1);
    const signals::Series* value = table.find(sensor + "/value");
    const bool rests = value && value->topic.fields.front().unit == "Pa";
    bool begun = std::ranges::none_of(s.columns.front(), [](double c) { return c > 0; });
    add(out,
        times_when(table, topic,
                   [&](double count) {
                     begun = begun || count > 0;
                     return count >= top || (begun && !rests && count <= 0);
                   }),
        name + ":", "samples at the converter's end");
  }
  return out;
}

std::vector<Warning> lifted_rollers(const signals::Table& table) {
  std::vector<Warning> out;
  for (const std::string roller : {"front", "rear"})
    add(out, times_when(table, "/true/roller/" + roller + "/load", [](double n) { return n < 0; }),
        "the " + roller + " roller lifts off the track in", "samples");
  return out;
}

std::vector<Warning> saturated_duties(const signals::Table& table, const robot::Robot& robot) {
  std::vector<Warning> out;
  for (const robot::Muscle& muscle : robot.muscles)
    for (const std::string which : {"inlet", "exhaust"}) {
      Occasions times = times_when(
          table, robot::logged_topic(robot, "/muscle/" + muscle.name + "/" + which + "_duty"),
          [](double duty) { return duty >= whole_period; });
      if (10 * times.count <= times.of) continue;
      add(out, std::move(times), muscle.name + ": the " + which + " stays open all the time in",
          "periods: its duty is saturated");
    }
  return out;
}

std::vector<Warning> unreachable_targets(const signals::Table& table, const robot::Robot& robot) {
  std::vector<Warning> out;
  for (const robot::LegParts& leg : robot::legs_of(robot))
    add(out,
        times_when(table, robot::topic_of_leg(leg.name, "/plan/unreachable"),
                   [](double is) { return is > 0; }),
        (leg.name.empty() ? "the foot" : leg.name + ": the foot") + " is out of reach in",
        "samples: the nearest point was aimed at");
  return out;
}

namespace {

// "<before>3 <things>" or "<before>1 <thing>", then "<after>", of a topic that counts, at the times
// at which it grows.
std::vector<Warning> counted(const signals::Table& table, const std::string& topic,
                             const std::string& before, std::string_view thing,
                             std::string_view things, std::string_view after) {
  double most = 0;
  Occasions times = times_when(table, topic, [&](double so_far) {
    const bool more = so_far > most;
    most = std::max(most, so_far);
    return more;
  });
  if (times.count == 0) return {};
  const std::string_view what = most == 1 ? thing : things;
  return {{fmt::format("{}{:.0f} {}{}", before, most, what, after), std::move(times.spans)}};
}

}  // namespace

std::vector<Warning> overruns(const signals::Table& table) {
  return counted(table, "/low_level/overruns", "", "law", "laws",
                 " took longer than a hundredth of the period, low_level.interrupt_time: the "
                 "thesis's computer locked up so (5.2)");
}

// Sensors that repeat themselves share a line: a machine that does not move has many.
std::vector<Warning> disbelieved_sensors(const signals::Table& table, const robot::Robot& robot) {
  std::vector<Warning> out;
  Warning frozen;
  std::size_t others = 0;
  for (const robot::Sensor& s : robot.sensors) {
    append(out, counted(table, "/sensor/" + s.name + "/rejected", s.name + ": ", "reading was",
                        "readings were", " not believed; the last good ones stood"));
    auto one = counted(table, "/sensor/" + s.name + "/frozen", s.name + ": ", "reading", "readings",
                       " came again while its muscles were driven");
    if (one.empty()) continue;
    if (frozen.text.empty())
      frozen = std::move(one.front());
    else
      ++others;
  }
  if (others > 0)
    frozen.text += fmt::format("; so it was with {} more sensor{}", others, others == 1 ? "" : "s");
  if (!frozen.text.empty()) out.push_back(std::move(frozen));
  return out;
}

std::vector<Warning> rejected_commands(const signals::Table& table) {
  std::vector<Warning> out =
      counted(table, "/low_level/rejected_commands", "", "command was", "commands were",
              " rejected: not numbers, out of range or too fast");
  append(out, counted(table, "/low_level/gaps", "", "tick", "ticks", " came later than announced"));
  return out;
}

std::vector<Warning> cut_logs(const signals::Table& table) {
  if (table.complete) return {};
  return {{"the log was cut off or is damaged: this is what stands before", {}}};
}

namespace {

// A length that no muscle can have is no result.
std::vector<Warning> beyond_the_muscle(const signals::Table& table) {
  const Column* length = table.column("/true/stand/length");
  if (!length) length = table.column("/stand/length");
  if (!length || length->empty()) return {};
  const double least = std::ranges::min(*length);
  if (!(least <= 0)) return {};
  return {{fmt::format("the load was thrown to {:.3g} m: below the shortest length [31] has no "
                       "force; try an actuator whose short_end.law is not \"zero\"",
                       least),
           {}}};
}

}  // namespace

std::vector<Warning> warnings(const signals::Table& table, const Machine& machine) {
  if (machine.stand) {
    std::vector<Warning> all = beyond_the_muscle(table);
    append(all, clipped_transducers(table));
    return all;
  }
  std::vector<Warning> all = unused_air(table, machine);
  append(all, unopened_valves(table, machine));
  append(all, ended_tracks(table, machine));
  append(all, overturned_joints(table, machine));
  append(all, unreachable_targets(table, machine.robot));
  append(all, overruns(table));
  append(all, disbelieved_sensors(table, machine.robot));
  append(all, rejected_commands(table));
  append(all, saturated_duties(table, machine.robot));
  append(all, clipped_sensors(table, machine.robot));
  append(all, lifted_rollers(table));
  return all;
}

std::vector<std::string> texts(const std::vector<Warning>& warnings) {
  std::vector<std::string> out;
  for (const Warning& w : warnings) out.push_back(w.text);
  return out;
}

}  // namespace sinew::analysis
