#include "sinew/analysis/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace sinew::analysis {
namespace {

constexpr double apart = 0.1;            // of two spans [s]
constexpr double whole_period = 0.9999;  // a duty of 100 % as a double [-]

struct Times {
  std::size_t count = 0, of = 0;  // samples
  std::vector<Span> spans;
};

// The samples of a topic for which `is` holds; none where there is no such topic.
Times times_when(const signals::Table& table, const std::string& topic,
                 const std::function<bool(double)>& is) {
  Times out;
  const signals::Series* series = table.find(topic);
  if (!series || series->columns.empty()) return out;
  const std::vector<double>& values = series->columns.front();
  out.of = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is(values[i])) continue;
    ++out.count;
    const double t = static_cast<double>(series->time_ns[i]) / 1e9;
    if (out.spans.empty() || t - out.spans.back().to >= apart) out.spans.push_back({t, t});
    out.spans.back().to = t;
  }
  return out;
}

// "<before> 3 of 100 <after>", where it ever was.
void add(std::vector<Warning>& out, Times times, std::string_view before, std::string_view after) {
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
    for (const std::string which : {"inlet", "exhaust"})
      add(out,
          times_when(table, "/muscle/" + muscle.name + "/" + which + "_duty",
                     [](double duty) { return duty >= whole_period; }),
          muscle.name + ": the " + which + " stays open all the time in",
          "periods: its duty is saturated");
  return out;
}

std::vector<Warning> unreachable_targets(const signals::Table& table) {
  std::vector<Warning> out;
  add(out, times_when(table, "/plan/unreachable", [](double is) { return is > 0; }),
      "the foot is out of reach in", "samples: the nearest point was aimed at");
  return out;
}

namespace {

// "<before>3 <things>" or "<before>1 <thing>", then "<after>", of a topic that counts, at the times
// at which it grows.
std::vector<Warning> counted(const signals::Table& table, const std::string& topic,
                             const std::string& before, std::string_view thing,
                             std::string_view things, std::string_view after) {
  double most = 0;
  Times times = times_when(table, topic, [&](double so_far) {
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
                 " took longer than a hundredth of the period: the thesis's computer locked up so "
                 "(5.2)");
}

std::vector<Warning> disbelieved_sensors(const signals::Table& table, const robot::Robot& robot) {
  std::vector<Warning> out;
  for (const robot::Sensor& s : robot.sensors) {
    append(out, counted(table, "/sensor/" + s.name + "/rejected", s.name + ": ", "reading was",
                        "readings were", " not believed; the last good ones stood"));
    append(out, counted(table, "/sensor/" + s.name + "/frozen", s.name + ": ", "reading",
                        "readings", " came again while its muscles were driven"));
  }
  return out;
}

std::vector<Warning> cut_logs(const signals::Table& table) {
  if (table.complete) return {};
  return {{"the log was cut off or is damaged: this is what stands before", {}}};
}

std::vector<Warning> warnings(const signals::Table& table, const Machine& machine) {
  std::vector<Warning> all = cut_logs(table);
  append(all, unreachable_targets(table));
  append(all, overruns(table));
  append(all, disbelieved_sensors(table, machine.robot));
  append(all, saturated_duties(table, machine.robot));
  append(all, clipped_sensors(table, machine.robot));
  append(all, lifted_rollers(table));
  return all;
}

}  // namespace sinew::analysis
