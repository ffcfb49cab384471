#include "sinew/report/page/pose.h"

#include <algorithm>

#include "sinew/robot/kinematics.h"

namespace sinew::report {
namespace {

using analysis::Column;
using analysis::Record;

Column constant(double value, const Record& record) {
  Column out = record.new_column();
  out.assign(record.rows(), value);
  return out;
}

Column or_zeros(Column values, const Record& record) {
  return values.empty() ? constant(0, record) : values;
}

Column first_of(const Record& record, std::initializer_list<const char*> topics) {
  for (const char* topic : topics)
    if (Column found = record.column(topic); !found.empty()) return found;
  return {};
}

// By the trapezoidal rule, which is exact for the straight pieces of a cam whose corners it meets.
double cord_taken_up(const robot::Muscle& muscle, const robot::Joint& joint, double angle) {
  constexpr int pieces = 32;
  const double step = (angle - joint.rest_angle) / pieces;
  double sum = 0;
  for (int i = 0; i <= pieces; ++i) {
    const double share = i == 0 || i == pieces ? 0.5 : 1.0;
    sum += share * robot::pull_at(muscle, joint, joint.rest_angle + i * step);
  }
  return sum * step;
}

}  // namespace

Poses poses(const analysis::Machine& machine, const Record& record) {
  Poses out;
  std::vector<Column> angle;
  bool any = false;
  for (const robot::Joint& joint : machine.robot.joints) {
    const std::string measured = "/joint/" + joint.name + "/angle";
    Column at = record.column("/true" + measured);
    if (!at.empty()) out.is_true = true;
    if (at.empty()) at = record.column(measured);
    any = any || !at.empty();
    if (at.empty()) at = constant(joint.rest_angle, record);
    angle.push_back(std::move(at));
  }
  if (!any) return {};
  out.angle = std::move(angle);
  out.trolley = or_zeros(first_of(record, {"/true/trolley/position", "/trolley/position"}), record);
  out.lift = or_zeros(first_of(record, {"/true/cylinder/position", "/cylinder/position"}), record);
  return out;
}

double length_by_cams(const robot::Robot& robot, const robot::Muscle& muscle,
                      const std::vector<double>& angles) {
  double length = muscle.mount_length;
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (robot::pull_at(muscle, robot.joints[j], angles[j]) != 0)
      length -= cord_taken_up(muscle, robot.joints[j], angles[j]);
  return length;
}

}  // namespace sinew::report
