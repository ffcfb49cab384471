// Figures of the run itself, trolley.*, foot.* and ground_reaction.*.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/foot.h"
#include "sinew/analysis/measures/laws.h"
#include "sinew/analysis/measures/statistics.h"

namespace sinew::analysis {
namespace {

struct Travel {
  double distance = no_figure;  // [m]
  double time = no_figure;      // [s]
};

// Returns the row at which the trolley reaches the track's end, or else the sequence's end.
std::size_t stop_row(const Figures& f, const Column& x) {
  const std::size_t end = f.record.end_row();
  for (std::size_t i = f.record.first_row(); i < end && i < x.size(); ++i)
    if (x[i] >= f.machine.robot.trolley.track_length) return i;
  return end;
}

// Returns the travel over the sequence, or up to the track's end.
Travel travel(const Figures& f) {
  const Column x = f.record.column("/true/trolley/position");
  if (x.empty() || !f.record.has_sequence()) return {};
  const std::size_t first = f.record.first_row(), end = stop_row(f, x);
  return {.distance = x[end] - x[first], .time = f.record.time(end) - f.record.time(first)};
}

// Returns the time from the sequence's start until the trolley reached the track's end  [s]; NaN if
// it did not.
double stop_reached(const Figures& f) {
  const Column x = f.record.column("/true/trolley/position");
  if (x.empty() || !f.record.has_sequence() || f.machine.robot.trolley.track_length <= 0)
    return no_figure;
  const std::size_t stop = stop_row(f, x);
  if (stop == f.record.end_row()) return no_figure;
  return f.record.time(stop) - f.record.sequence_start();
}

// Returns the complete steps but the first, up to the track's end.
std::vector<int> repeated_steps(const Figures& f) {
  std::vector<int> steps = f.record.complete_steps();
  if (!steps.empty()) steps.erase(steps.begin());
  if (!f.machine.robot.trolley.present || !f.record.has_sequence()) return steps;
  const std::size_t stop = stop_row(f, f.record.column("/true/trolley/position"));
  for (const PhaseSpan& s : f.record.phase_spans())
    if (s.last > stop) std::erase(steps, s.step);
  return steps;
}

// Paths of steps, each phase sampled at the same fractions of its duration.
class StepPaths {
 public:
  StepPaths(const Record& record, const Column& x, const Column& y)
      : record_(record), x_(x), y_(y) {
    in_order_ = std::ranges::is_sorted(record.phase_spans(), {}, &PhaseSpan::step);
  }

  Path of(int step) const {
    Path out;
    const auto& all = record_.phase_spans();
    const auto first = std::ranges::lower_bound(all, step, {}, &PhaseSpan::step);
    for (auto at = in_order_ ? first : all.begin(); at != all.end(); ++at) {
      const PhaseSpan s = *at;
      if (s.step == step)
        add(s, out);
      else if (in_order_)
        break;
    }
    return out;
  }

 private:
  void add(const PhaseSpan& s, Path& out) const {
    const auto px = at_progress(x_, s.first, s.last, points_per_phase);
    const auto py = at_progress(y_, s.first, s.last, points_per_phase);
    for (std::size_t k = 0; k < px.size(); ++k) out.push_back({px[k], py[k]});
  }

