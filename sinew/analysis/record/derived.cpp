#include "sinew/analysis/record/derived.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "sinew/actuator/stiffness.h"
#include "sinew/analysis/measures/foot.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/trolley.h"
#include "sinew/analysis/record/legs.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/robot/kinematics.h"
#include "sinew/robot/legs.h"

namespace sinew::analysis {
namespace {

using Role = robot::Muscle::Role;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Collects the series; one without values is left out.
class Series {
 public:
  // Prefixes topics with the leg of that name; empty for a machine with one leg. Series that are
  // not `wanted` are left out.
  Series(const Record& record, const TopicNames* wanted, std::string leg = "")
      : record_(record), wanted_(wanted), leg_(std::move(leg)) {}

  bool wants(std::string_view topic) const { return !wanted_ || wanted_->contains(name(topic)); }
  // Returns whether the leg's push on the trolley is needed.
  bool wants_pushes() const {
    return !wanted_ || std::ranges::any_of(*wanted_, [](const std::string& topic) {
      return topic.starts_with("/trolley/");
    });
  }

  // Adds a series if it is wanted; values() computes it.
  template <class Values>
  void scalar(const std::string& topic, std::string unit, std::string description,
              const Values& values_of) {
    if (!wants(topic)) return;
    Column values = values_of();
    if (values.empty()) return;
    table.series.push_back({{name(topic), std::move(description), {{"value", unit}}},
                            record_.time_ns(),
                            {std::move(values)}});
  }
  void vector(const std::string& topic, std::string unit, std::string description, Column x,
              Column y) {
    if (x.empty() || y.empty()) return;
    table.series.push_back({{name(topic), std::move(description), {{"x", unit}, {"y", unit}}},
                            record_.time_ns(),
                            {std::move(x), std::move(y)}});
  }

  const Column* column(std::string_view topic, std::string_view field) const {
    return table.column(name(topic), field);
  }

  signals::Table table;

 private:
  std::string name(std::string_view topic) const { return robot::topic_of_leg(leg_, topic); }

  const Record& record_;
  const TopicNames* wanted_;
  std::string leg_;
};

// Returns out[i] = of(i), or an empty column if one of `columns` is empty.
template <class Of, class... Columns>
Column rowwise(const Record& record, Of of, const Columns&... columns) {
  if ((columns.empty() || ...)) return {};
  Column out = record.new_column();
  for (std::size_t i = 0; i < record.rows(); ++i) out.push_back(of(i));
  return out;
}

bool runs_across(const robot::Muscle& muscle, const robot::Joint& joint) {
  return muscle.joint == joint.name || muscle.second.joint == joint.name;
}

// Sets out[k] to a column of muscle k, for every muscle across the joint. Returns false if a topic
// is missing or no muscle crosses the joint.
bool of_muscles(const Record& record, const Machine& m, const robot::Joint& joint,
                const std::string& prefix, const std::string& what, std::vector<Column>& out) {
  out.assign(m.robot.muscles.size(), {});
  bool any = false;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!runs_across(m.robot.muscles[k], joint)) continue;
    out[k] = record.column(prefix + m.robot.muscles[k].name + what);
    if (out[k].empty()) return false;
    any = true;
  }
  return any;
}

// Returns the angle for a cam that is not round, or the rest angle if the angle is not logged.
double angle_in(const Column& angle, const robot::Joint& joint, std::size_t row) {
  return angle.empty() ? joint.rest_angle : angle[row];
}

Column measured_torque(const Record& record, const Machine& m, std::size_t joint) {
  const robot::Joint& at = m.robot.joints[joint];
  const Column angle = record.column("/joint/" + at.name + "/angle");
  std::vector<Column> tension;
  if (!of_muscles(record, m, at, "/muscle/", "/tension", tension)) return {};
  std::vector<double> now(tension.size(), 0.0);
  const robot::JointMuscles muscles(m.robot, static_cast<int>(joint));
  Column out = record.new_column();
  for (std::size_t i = 0; i < record.rows(); ++i) {
    for (std::size_t k = 0; k < now.size(); ++k)
      if (!tension[k].empty()) now[k] = tension[k][i];
    out.push_back(muscles.torque(angle_in(angle, at, i), now));
  }
  return out;
}

