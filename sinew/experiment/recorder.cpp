#include "sinew/experiment/recorder.h"

#include <algorithm>
#include <cmath>

namespace sinew::experiment {

using signals::Tick;
using signals::Topic;

namespace {

Topic scalar(std::string name, std::string unit, std::string description) {
  return {std::move(name), std::move(description), {{"value", std::move(unit)}}};
}

Topic vector(std::string name, std::string unit, std::string description) {
  return {std::move(name), std::move(description), {{"x", unit}, {"y", unit}}};
}

// What hardware would log as well, joint by joint.
void joint_topics(const robot::Joint& joint, std::vector<Topic>& out) {
  const std::string at = "/joint/" + joint.name, want = "/desired/joint/" + joint.name;
  out.push_back(scalar(at + "/angle", "rad", "measured, by the controller's scale"));
  out.push_back(scalar(at + "/stiffness", "N m/rad", "as the controller believes it, [27], [60]"));
  out.push_back(scalar(want + "/angle", "rad", "desired by the brain"));
  out.push_back(scalar(want + "/stiffness", "N m/rad", "desired by the brain"));
}

void muscle_topics(const robot::Muscle& muscle, std::vector<Topic>& out) {
  const std::string at = "/muscle/" + muscle.name;
  out.push_back(scalar(at + "/tension", "N", "measured, by its own transducer's scale; clips"));
  out.push_back(scalar(at + "/inlet_duty", "1", "commanded share of the period"));
  out.push_back(scalar(at + "/exhaust_duty", "1", "commanded share of the period"));
}

void plan_topics(std::vector<Topic>& out) {
  out.push_back(scalar("/plan/phase", "1", "position in the experiment's phases; -1 outside"));
  out.push_back(scalar("/plan/step", "1", "counts from 0"));
  out.push_back(scalar("/plan/unreachable", "1", "1 while the nearest reachable point is held"));
  out.push_back(vector("/desired/foot/position", "m", "about the first joint; none: not a number"));
}

void true_topics(const robot::Robot& robot, std::vector<Topic>& out) {
  for (const robot::Joint& j : robot.joints) {
    out.push_back(scalar("/true/joint/" + j.name + "/angle", "rad", "of the simulated joint"));
    out.push_back(scalar("/true/joint/" + j.name + "/velocity", "rad/s", "of the simulated joint"));
    out.push_back(scalar("/true/joint/" + j.name + "/torque", "N m", "of its muscles"));
  }
  for (const robot::Muscle& m : robot.muscles) {
    const std::string at = "/true/muscle/" + m.name;
    out.push_back(scalar(at + "/tension", "N", "at the cord"));
    out.push_back(scalar(at + "/pressure", "Pa", "absolute"));
    out.push_back(scalar(at + "/length", "m", "of the actuators"));
    out.push_back(scalar(at + "/mass", "kg", "of the air in the bundle"));
    out.push_back(scalar(at + "/air_in", "kg", "from the supply since the start"));
    out.push_back(scalar(at + "/air_out", "kg", "to the atmosphere since the start"));
  }
  if (robot.trolley.present) {
    out.push_back(scalar("/true/trolley/position", "m", "along the track"));
    out.push_back(scalar("/true/trolley/velocity", "m/s", "along the track"));
  }
  if (!robot.foot.present) return;
  out.push_back(vector("/true/foot/position", "m", "of the ankle, about the first joint"));
  out.push_back(vector("/true/foot/force", "N", "on the foot, by the ground"));
}

}  // namespace

std::vector<Topic> topics(const robot::Robot& robot) {
  std::vector<Topic> out;
  for (const robot::Sensor& s : robot.sensors)
    out.push_back(scalar("/sensor/" + s.name + "/count", "count", "as converted"));
  for (const robot::Joint& j : robot.joints) joint_topics(j, out);
  for (const robot::Muscle& m : robot.muscles) muscle_topics(m, out);
  plan_topics(out);
  true_topics(robot, out);
  for (const robot::Muscle& m : robot.muscles)
    for (const char* which : {"inlet", "exhaust"})
      out.push_back(scalar("/valve/" + m.name + "/" + which + "/open", "1",
                           "electrical edges: 1 opens, 0 shuts"));
  return out;
}

Recorder::Recorder(const Experiment& e, const control::Spine& spine, HighLevel& high_level,
                   TruthAt truth, Tick end)
    : robot_(e.robot), spine_(spine), high_(high_level), truth_(std::move(truth)) {
  // Sample where the last law of a period has run; other periods keep that offset.
  period_ = std::max<Tick>(1, std::llround(e.log.period / signals::tick_seconds));
  const Tick scan = spine.scan().period;
  next_ = period_ % scan == 0 ? spine.scan().conversions.back().read : 0;

  for (std::size_t m = 0; m < robot_.muscles.size(); ++m) {
    const int s = robot::tension_sensor_of(robot_, static_cast<int>(m));
    const robot::Sensor& sensor = robot_.sensors[static_cast<std::size_t>(s)];
    true_newtons_per_count_.push_back(1.0 / (sensor.scale * robot_.converter.counts_per_volt()));
    const int joint = robot::find_joint(robot_, robot_.muscles[m].joint);
    joint_of_.push_back(static_cast<std::size_t>(joint));
  }

  // What a row holds; without a truth the topics under /true have no samples.
  topics_ = topics(robot_);
  first_edge_ = topics_.size() - 2 * robot_.muscles.size();
  for (std::size_t i = 0; i < first_edge_; ++i)
    if (truth_ || !topics_[i].name.starts_with("/true/")) width_ += topics_[i].fields.size();

  // Room for everything that can come: samples, and four edges per valve and period.
  const auto samples = static_cast<std::size_t>(end / period_ + 2);
  rows_.reserve(samples * width_);
  row_time_ns_.reserve(samples);
  edges_.reserve(4 * 2 * robot_.muscles.size() * static_cast<std::size_t>(end / scan + 2));
}

void Recorder::command(Tick t) noexcept {
  if (progress_) progress_->store(t, std::memory_order_relaxed);
}

// The numbers of the topic at the cursor.
void Recorder::put(std::span<const double> values) noexcept {
  rows_.insert(rows_.end(), values.begin(), values.end());
  if (tap_.push && tapped_[cursor_] != not_tapped)
    tap_.push(tap_.object, tapped_[cursor_], now_ns_, values);
  ++cursor_;
}

void Recorder::edge(const signals::Edge& edge) noexcept {
  if (edges_.size() == edges_.capacity()) {
    complete_ = false;
    return;
  }
  edges_.push_back(edge);
  const std::size_t topic = first_edge_ + edge.valve.index;
  const double open = edge.open ? 1.0 : 0.0;
  if (tap_.push && tapped_[topic] != not_tapped)
    tap_.push(tap_.object, tapped_[topic], edge.at * signals::tick_nanoseconds, {&open, 1});
}

signals::Table Recorder::take() {
  signals::Table table;
  table.complete = complete_;
  std::size_t column = 0;  // of a row
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    signals::Series s{std::move(topics_[i]), {}, {}};
    s.columns.resize(s.topic.fields.size());
    if (i < first_edge_ && column < width_) {
      s.time_ns = row_time_ns_;
      for (std::vector<double>& values : s.columns) {
        values.reserve(row_time_ns_.size());
        for (std::size_t at = column; at < rows_.size(); at += width_) values.push_back(rows_[at]);
        ++column;
      }
    }
    table.series.push_back(std::move(s));
  }
  for (const signals::Edge& edge : edges_) {
    signals::Series& s = table.series[first_edge_ + edge.valve.index];
    s.time_ns.push_back(edge.at * signals::tick_nanoseconds);
    s.columns[0].push_back(edge.open ? 1.0 : 0.0);
  }
  return table;
}

