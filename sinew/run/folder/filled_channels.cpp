#include "sinew/run/folder/filled_channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "sinew/robot/legs.h"

namespace sinew::run {

namespace {

using Kind = robot::Sensor::Kind;

// A sensor's quantity: its topic, and the line between its values and counts.
struct Line {
  std::string topic, unit;
  double at_zero = 0;  // the quantity where the counts are `count_at_zero`
  double count_at_zero = 0;
  double counts_per_unit = 0;

  double counts(double value) const { return count_at_zero + (value - at_zero) * counts_per_unit; }
  double value(double count) const { return at_zero + (count - count_at_zero) / counts_per_unit; }
};

Line line_of(const robot::Robot& robot, const robot::Sensor& sensor, double atmosphere) {
  const double per_volt = robot.converter.counts_per_volt();
  const int joint = robot::find_joint(robot, sensor.of);
  const int muscle = robot::find_muscle(robot, sensor.of);
  Line out{.count_at_zero = sensor.assumed_at_rest, .counts_per_unit = sensor.assumed_scale};
  if (sensor.kind == Kind::angle && joint >= 0) {
    out.topic = robot::topic_of_joint(robot, static_cast<std::size_t>(joint)) + "/angle";
    out.unit = "rad";
    out.at_zero = robot.joints[static_cast<std::size_t>(joint)].rest_angle;
  } else if (sensor.kind == Kind::tension && muscle >= 0) {
    out.topic = robot::topic_of_muscle(robot, static_cast<std::size_t>(muscle)) + "/tension";
    out.unit = "N";
    out.counts_per_unit = sensor.scale * per_volt;
  } else if (sensor.kind == Kind::pressure && muscle >= 0) {
    out.topic = robot::topic_of_muscle(robot, static_cast<std::size_t>(muscle)) + "/pressure";
    out.unit = "Pa";
    out.at_zero = atmosphere;
    out.counts_per_unit *= per_volt;
  } else if (sensor.kind == Kind::velocity && joint >= 0) {
    out.topic = robot::topic_of_joint(robot, static_cast<std::size_t>(joint)) + "/velocity";
    out.unit = "rad/s";
    out.counts_per_unit *= per_volt;
  } else if (sensor.kind == Kind::cylinder) {
    out.topic = "/cylinder/position";
    out.unit = "m";
  }
  return out;
}

class Filler {
 public:
  Filler(signals::Table& table, const robot::Robot& robot) : table_(table), robot_(robot) {}

  void counts_of(const robot::Sensor& sensor, const Line& line) {
    const signals::Series from = *table_.find(line.topic);  // copies share their samples
    const double top = robot_.converter.top();
    std::size_t beyond = 0;
    add(name_of(sensor), "count", fmt::format("from {} by the sensor's scale", line.topic), from,
        [&](double value) {
          const double count = std::round(line.counts(value));
          beyond += count < 0 || count > top ? 1 : 0;
          return std::clamp(count, 0.0, top);
        });
    counted_.push_back(sensor.name);
    if (beyond > 0)
      notes_.push_back(fmt::format(
          "{}: {} of {} values are beyond what its converter can count, and stand at its end; is "
          "the unit right, or the robot's scale?",
          line.topic, beyond, from.time_ns.size()));
  }

  void quantity_of(const robot::Sensor& sensor, const Line& line) {
    add(line.topic, line.unit, fmt::format("from {} by the sensor's scale", name_of(sensor)),
        signals::Series(*table_.find(name_of(sensor))),
        [&](double count) { return line.value(count); });
    measured_.push_back(line.topic);
  }

  // A joint that does not move has the counts of its rest, at the times of the first sensor.
  void constant(const robot::Sensor& sensor) {
    const signals::Series* first = nullptr;
    for (const robot::Sensor& other : robot_.sensors)
      if (!first) first = table_.find(name_of(other));
    if (!first) return;
    const signals::Series times = *first;
    add(name_of(sensor), "count", "of a quantity that does not move, as it is at rest", times,
        [&](double) { return std::round(sensor.at_rest); });
    counted_.push_back(sensor.name);
  }

  static std::string name_of(const robot::Sensor& sensor) {
    return "/sensor/" + sensor.name + "/count";
  }

  std::vector<std::string> take() {
    if (!counted_.empty())
      notes_.insert(notes_.begin(),
                    fmt::format("counts by the robot's scales, which the recording lacks: {}",
                                fmt::join(counted_, ", ")));
    if (!measured_.empty())
      notes_.insert(notes_.begin(),
                    fmt::format("quantities by the robot's scales, of which the recording has the "
                                "counts: {}",
                                fmt::join(measured_, ", ")));
    return std::move(notes_);
  }

 private:
  template <class Of>
  void add(std::string topic, std::string unit, std::string description,
           const signals::Series& from, Of of) {
    signals::Series out{{std::move(topic), std::move(description), {{"value", std::move(unit)}}},
                        signals::Times(from.time_ns.file()),
                        {signals::Column(from.time_ns.file())}};
    for (std::size_t i = 0; i < from.time_ns.size(); ++i) {
      const double value = from.columns[0][i];
      if (!std::isfinite(value)) continue;
      out.time_ns.push_back(from.time_ns[i]);
      out.columns[0].push_back(of(value));
    }
    table_.series.push_back(std::move(out));
  }

  signals::Table& table_;
  const robot::Robot& robot_;
  std::vector<std::string> counted_, measured_, notes_;
};

}  // namespace

std::vector<std::string> fill_channels(signals::Table& table, const robot::Robot& robot,
                                       double atmosphere,
                                       const std::vector<signals::Topic>& logged) {
  Filler filler(table, robot);
  for (const robot::Sensor& sensor : robot.sensors) {
    const bool counts = table.find(Filler::name_of(sensor)) != nullptr;
    const Line line = line_of(robot, sensor, atmosphere);
    if (line.topic.empty() || line.counts_per_unit == 0) continue;
    const bool quantity = table.find(line.topic) != nullptr;
    const bool wanted = std::ranges::count(logged, line.topic, &signals::Topic::name) > 0;
    if (counts && !quantity && wanted) filler.quantity_of(sensor, line);
    if (quantity && !counts) filler.counts_of(sensor, line);
  }
  for (const robot::Sensor& sensor : robot.sensors)
    if (sensor.kind == Kind::fixed && !table.find(Filler::name_of(sensor))) filler.constant(sensor);
  return filler.take();
}

}  // namespace sinew::run