// Returns the sum of r^2 dF/dL; the contribution of the slope of a cam that is not round is left
// out.
Column true_joint_stiffness(const Record& record, const Machine& m, std::size_t joint) {
  const robot::Joint& at = m.robot.joints[joint];
  const Column angle = record.column("/true/joint/" + at.name + "/angle");
  std::vector<Column> length, pressure, tension;
  if (!of_muscles(record, m, at, "/true/muscle/", "/length", length) ||
      !of_muscles(record, m, at, "/true/muscle/", "/pressure", pressure) ||
      !of_muscles(record, m, at, "/true/muscle/", "/tension", tension))
    return {};
  std::vector<actuator::Actuator> actuators;
  for (const robot::Muscle& muscle : m.robot.muscles)
    actuators.push_back(robot::actuator_of(muscle, m.actuators));
  Column out = record.new_column();
  for (std::size_t i = 0; i < record.rows(); ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < length.size(); ++k) {
      if (length[k].empty()) continue;
      const robot::Muscle& muscle = m.robot.muscles[k];
      sum += joint_stiffness(
          robot::moment_arm_at(muscle, at, angle_in(angle, at, i)), muscle.count,
          true_stiffness(actuators[k], length[k][i], pressure[k][i], m.atmosphere, tension[k][i]));
    }
    out.push_back(sum);
  }
  return out;
}

void add_joint(Series& out, const Record& record, const Machine& m, std::size_t joint) {
  const std::string at = "/joint/" + m.robot.joints[joint].name;
  Column error;
  if (out.wants(at + "/error") || out.wants(at + "/oscillation")) {
    const Column angle = record.column(at + "/angle");
    const Column desired = record.column("/desired" + at + "/angle");
    error = rowwise(
        record, [&](std::size_t i) { return turn_between(desired[i], angle[i]); }, angle, desired);
  }
  out.scalar(at + "/torque", "N m", "of the measured tensions",
             [&] { return measured_torque(record, m, joint); });
  out.scalar(at + "/error", "rad", "measured - desired angle", [&] { return error; });
  out.scalar(at + "/oscillation", "rad", "the error without its mean over 0.21 s",
             [&] { return high_passed(error, half_window(oscillation_window, record.period())); });
  out.scalar("/true" + at + "/stiffness", "N m/rad", "of true lengths and pressures, [26]",
             [&] { return true_joint_stiffness(record, m, joint); });
}

void add_passive(Series& out, const Record& record, const Machine& m) {
  for (const robot::Muscle& muscle : m.robot.muscles) {
    const std::string at = "/muscle/" + muscle.name;
    out.scalar(
        at + "/passive", "1", "share of the period with both valves shut, as commanded", [&] {
          const Column inlet = record.column(at + "/inlet_duty");
          const Column exhaust = record.column(at + "/exhaust_duty");
          return rowwise(
              record, [&](std::size_t i) { return passive(m, muscle, inlet[i], exhaust[i]); },
              inlet, exhaust);
        });
  }
}

void add_leg(Series& out, const Record& record, const Machine& m) {
  const bool wants_force = out.wants("/foot/force") || out.wants_pushes();
  if (!wants_force && !out.wants("/foot/position")) return;
  const robot::TwoLinks links = robot::two_links(m.robot);
  const Column hip = record.column("/joint/" + m.robot.joints[0].name + "/angle");
  const Column knee = record.column("/joint/" + m.robot.joints[1].name + "/angle");
  Column t1, t2;
  if (wants_force) t1 = measured_torque(record, m, 0), t2 = measured_torque(record, m, 1);

  const auto position = [&](std::size_t i) { return robot::foot_position(links, hip[i], knee[i]); };
  const auto force = [&](std::size_t i) {
    const auto f = robot::ground_reaction(links, hip[i], knee[i], {t1[i], t2[i]});
    return f.singular ? robot::Point{none, none} : f.force;
  };
  const auto x = [](const auto& point) { return [&](std::size_t i) { return point(i).x; }; };
  const auto y = [](const auto& point) { return [&](std::size_t i) { return point(i).y; }; };

  if (out.wants("/foot/position"))
    out.vector("/foot/position", "m", "of the ankle, of the measured angles [61], [62]",
               rowwise(record, x(position), hip, knee), rowwise(record, y(position), hip, knee));
  if (wants_force)
    out.vector("/foot/force", "N", "on the foot by the ground, of the measured torques [75]",
               rowwise(record, x(force), hip, knee, t1, t2),
               rowwise(record, y(force), hip, knee, t1, t2));
}

// Push of the friction forces of [75] on the trolley: in the plan's stance, and until the foot is
// unloaded.
struct Pushes {
  Column by_plan, loaded;  // [N]
};

// Adds the push to `sum` in the rows for which counts(row) holds, called in ascending order.
template <class Counts>
void add_push(const Record& record, Column& sum, const Column& push, Counts counts) {
  Column out = record.new_column();
  for (std::size_t i = 0; i < push.size(); ++i) {
    const double now = counts(i) ? push[i] : 0.0;
    out.push_back(sum.empty() ? now : sum[i] + now);
  }
  sum = std::move(out);
}

