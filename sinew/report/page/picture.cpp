#include "sinew/report/page/picture.h"

#include <exception>

#include "sinew/analysis/record/machine.h"
#include "sinew/report/page/content.h"
#include "sinew/robot/legs.h"
#include "sinew/units/quantity.h"

namespace sinew::report {
namespace {

// Returns the angle at which the experiment starts a joint, or else its rest angle  [rad].
double start_angle(const config::Node& resolved, const robot::Joint& joint) {
  const config::Node* node = resolved.find("start");
  for (const std::string& key : {std::string("joint_angles"), joint.name})
    if (node != nullptr) node = node->find(key);
  if (node != nullptr && node->is_value_table()) node = node->find("value");
  if (node == nullptr) return joint.rest_angle;
  const units::NumberAndUnit angle = units::split_number(node->text);
  return angle.unit == "rad" ? angle.number : joint.rest_angle;
}

// Returns a log with a single row.
signals::Table first_row(const config::Node& resolved, const analysis::Machine& machine) {
  signals::Table out;
  for (const robot::Joint& joint : machine.robot.joints) {
    signals::Series s{{robot::logged_topic(machine.robot, "/joint/" + joint.name + "/angle"),
                       "",
                       {{"value", "rad"}}},
                      {},
                      std::vector<signals::Column>(1)};
    s.time_ns.push_back(0);
    s.columns[0].push_back(start_angle(resolved, joint));
    out.series.push_back(std::move(s));
  }
  return out;
}

Json picture_of_robot(const config::Node& resolved) {
  const analysis::Machine machine = analysis::read_machine(resolved);
  const signals::Table row = first_row(resolved, machine);
  const analysis::Record record(row, machine);
  Channels channels;
  channels.add(row);
  signals::Table drawn;
  const Scene scene_of_row = scene(channels, machine, record, drawn);
  channels.add(drawn);
  Blob blob;
  Columns columns(channels, blob);
  Json out{{"scene", to_json(scene_of_row, columns)}, {"atmosphere", machine.atmosphere}};
  out["samples"] = to_json(blob.layout());
  out["data"] = blob.base64();
  return out;
}

}  // namespace

std::string picture(const config::Node& resolved) {
  Json out = Json::object();
  try {
    if (resolved.find("element"))
      out["stand"] = true;
    else
      out = picture_of_robot(resolved);
  } catch (const std::exception&) {
    // The file does not describe a machine that can be drawn.
  }
  return out.text();
}

}  // namespace sinew::report
