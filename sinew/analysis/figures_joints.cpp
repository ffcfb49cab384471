// Figures joints.<j>.* and phases.<p>.*: angles, tracking, stiffness, torque.

#include <algorithm>
#include <optional>
#include <string>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/statistics.h"
#include "sinew/analysis/record/legs.h"

namespace sinew::analysis {

namespace {

constexpr std::string_view relaxed = "relaxed";  // prefix of such a phase's name

// Returns the row at which the relaxed angle of a joint is taken; rows() if no row qualifies.
std::size_t relaxed_row(const Figures& f) {
  for (std::size_t i = f.record.phase_spans().size(); i-- > 0;) {
    const PhaseSpan s = f.record.phase_spans()[i];
    if (phase_name(f.machine, s.phase).substr(0, relaxed.size()) == relaxed) return s.last - 1;
  }

  // Settling leaves the exhausts open, and without a ground nothing else holds the joints.
  const bool settled = f.record.has_sequence() && f.record.first_row() > 0;
  if (settled && !f.machine.robot.ground.present) return f.record.first_row() - 1;
  return f.record.rows();
}

void add_angles(Figures& f, const std::string& joint, const std::string& key) {
  const Column& sequence = f.record.sequence();
  const std::string angle = "/joint/" + joint + "/angle", real = "/true" + angle;
  f.add(key + "min_angle_rad", smallest, angle, sequence);
  f.add(key + "max_angle_rad", largest, angle, sequence);
  f.add(
      key + "excursion_rad",
      [](const Column& values, const Column& seconds) {
        return largest(values, seconds) - smallest(values, seconds);
      },
      angle, sequence);
  f.add(key + "min_angle_true_rad", smallest, real, sequence);
  f.add(key + "max_angle_true_rad", largest, real, sequence);

  const std::size_t row = relaxed_row(f);
  const auto at_row = [&](const Column& values, const Column&) {
    return row < f.record.rows() ? values[row] : no_figure;
  };
  f.add(key + "relaxed_angle_rad", at_row, angle, sequence);
  f.add(key + "relaxed_angle_true_rad", at_row, real, sequence);
}

// Returns the swings of all steps but the first, which depends on how the machine was placed.
Column later_swings(const Figures& f) {
  const Column& swing = f.record.swing();
  Column out = f.record.new_column();
  for (const PhaseSpan& s : f.record.phase_spans()) {
    while (out.size() < s.first) out.push_back(swing[out.size()]);
    while (out.size() < s.last) out.push_back(s.step == 0 ? 0.0 : swing[out.size()]);
  }
  while (out.size() < swing.size()) out.push_back(swing[out.size()]);
  return out;
}

// Adds the change of the estimated velocity from row to row: a velocity gain turns it into valve
// pulses, 6.5.
void add_velocity_jumps(Figures& f, const std::string& joint, const std::string& key) {
  if (!f.wants(key + "velocity_jump_")) return;
  const Column velocity = f.record.column("/joint/" + joint + "/velocity_estimate");
  if (velocity.empty()) return;
  Column jump = f.record.new_column();
  for (std::size_t i = 0; i < velocity.size(); ++i)
    jump.push_back(i > 0 ? velocity[i] - velocity[i - 1] : no_figure);
  const Column& sequence = f.record.sequence();
  f.add(key + "velocity_jump_rms_rad_per_s", rms, jump, sequence);
  f.add(key + "velocity_jump_largest_rad_per_s", largest_magnitude, jump, sequence);
}

void add_control(Figures& f, const std::string& joint, const std::string& key) {
  const Column& sequence = f.record.sequence();
  const std::string at = "/joint/" + joint;
  f.add(key + "tracking_rms_rad", rms, at + "/error", sequence);
  const std::string oscillation = at + "/oscillation";
  f.add(key + "swing_oscillation_rms_rad", rms, oscillation, f.record.swing());
  if (const std::string later = key + "swing_oscillation_later_steps_rms_rad"; f.wants(later))
    f.add(later, rms, oscillation, later_swings(f));

  const std::string believed = at + "/stiffness", real = "/true" + believed;
  f.add(key + "stiffness_mean_Nm_per_rad", mean, believed, sequence);
  f.add(key + "stiffness_std_Nm_per_rad", deviation, believed, sequence);
  f.add(key + "stiffness_mean_true_Nm_per_rad", mean, real, sequence);
  f.add(key + "stiffness_std_true_Nm_per_rad", deviation, real, sequence);
  f.add(key + "peak_torque_Nm", largest_magnitude, at + "/torque", sequence);
  f.add(key + "peak_torque_true_Nm", largest_magnitude, "/true" + at + "/torque", sequence);
}

// Adds the value of a topic at a row.
void add_end_of(Figures& f, const std::string& key, const std::string& topic,
                std::string_view field, std::size_t row) {
  f.add(
      key, [&](const Column& values, const Column&) { return values[row]; }, topic,
      f.record.sequence(), field);
}

// Adds angles and pressures at the end of a phase.
void add_end(Figures& f, const std::string& key, std::size_t row) {
  const auto last = [&](const std::string& name, const std::string& topic) {
    add_end_of(f, key + name, topic, "value", row);
  };
  for (const robot::Joint& j : f.machine.robot.joints) {
    last("joints." + j.name + ".end_angle_rad", "/joint/" + j.name + "/angle");
    last("joints." + j.name + ".end_angle_true_rad", "/true/joint/" + j.name + "/angle");
  }
  for (const robot::Muscle& m : f.machine.robot.muscles)
    last("muscles." + m.name + ".end_pressure_Pa", "/true/muscle/" + m.name + "/pressure");
}

// Returns the mean duration over all occurrences of a phase  [s].
double mean_duration(const Record& record, int phase) {
  double sum = 0, n = 0;
  for (const PhaseSpan& s : record.phase_spans()) {
    if (s.phase != phase) continue;
    sum += record.lasting(s);
    ++n;
  }
  return sum / n;
}

// Turning points of a joint's error in all occurrences of a phase.
struct Turns {
  int times = 0, sum = 0, fewest = 0, most = 0;         // turning points
  double half_swings = 0, amplitudes = 0, largest = 0;  // their number, sum and largest [rad]
};

Turns turns_of(const Record& record, int phase, const Column& error) {
  Turns out;
  for (const PhaseSpan& s : record.phase_spans()) {
    if (s.phase != phase) continue;
    const auto points = turning_points(error.slice(s.first, s.last), least_return);
    const int n = static_cast<int>(points.size());
    out.sum += n;
    out.fewest = out.times > 0 ? std::min(out.fewest, n) : n;
    out.most = std::max(out.most, n);
    ++out.times;
    for (const double a : amplitudes(points)) {
      ++out.half_swings;
      out.amplitudes += a;
      out.largest = std::max(out.largest, a);
    }
  }
  return out;
}

void add_turns(Figures& f, const std::string& phase_key, int phase, const std::string& joint) {
  const std::string key = phase_key + "joints." + joint + ".";
  if (!f.wants(key)) return;
  const Column error = f.record.column("/joint/" + joint + "/error");
  if (error.empty()) return;
  const Turns turns = turns_of(f.record, phase, error);
  f.summary.add(key + "turning_points", turns.sum);
  f.summary.add(key + "fewest_turning_points", turns.times > 1 ? turns.fewest : no_figure);
  f.summary.add(key + "most_turning_points", turns.times > 1 ? turns.most : no_figure);
  f.summary.add(key + "oscillation_amplitude_rad",
                turns.half_swings > 0 ? turns.amplitudes / turns.half_swings : 0);
  f.summary.add(key + "largest_oscillation_amplitude_rad", turns.largest);
}

}  // namespace

void add_joints(Figures& f) {
  for (const robot::Joint& joint : f.machine.robot.joints) {
    const std::string key = "joints." + joint.name + ".";
    if (!f.wants(key)) continue;
    add_angles(f, joint.name, key);
    add_control(f, joint.name, key);
    add_velocity_jumps(f, joint.name, key);
    add_smallest_passiveness(f, key, joint.name);
  }
}

void add_phases(Figures& f) {
  for (std::size_t i = 0; i < f.machine.phases.size(); ++i) {
    const std::optional<PhaseSpan> span = f.record.last_of(static_cast<int>(i));
    if (!span) continue;
    const std::string key = "phases." + f.machine.phases[i] + ".";
    if (!f.wants(key)) continue;
    f.summary.add(key + "mean_duration_s", mean_duration(f.record, static_cast<int>(i)));
    add_end(f, key, span->last - 1);
    for (const robot::Joint& j : f.machine.robot.joints)
      add_turns(f, key, static_cast<int>(i), j.name);
    add_end_of(f, key + "foot.end_force_true_N", "/true/foot/force", "y", span->last - 1);
    add_end_of(f, key + "cylinder.end_position_true_m", "/true/cylinder/position", "value",
               span->last - 1);
  }
}

namespace {

// Adds the share of the sequence in which the ground carries the foot, and the load.
void add_load(Figures& f) {
  if (!f.wants("foot.") || !f.machine.robot.ground.present) return;
  const Column load = f.record.column("/true/foot/force", "y");
  if (load.empty()) return;
  Column loaded = f.record.new_column();
  for (const double newton : load) loaded.push_back(newton > 0 ? 1.0 : 0.0);
  f.add("foot.loaded_share_true", mean, loaded, f.record.sequence());
  f.add("foot.mean_load_true_N", mean, load, f.record.sequence());
}

}  // namespace

void add_legs(Figures& figures, const signals::Table& table, const signals::Table& derived,
              TopicNames* read) {
  for (const MachineLeg& leg : legs_of(figures.machine)) {
    const std::string prefix = "legs." + leg.name + ".";
    if (!figures.wants(prefix)) continue;
    const Record record(table, leg.machine, &derived, leg.name, read);
    Summary own;
    Figures f{leg.machine, record, own, figures.keys, prefix};
    add_joints(f);
    add_muscles(f);
    add_smallest_passiveness(f, "");
    add_foot(f);
    add_load(f);
    add_sole(f);
    add_ground_reaction(f);
    add_air(f);
    add_phases(f);
    for (const Entry& e : own.entries()) figures.summary.add(prefix + e.key, e.value);
  }
}

}  // namespace sinew::analysis
