#include "sinew/report/page/live_page.h"

#include <algorithm>
#include <deque>
#include <limits>

#include "sinew/actuator/braid.h"
#include "sinew/analysis/record/derived.h"
#include "sinew/log/deflate.h"
#include "sinew/report/page/scene.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/robot/legs.h"

namespace sinew::report {
namespace {

using signals::Series;
using signals::Table;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t row_ns = 10'000'000;

bool is_edge(const signals::Topic& topic) { return signals::is_of_valve(topic.name); }

// A log that gives the page its extent: the machine at rest, and with every joint turned either
// way. Edges have a clock each, as in a run.
class Prototype {
 public:
  Prototype(const std::vector<signals::Topic>& topics, const analysis::Machine& machine,
            bool foot_path) {
    for (const double turn : {0.0, -0.8, 0.8}) {
      std::vector<double> angles;
      for (const robot::Joint& j : machine.robot.joints) angles.push_back(j.rest_angle + turn);
      poses_.push_back(std::move(angles));
    }
    for (const signals::Topic& topic : topics) {
      Series s{topic, {}, std::vector<signals::Column>(topic.fields.size())};
      if (is_edge(topic))
        put(s, ++edges_, 0);
      else
        for (std::size_t row = 0; row < poses_.size(); ++row)
          put(s, static_cast<std::int64_t>(row) * row_ns,
              value(topic.name, row, machine, foot_path));
      table.series.push_back(std::move(s));
    }
  }

  Table table;

 private:
  static void put(Series& s, std::int64_t time_ns, double v) {
    s.time_ns.push_back(time_ns);
    for (auto& column : s.columns) column.push_back(v);
  }
  double value(const std::string& topic, std::size_t row, const analysis::Machine& m,
               bool foot_path) const {
    if (topic.ends_with("/plan/phase")) return -1;
    if (topic.starts_with("/desired/") && topic.ends_with("/foot/position") && !foot_path)
      return none;
    for (std::size_t j = 0; j < m.robot.joints.size(); ++j)
      if (topic.ends_with(robot::topic_of_joint(m.robot, j) + "/angle")) return poses_[row][j];
    for (const robot::Muscle& muscle : m.robot.muscles)
      if (topic == robot::logged_topic(m.robot, "/true/muscle/" + muscle.name + "/length"))
        return std::min(robot::muscle_length(m.robot, muscle, poses_[row]),
                        robot::actuator_of(muscle, m.actuators).braid.thread_length);
    return m.stand ? value_of_stand(topic, row, m) : 0;
  }
  // Returns lengths from the longest to the shortest element, so that the page has room for all.
  static double value_of_stand(const std::string& topic, std::size_t row,
                               const analysis::Machine& m) {
    const robot::Stand& stand = *m.stand;
    const bool read = std::ranges::any_of(stand.sensors, [&](const robot::Transducer& t) {
      return t.of == robot::Transducer::Of::length && topic == "/sensor/" + t.name + "/value";
    });
    if (!read && topic != "/true/stand/length") return 0;
    double longest = stand.element.cylinder.stroke, shortest = 0;
    for (const actuator::Actuator& a : m.actuators)
      if (a.name == stand.element.actuator) {
        longest = a.braid.thread_length;
        shortest = actuator::shortest_length(a.braid);
      }
    return row == 1 ? shortest : longest;
  }

  std::vector<std::vector<double>> poses_;
  std::int64_t edges_ = 0;
};

Table without_windows(Table derived) {
  std::erase_if(derived.series, [](const Series& s) { return !is_pointwise(s.topic.name); });
  return derived;
}

}  // namespace

bool is_pointwise(std::string_view topic) {
  return !topic.ends_with("/oscillation") && !topic.starts_with("/trolley/");
}

struct LivePage::Parts {
  Parts(const Table& table, const analysis::Machine& machine)
      : derived(without_windows(analysis::derive(table, machine))),
        record(table, machine, &derived),
        drawing(table, derived, machine, record) {}

  Table derived;
  analysis::Record record;
  Drawing drawing;
};

LivePage::LivePage(const std::vector<signals::Topic>& topics, Of of)
    : of_(std::move(of)), machine_(analysis::read_machine(of_.resolved)) {
  const Prototype prototype(topics, machine_, of_.foot_path);
  const Parts parts(prototype.table, machine_);

  Blob blob;
  Columns columns(parts.drawing.channels, blob);
  const analysis::Analysis analysis(prototype.table, machine_);
  const report::Content whole = report::content(
      {.analysis = analysis, .resolved = of_.resolved, .name = of_.name, .units = of_.units});
  units_ = whole.units;
  Json head = Json::parse(whole.json);
  head["duration"] = of_.duration;
  head["phases"]["stretches"] = Json::array();
  head["panels"] = panels_json(panels(parts.drawing.channels, machine_), columns);
  head["scene"] = to_json(parts.drawing.scene, columns);
  if (machine_.stand) head["stand"] = to_json(parts.drawing.stand, columns);
  if (!machine_.faults.empty()) head["faults"] = to_json(machine_.faults, of_.duration);
  head.erase("charts");   // these need the whole run
  head.erase("changes");  // each is sent when it takes effect
  head["warnings"] = head["verdicts"] = Json::array();
  head["summary"] = Json::object();
  Blob::Layout layout = blob.layout();
  std::ranges::fill(layout.clocks, 0);
  head["samples"] = to_json(layout);
  head_ = head.text();
  columns_ = columns.list();
}

Content LivePage::content(const std::string& live) const {
  return {.title = machine_.title.empty() ? of_.name : machine_.title,
          .json = head_.substr(0, head_.size() - 1) + ",\"live\":" + live + "}",
          .samples = to_base64(log::deflated("")),
          .units = units_};
}

std::string LivePage::piece(const Table& table) const {
  const Parts parts(table, machine_);
  Blob blob;
  std::deque<signals::Column> no_values;  // one per missing channel: a blob joins equal addresses
  const signals::Times no_times;
  for (const Columns::Request& request : columns_) {
    Samples samples = parts.drawing.channels.find(request.channel);
    if (!samples) samples = {&no_times, &no_values.emplace_back(), ""};
    blob.add(samples, request.as);
  }
  return Json{{"samples", to_json(blob.layout())},
              {"data", blob.base64()},
              {"phases", phases_of(parts.record, machine_)}}
      .text();
}

}  // namespace sinew::report