// Adds the friction force of a leg in stance, 6.3; several legs add up.
void add_pushes(const Series& of_leg, const Record& record, Pushes& sum) {
  const Column* x = of_leg.column("/foot/force", "x");
  const Column* normal = of_leg.column("/foot/force", "y");
  if (!x || !record.has_sequence()) return;
  add_push(record, sum.by_plan, *x, [&](std::size_t i) { return record.stance()[i] > 0; });
  // The force also counts in the swing as long as the normal force of [75] stays positive.
  bool loaded = true;  // the leg starts on the ground
  add_push(record, sum.loaded, *x, [&](std::size_t i) {
    if (i < record.first_row() || i > record.last_row()) return false;
    loaded = record.stance()[i] > 0 || (loaded && (*normal)[i] > 0);
    return loaded;
  });
}

void add_motion(Series& out, const Record& record, const robot::Trolley& trolley,
                const Column& push, const std::string& topic, const std::string& what) {
  TrolleyMotion motion =
      integrate(push, record.run(), trolley.drag, trolley.total_mass, record.first_row());
  out.scalar(topic + "/position", "m", what, [&] { return std::move(motion.position); });
  out.scalar(topic + "/velocity", "m/s", what, [&] { return std::move(motion.velocity); });
}

void add_trolley(Series& out, const Record& record, const Machine& m, const Pushes& push) {
  const robot::Trolley& trolley = m.robot.trolley;
  if (!out.wants_pushes() || !trolley.present || !(trolley.total_mass > 0) || push.loaded.empty())
    return;
  add_motion(out, record, trolley, push.by_plan, "/trolley/by_plan",
             "of /foot/force in stance by plan, and drag");
  add_motion(out, record, trolley, push.loaded, "/trolley",
             "of /foot/force until the foot is unloaded, and drag");
}

void add_slip(Series& out, const Record& record, const Machine& m) {
  if (!out.wants("/true/foot/slip")) return;
  std::array<Column, 2> angle, rate;
  for (std::size_t j = 0; j < 2; ++j) {
    const std::string at = "/true/joint/" + m.robot.joints[j].name;
    angle[j] = record.column(at + "/angle");
    rate[j] = record.column(at + "/velocity");
  }
  Column trolley = record.column("/true/trolley/velocity");
  if (!m.robot.trolley.present) {
    trolley = record.new_column();
    trolley.assign(record.rows(), 0.0);
  }
  const robot::TwoLinks links = robot::two_links(m.robot);
  const auto slip = [&](std::size_t i) {
    return slip_velocity(links, {angle[0][i], angle[1][i]}, {rate[0][i], rate[1][i]},
                         m.robot.foot.radius, trolley[i]);
  };
  out.scalar("/true/foot/slip", "m/s", "of the foot's lowest point along the ground",
             [&] { return rowwise(record, slip, angle[0], angle[1], rate[0], rate[1], trolley); });
}

// Adds the series of one leg, without those of the trolley.
void add_one(Series& out, const Record& record, const Machine& machine) {
  for (std::size_t j = 0; j < machine.robot.joints.size(); ++j) add_joint(out, record, machine, j);
  add_passive(out, record, machine);
  if (has_leg(machine)) add_leg(out, record, machine);
}

}  // namespace

signals::Table derive(const signals::Table& table, const Machine& machine, const TopicNames* wanted,
                      TopicNames* read) {
  if (machine.stand) return {};
  const Record record(table, machine, nullptr, "", read);
  Series out(record, wanted);
  Pushes pushes;
  const auto add = [&](Series& series, const Record& its, const Machine& leg) {
    add_one(series, its, leg);
    if (has_leg(leg)) add_pushes(series, its, pushes);
  };
  std::vector<MachineLeg> legs = legs_of(machine);
  if (legs.empty()) add(out, record, machine);
  for (const MachineLeg& leg : legs) {
    const Record its(table, leg.machine, nullptr, leg.name, read);
    Series series(its, wanted, leg.name);
    add(series, its, leg.machine);
    if (has_leg(leg.machine)) add_slip(series, its, leg.machine);
    std::ranges::move(series.table.series, std::back_inserter(out.table.series));
  }
  add_trolley(out, record, machine, pushes);
  if (legs.empty() && has_leg(machine)) add_slip(out, record, machine);
  out.table.complete = table.complete;
  return std::move(out.table);
}

}  // namespace sinew::analysis
