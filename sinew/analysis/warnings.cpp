#include "sinew/analysis/warnings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "sinew/analysis/measures/statistics.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/summary.h"
#include "sinew/analysis/times.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"
#include "sinew/signals/tick.h"
#include "sinew/units/constants.h"

namespace sinew::analysis {

namespace {

constexpr double whole_period = 0.9999;  // a duty of 100 % as a double [-]

// Adds a warning "<before> 3 of 100 <after>" if any sample counts.
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

// Returns a warning "<before>3 <things><after>" or "<before>1 <thing><after>" for a topic that is
// a running count, with the times at which it grows; empty if it never does.
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

// Sensors with a frozen reading share one warning: a machine that does not move has many.
std::vector<Warning> implausible_sensors(const signals::Table& table, const robot::Robot& robot) {
  std::vector<Warning> out;
  Warning frozen;
  std::size_t others = 0;
  for (const robot::Sensor& s : robot.sensors) {
    append(out, counted(table, "/sensor/" + s.name + "/rejected", s.name + ": ", "reading was",
                        "readings were", " not accepted; the last good ones were used"));
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

std::vector<Warning> coarse_valves(const signals::Table& table) {
  const auto count = std::ranges::count_if(table.series, [](const signals::Series& series) {
    return signals::has_coarse_edges(series.topic);
  });
  if (count == 0) return {};
  return {{fmt::format("the rows of the table are too far apart to give the pulses of {} valve{}: "
                       "figures of delivered duties, switchings and coils are absent",
                       count, count == 1 ? "" : "s"),
           {}}};
}

std::vector<Warning> cut_logs(const signals::Table& table) {
  if (table.complete) return {};
  return {{"the log was cut off or is damaged: this is what stands before", {}}};
}

namespace {

// Warns of a length of 0 or less, which no muscle can have.
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
  append(all, coarse_valves(table));
  append(all, unopened_valves(table, machine));
  append(all, ended_tracks(table, machine));
  append(all, joints_beyond_range(table, machine));
  append(all, unreachable_targets(table, machine.robot));
  append(all, overruns(table));
  append(all, implausible_sensors(table, machine.robot));
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

// --- A robot that does nothing, or that can go no further ---

namespace {

// Returns the change of a topic from its first sample to its last; empty if it is not logged.
std::optional<double> gained(const signals::Table& table, const std::string& topic) {
  const signals::Series* s = table.find(topic);
  if (!s || s->columns.empty() || s->columns[0].empty()) return std::nullopt;
  return s->columns[0].back() - s->columns[0].front();
}

// Returns the span from the first sample of any topic to the last one  [s].
Span span_of(const signals::Table& table) {
  std::int64_t from = std::numeric_limits<std::int64_t>::max(), to = 0;
  for (const signals::Series& s : table.series) {
    if (s.time_ns.empty()) continue;
    from = std::min(from, s.time_ns.front());
    to = std::max(to, s.time_ns.back());
  }
  return {1e-9 * static_cast<double>(from), 1e-9 * static_cast<double>(to)};
}

// Pulses of one valve of a muscle, and the share of the commanded time that it is open for.
struct Pulses {
  Occasions times;
  std::map<signals::Tick, std::size_t>
      lasts;                            // number by length, without a pulse that the end cuts off
  double commanded = 0, delivered = 0;  // shares of the log's time [-]
};

Pulses pulses_of(const signals::Series& series, const MachineValve& valve, double from, double to) {
  Pulses out;
  const Edges list = edges_of(series.time_ns, series.columns[0]);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].open) continue;
    out.times.add(std::llround(1e9 * list[i].time));
    if (i + 1 == list.size()) continue;
    // Longer pulses count as one of this length, which keeps the number of lengths small.
    constexpr double longest = 1;  // [s]
    const double lasts = std::min(list[i + 1].time - list[i].time, longest);
    ++out.lasts[std::llround(lasts / signals::tick_seconds)];
  }
  out.commanded = open_time(list, from, to) / (to - from);
  out.delivered = open_time(delivered(list, valve.shut, valve.closing), from, to) / (to - from);
  return out;
}

// Returns the median length of the pulses  [s].
double half_lasts(const Pulses& pulses) {
  std::size_t all = 0, so_far = 0;
  for (const auto& [length, count] : pulses.lasts) all += count;
  for (const auto& [length, count] : pulses.lasts)
    if ((so_far += count) > all / 2) return static_cast<double>(length) * signals::tick_seconds;
  return 0;
}

// Muscles with the same valve, which hardly opens.
struct Unopened {
  std::vector<std::string> muscles;
  Pulses worst;
  MachineValve valve;
};

constexpr double least_delivered = 0.1;  // largest delivered share of the commanded time [-]
constexpr double commanded = 0.005;      // smallest share of the log's time that is checked [-]

void add_unopened(const signals::Table& table, const Machine& machine, const robot::Muscle& muscle,
                  bool inlet, Unopened& out) {
  const MachineValve valve = valve_of(machine, inlet ? muscle.inlet : muscle.exhaust);
  const auto logged = [&](const std::string& topic) {
    return robot::logged_topic(machine.robot, topic);
  };
  const std::string name = inlet ? "inlet" : "exhaust";
  const signals::Series* edges = table.find(logged("/valve/" + muscle.name + "/" + name + "/open"));
  if (!edges || edges->columns.empty() || valve.shut <= 0) return;
  if (signals::has_coarse_edges(edges->topic)) return;
  const Span log = span_of(table);
  if (!(log.to > log.from)) return;
  Pulses pulses = pulses_of(*edges, valve, log.from, log.to);
  if (pulses.lasts.empty() || pulses.commanded < commanded) return;
  if (pulses.delivered > least_delivered * pulses.commanded) return;
  // If air passed although no pulse was long enough, the log was made with other delays.
  const std::string moved =
      logged("/true/muscle/" + muscle.name + (inlet ? "/air_in" : "/air_out"));
  if (pulses.delivered == 0 && gained(table, moved).value_or(0) > 0) return;
  if (out.muscles.empty() || pulses.commanded > out.worst.commanded) out.worst = std::move(pulses);
  out.muscles.push_back(muscle.name);
  out.valve = valve;
}

std::string text_of(const Unopened& all, std::string_view which) {
  const std::size_t others = all.muscles.size() - 1;
  const std::string more =
      others == 0 ? "" : fmt::format(" and {} more muscle{}", others, others == 1 ? "" : "s");
  const Pulses& p = all.worst;
  return fmt::format(
      "{}{}: the {} hardly opens: {:.2g} % of the time for {:.3g} % commanded; half of its {} "
      "pulses "
      "last {:.3g} ms at most, and the valve takes {:.3g} ms to open; try more "
      "low_level.pwm_ticks, or "
      "a quicker valve",
      all.muscles.front(), more, which, 100 * p.delivered, 100 * p.commanded, p.times.count,
      1e3 * half_lasts(p), 1e3 * all.valve.shut);
}

constexpr double held = units::degree;  // a desired angle that changes by less is held [rad]

// Returns whether the plan moves a joint or opens an inlet. A joint that is held may need no air.
bool is_commanded(const Record& record, const Machine& machine) {
  for (const robot::Joint& joint : machine.robot.joints) {
    const Column desired = record.column("/desired/joint/" + joint.name + "/angle");
    if (!joint.enabled || desired.empty()) continue;
    if (largest(desired, record.sequence()) - smallest(desired, record.sequence()) > held)
      return true;
  }
  for (const robot::Muscle& muscle : machine.robot.muscles) {
    const Column duty = record.column("/muscle/" + muscle.name + "/inlet_duty");
    if (!duty.empty() && largest(duty, record.sequence()) > 0) return true;
  }
  return false;
}

}  // namespace

std::vector<Warning> unopened_valves(const signals::Table& table, const Machine& machine) {
  std::vector<Warning> out;
  for (const bool inlet : {true, false}) {
    std::map<std::string, Unopened> by_valve;
    for (const robot::Muscle& muscle : machine.robot.muscles)
      add_unopened(table, machine, muscle, inlet, by_valve[inlet ? muscle.inlet : muscle.exhaust]);
    for (auto& [name, all] : by_valve)
      if (!all.muscles.empty())
        out.push_back(
            {text_of(all, inlet ? "inlet" : "exhaust"), std::move(all.worst.times.spans)});
  }
  return out;
}

std::vector<Warning> unused_air(const signals::Table& table, const Machine& machine,
                                signals::TopicNames* read) {
  bool known = false;
  for (const robot::Muscle& muscle : machine.robot.muscles) {
    const std::string topic =
        robot::logged_topic(machine.robot, "/true/muscle/" + muscle.name + "/air_in");
    if (read) read->insert(topic);
    const auto in = gained(table, topic);
    if (in.value_or(0) > 0) return {};
    known = known || in.has_value();
  }
  const Record record(table, machine, nullptr, "", read);
  if (!known || !record.has_sequence() || !is_commanded(record, machine)) return {};
  return {
      {fmt::format("no muscle took any air in the {:.4g} s of the plan, whatever it commanded: the "
                   "robot does nothing",
                   record.sequence_lasts()),
       {{record.sequence_start(), record.sequence_end()}}}};
}

std::vector<Warning> ended_tracks(const signals::Table& table, const Machine& machine) {
  const double track = machine.robot.trolley.track_length;
  if (!machine.robot.trolley.present || track <= 0) return {};
  const Record record(table, machine);
  const Column x = record.column("/true/trolley/position");
  if (x.empty() || !record.has_sequence()) return {};
  Occasions times;
  for (std::size_t i = record.first_row(); i <= record.last_row(); ++i)
    if (x[i] >= track) times.add(record.time_ns()[i]);
  if (times.count == 0) return {};
  const double at = times.spans.front().from;
  return {{fmt::format("the trolley reaches the end of its track at {:.2f} s, {:.2f} s before the "
                       "sequence is over: distance and mean speed are up to there",
                       at, record.sequence_end() - at),
           std::move(times.spans)}};
}

namespace {

constexpr double stretched = 1.1;  // limit of the length, in thread lengths [-]

// Returns whether a muscle crosses this joint alone, on a round cam: the length of any other does
// not follow from one angle and a constant arm.
bool is_of_one_joint(const robot::Muscle& m, const robot::Joint& joint) {
  return m.joint == joint.name && m.second.joint.empty() && m.cam.angle.empty() &&
         std::isnan(m.cam.radius);
}

// Describes why the muscle's length at this angle is impossible; empty if it is possible.
std::string beyond(const robot::Joint& joint, const robot::Muscle& m, const actuator::Actuator& a,
                   double angle) {
  const double length = robot::muscle_length(joint, m.role, m.mount_length, angle);
  const double thread = a.caps.length + a.braid.thread_length;
  if (length > a.caps.length && length - a.caps.length <= stretched * a.braid.thread_length)
    return "";
  const bool longer = length > thread;
  return fmt::format("{} would be {:.4g} mm long, {} its {}'s {:.4g} mm", m.name, 1e3 * length,
                     longer ? "beyond" : "below", longer ? "thread" : "caps",
                     1e3 * (longer ? thread : a.caps.length));
}

std::string what_is_beyond(const Machine& machine, const robot::Joint& joint, double turned) {
  if (std::abs(turned) > 2 * std::numbers::pi) return "more than a whole turn";
  if (joint.kind != robot::Joint::Kind::driven) return "";
  for (const robot::Muscle& m : machine.robot.muscles) {
    if (!is_of_one_joint(m, joint)) continue;
    const actuator::Actuator a = robot::actuator_of(m, machine.actuators);
    const std::string text = beyond(joint, m, a, joint.rest_angle + turned);
    if (!text.empty()) return text;
  }
  return "";
}

// Returns the true angle, or in a log of hardware the measured one, which does not count whole
// turns.
const signals::Series* angles_of(const signals::Table& table, const robot::Robot& robot,
                                 const robot::Joint& joint) {
  const std::string at = "/joint/" + joint.name + "/angle";
  const signals::Series* known = table.find(robot::logged_topic(robot, "/true" + at));
  return known ? known : table.find(robot::logged_topic(robot, at));
}

// Returns the angle from rest in each sample [rad]. Whole turns are removed so that the first
// sample is within half a turn of the rest angle.
Column turned_from_rest(const robot::Joint& joint, const Column& angle) {
  Column out(angle.file());
  if (angle.empty()) return out;
  constexpr double turn = 2 * std::numbers::pi;
  const double whole = turn * std::round((angle.front() - joint.rest_angle) / turn);
  const double rest = joint.rest_angle + (std::isfinite(whole) ? whole : 0.0);
  for (const double a : angle) out.push_back(a - rest);
  return out;
}

}  // namespace

std::vector<Warning> joints_beyond_range(const signals::Table& table, const Machine& machine) {
  std::vector<Warning> out;
  for (const robot::Joint& joint : machine.robot.joints) {
    const signals::Series* series = angles_of(table, machine.robot, joint);
    if (!series || series->columns.empty()) continue;
    const Column turned = turned_from_rest(joint, series->columns[0]);
    double furthest = 0;
    for (const double t : turned)
      if (std::abs(t) > std::abs(furthest)) furthest = t;
    const std::string text = what_is_beyond(machine, joint, furthest);
    if (text.empty()) continue;
    Occasions times;
    for (std::size_t i = 0; i < turned.size(); ++i)
      if (!what_is_beyond(machine, joint, turned[i]).empty()) times.add(series->time_ns[i]);
    out.push_back({fmt::format("{}: turned {:.0f} deg from its rest angle: {}", joint.name,
                               furthest / units::degree, text),
                   std::move(times.spans)});
  }
  return out;
}

}  // namespace sinew::analysis