void Recorder::sample(Tick t) noexcept {
  if (t < next_) return;
  next_ += period_;
  if (rows_.capacity() - rows_.size() < width_) {
    complete_ = false;
    return;
  }
  row_time_ns_.push_back(t * signals::tick_nanoseconds);
  now_ns_ = t * signals::tick_nanoseconds;
  cursor_ = 0;
  high_.believe(spine_.seen());
  record_joints();
  record_muscles();
  record_plan();
  if (truth_) record_truth(truth_(t));
}

void Recorder::record_joints() noexcept {
  const control::Seen& seen = spine_.seen();
  const auto one = [&](double value) { put({&value, 1}); };
  for (std::size_t s = 0; s < robot_.sensors.size(); ++s) one(seen.reading[s].counts);
  const gait::Desired& desired = high_.brain().desired();
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    one(high_.measured().angle[j]);
    one(high_.measured().stiffness[j]);
    one(desired.joint[j].angle);
    one(desired.joint[j].stiffness);
  }
}

// Duties as they count: none while a joint is disabled or no law runs.
void Recorder::record_muscles() noexcept {
  const control::Seen& seen = spine_.seen();
  const auto one = [&](double value) { put({&value, 1}); };
  for (std::size_t m = 0; m < robot_.muscles.size(); ++m) {
    const std::size_t j = joint_of_[m];
    const bool active = seen.joint[j].enabled && seen.phase == control::Phase::running;
    const control::Duties& d = seen.joint[j].duties;
    const bool flexor = robot_.muscles[m].role == robot::Muscle::Role::flexor;
    one(high_.measured().tension[m] / high_.newtons_per_count(m) * true_newtons_per_count_[m]);
    one(active ? 0.01 * (flexor ? d.flexor_inlet : d.extensor_inlet) : 0.0);
    one(active ? 0.01 * (flexor ? d.flexor_exhaust : d.extensor_exhaust) : 0.0);
  }
}

void Recorder::record_plan() noexcept {
  const gait::Desired& d = high_.brain().desired();
  const auto one = [&](double value) { put({&value, 1}); };
  one(d.phase);
  one(d.step);
  one(d.unreachable ? 1.0 : 0.0);
  const double none = std::nan("");
  const double foot[2] = {d.has_foot ? d.foot.x : none, d.has_foot ? d.foot.y : none};
  put(foot);
}

void Recorder::record_truth(const plant::Truth& truth) noexcept {
  const auto one = [&](double value) { put({&value, 1}); };
  for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
    one(truth.angle[j]);
    one(truth.rate[j]);
    one(truth.torque[j]);
  }
  for (std::size_t m = 0; m < robot_.muscles.size(); ++m) {
    one(truth.tension[m]);
    one(truth.pressure[m]);
    one(truth.length[m]);
    one(truth.mass[m]);
    one(truth.air_in[m]);
    one(truth.air_out[m]);
  }
  if (robot_.trolley.present) {
    one(truth.x);
    one(truth.x_rate);
  }
  if (!robot_.foot.present) return;
  const double position[2] = {truth.foot_x, truth.foot_y},
               force[2] = {truth.force_x, truth.force_y};
  put(position);
  put(force);
}

}  // namespace sinew::experiment