  const Record& record_;
  const Column& x_;
  const Column& y_;
  bool in_order_ = false;
};

// Returns the weight of each point of a path: the duration of its phase in the first step that is
// compared [s].
std::vector<double> point_weights(const Record& record, const std::vector<int>& steps) {
  std::vector<double> out;
  for (const PhaseSpan& s : record.phase_spans())
    if (!steps.empty() && s.step == steps.front())
      out.insert(out.end(), points_per_phase, record.lasting(s));
  return out;
}

double step_repeat(const Figures& f, const std::string& topic) {
  const Column x = f.record.column(topic, "x"), y = f.record.column(topic, "y");
  if (x.empty() || y.empty()) return no_figure;
  const std::vector<int> steps = repeated_steps(f);
  const StepPaths paths(f.record, x, y);
  return repeat_rms(
      steps.size(), [&](std::size_t i) { return paths.of(steps[i]); },
      point_weights(f.record, steps));
}

// Returns the distance of the foot from its desired position in each row [m].
Column foot_error(const Record& record) {
  const Column x = record.column("/foot/position", "x"), y = record.column("/foot/position", "y");
  const Column wx = record.column("/desired/foot/position", "x");
  const Column wy = record.column("/desired/foot/position", "y");
  if (x.empty() || y.empty() || wx.empty() || wy.empty()) return {};
  Column out = record.new_column();
  for (std::size_t i = 0; i < record.rows(); ++i)
    out.push_back(std::hypot(x[i] - wx[i], y[i] - wy[i]));
  return out;
}

// Contact of the foot with the ground in each row; both are 0 while it is off the ground.
struct Contact {
  Column sticks, slides;  // 1 while it sticks, else 0 [-]; |slip velocity| [m/s]
};

Contact contact(const Record& record) {
  const Column normal = record.column("/true/foot/force", "y");
  const Column slip = record.column("/true/foot/slip");
  if (normal.empty() || slip.empty()) return {};
  Contact out{record.new_column(), record.new_column()};
  for (std::size_t i = 0; i < record.rows(); ++i) {
    const bool stands = normal[i] > 0;
    const double speed = std::abs(slip[i]);
    out.sticks.push_back(stands && speed < sticking ? 1.0 : 0.0);
    out.slides.push_back(stands ? speed : 0.0);
  }
  return out;
}

void add_stick(Figures& f) {
  if (!f.wants("foot.stick_") && !f.wants("foot.slip_per_step_m")) return;
  const Contact c = contact(f.record);
  if (c.sticks.empty()) return;
  const int propulsion = find_phase(f.machine, "propulsion");
  if (propulsion >= 0) {
    f.summary.add("foot.stick_share_first_half_propulsion",
                  mean(c.sticks, f.record.part(propulsion, 0.0, 0.5)));
    f.summary.add("foot.stick_share_propulsion",
                  mean(c.sticks, f.record.part(propulsion, 0.0, 1.0)));
  }
  double sum = 0;
  for (std::size_t i = 0; i < c.slides.size(); ++i)
    if (f.record.stance()[i] > 0 && std::isfinite(c.slides[i]))
      sum += c.slides[i] * f.record.stance()[i];
  const double steps = extent_of(f).steps;
  f.summary.add("foot.slip_per_step_m", steps > 0 ? sum / steps : no_figure);
}

// Returns the end of the hold after the kick, or of the kick itself at the sequence's end.
std::size_t end_of_hold(const Record& record, const PhaseSpan& kick) {
  for (const PhaseSpan& s : record.phase_spans())
    if (s.first == kick.last) return s.last;
  return kick.last;
}

// Adds the figures of the kick of 6.4: the rise times of x from the retracted hold to the extended
// position, which is the desired one at the end of the next hold, and to the first peak of x, which
// may be later and beyond.
void add_kick(Figures& f) {
  if (!f.wants("foot.extension_")) return;
  const int kick = find_phase(f.machine, "kick");
  const std::optional<PhaseSpan> s = kick >= 0 ? f.record.last_of(kick) : std::nullopt;
  const Column x = f.record.column("/foot/position", "x");
  if (!s || x.empty()) return;
  const std::size_t end = end_of_hold(f.record, *s);
  const std::vector<double> moves = x.slice(s->first, end);
  const Column wanted = f.record.column("/desired/foot/position", "x");
  if (!wanted.empty())
    f.summary.add("foot.extension_time_s",
                  ten_to_ninety(moves, wanted[end - 1], f.record.period()));
  const Rise r = rise(moves, f.record.period());
  f.summary.add("foot.extension_time_to_peak_s", r.found ? r.partial : no_figure);
  f.summary.add("foot.extension_whole_time_s", r.found ? r.whole : no_figure);
}

struct Components {
  Column x, y;
  bool empty() const { return x.empty() || y.empty(); }
};

Components force(const Record& record, const std::string& topic) {
  return {record.column(topic, "x"), record.column(topic, "y")};
}

void add_force_errors(Figures& f, const Components& estimate, const Components& real) {
  Column both = f.record.new_column(), normal = f.record.new_column();
  for (std::size_t i = 0; i < f.record.rows(); ++i) {
    normal.push_back(estimate.y[i] - real.y[i]);
    both.push_back(std::hypot(estimate.x[i] - real.x[i], normal[i]));
  }
  const std::string key = "ground_reaction.";
  f.add(key + "estimate_rms_error_N", rms, both, f.record.stance());
  f.add(key + "estimate_rms_error_normal_N", rms, normal, f.record.stance());
  f.add(key + "estimate_mean_error_normal_N", mean, normal, f.record.stance());
}

}  // namespace

Extent extent_of(const Figures& f) {
  return {.steps = static_cast<double>(f.record.complete_steps().size()),
          .distance = travel(f).distance};
}

void add_rates(Figures& f, double amount, const std::string& per_step,
               const std::string& per_metre) {
  if (!f.wants(per_step) && !f.wants(per_metre)) return;
  const Extent extent = extent_of(f);
  f.summary.add(per_step, extent.steps > 0 ? amount / extent.steps : no_figure);
  f.summary.add(per_metre, extent.distance > 0 ? amount / extent.distance : no_figure);
}

void add_run(Figures& f) {
  const Record& r = f.record;
  f.summary.add("duration_s", r.lasting(0, r.rows() - 1));
  if (!r.has_sequence()) return;
  f.summary.add("sequence_duration_s", r.sequence_lasts());
  f.add("steps", [&] { return extent_of(f).steps; });
  f.add("unreachable_share", mean, "/plan/unreachable", r.sequence());
}

void add_trolley(Figures& f) {
  if (!f.wants("trolley.")) return;
  const Travel real = travel(f);
  f.summary.add("trolley.distance_m", real.distance);
  f.summary.add("trolley.mean_speed_m_per_s", real.distance / real.time);
  f.summary.add("trolley.stop_reached_s", stop_reached(f));
  f.add("trolley.peak_speed_m_per_s", largest, "/true/trolley/velocity", f.record.sequence());

  if (!f.record.has_sequence() || !f.machine.robot.ground.present) return;
  const auto from_torques = [&](const std::string& topic) {
    const Column x = f.record.column(topic);
    return x.empty() ? no_figure : x[f.record.end_row()];
  };
  f.add("trolley.distance_from_torques_m", [&] { return from_torques("/trolley/position"); });
  f.add("trolley.mean_speed_from_torques_m_per_s",
        [&] { return from_torques("/trolley/position") / f.record.sequence_lasts(); });
  f.add("trolley.distance_from_torques_by_plan_m",
        [&] { return from_torques("/trolley/by_plan/position"); });
}

void add_foot(Figures& f) {
  if (!has_leg(f.machine)) return;
  if (f.wants("foot.tracking_rms_m"))
    f.add("foot.tracking_rms_m", rms, foot_error(f.record), f.record.sequence());
  f.add("foot.step_repeat_rms_m", [&] { return step_repeat(f, "/foot/position"); });
  f.add("foot.step_repeat_true_rms_m", [&] { return step_repeat(f, "/true/foot/position"); });
  if (f.machine.robot.ground.present) add_stick(f);
  add_kick(f);
}

void add_ground_reaction(Figures& f) {
  const std::string key = "ground_reaction.";
  if (!f.wants(key) || !f.machine.robot.ground.present) return;
  const Column& stance = f.record.stance();
  const Components estimate = force(f.record, "/foot/force");
  const Components real = force(f.record, "/true/foot/force");
  f.add(key + "mean_normal_stance_N", mean, estimate.y, stance);
  f.add(key + "peak_normal_N", largest, estimate.y, stance);
  f.add(key + "peak_friction_N", largest, estimate.x, stance);
  f.add(key + "mean_normal_stance_true_N", mean, real.y, stance);
  f.add(key + "peak_normal_true_N", largest, real.y, stance);
  f.add(key + "peak_friction_true_N", largest, real.x, stance);
  if (!estimate.empty() && !real.empty()) add_force_errors(f, estimate, real);
}

}  // namespace sinew::analysis
