// design/joint_method.cpp - `sinew design joint`: the set of feasible joints, and the choice.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "sinew/actuator/body.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/write/writer.h"
#include "sinew/design/joint.h"
#include "sinew/design/methods.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/actuator/static_predict.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/units/constants.h"
#include "sinew/units/quantity.h"

namespace sinew::design {

namespace {

constexpr double unknown = Value::unknown;
constexpr double max_lever_motion =
    150 * units::degree;  // its arm is then cos 75 deg of its length

// One feasible joint.
struct Candidate {
  JointDesign joint;
  double rest_length = unknown;  // [m]
  Stroke stroke;
  Weakest weakest;
  double motion = 0, air = 0, opposed = 0;  // [rad], [kg], [Pa]
};

JointTask task_of(const JointSettings& s, const config::SettingValues& values) {
  JointTask task;
  task.angles = values.of(s.angles);
  task.motion = values.given(s.motion).value_or(task.angles);
  if (task.motion < task.angles)
    config::refuse_setting("motion", config::in_quotes(s.motion),
                           "at least the angles, " + s.angles, "leaving it out");
  task.pressure = values.of(s.pressure);
  task.external_volume = values.of(s.external_volume);
  task.arm = s.arm == "lever" ? Arm::lever : Arm::cam;
  if (task.arm == Arm::lever && task.motion > max_lever_motion)
    config::refuse_setting(s.motion.empty() ? "angles" : "motion",
                           config::in_quotes(s.motion.empty() ? s.angles : s.motion),
                           "at most 150 deg with a lever, whose arm is zero at its dead points",
                           "a cam");
  if (s.torque.empty() == s.load.empty())
    config::refuse_setting("torque", s.torque.empty() ? "nothing" : "a load with it",
                           "a torque, or a load at a lever", R"(torque="2 N m")");
  if (!s.torque.empty()) task.torque = values.of(s.torque);
  for (const auto& [name, text] : {std::pair{"lever", s.lever}, {"time", s.time}})
    if (s.load.empty() && !text.empty())
      config::refuse_setting(name, "no load", "one with a load", R"(load="2 kg")");
  if (s.load.empty()) return task;
  if (s.lever.empty())
    config::refuse_setting("lever", "nothing", "the distance of the load", R"(lever="0.2 m")");
  const double mass = values.of(s.load), lever = values.of(s.lever);
  task.torque = mass * units::standard_gravity * lever;
  // A stroke that speeds up over one half and slows down over the other one: a = 4 A/t^2.
  if (const auto time = values.given(s.time))
    task.torque += mass * lever * lever * 4 * task.angles / (*time * *time);
  return task;
}

// Returns the muscles that are tried: the file's, or a family scaled from it.
std::vector<std::pair<double, actuator::Actuator>> family(const JointSettings& s,
                                                          const actuator::Actuator& a,
                                                          double atmosphere) {
  const double own = a.prediction.rest_length;
  if (s.rest_length.empty()) return {{own > 0 ? own : unknown, a}};
  std::vector<std::pair<double, actuator::Actuator>> out;
  for (const double length :
       config::range_setting("rest_length", s.rest_length, "m", atmosphere, part_length).si)
    out.emplace_back(length, identify::with_rest_length(a, length, atmosphere));
  return out;
}

std::vector<double> arms_of(const JointSettings& s, const JointTask& task, const Stroke& stroke) {
  if (!s.moment_arm.empty())
    return config::range_setting("moment_arm", s.moment_arm, "m", units::atmosphere, part_length)
        .si;
  const double half = task.motion / 2;
  const double most = (stroke.longest - stroke.shortest) / 2 /
                      (task.arm == Arm::cam ? half : std::sin(std::min(half, 1.5)));
  std::vector<double> out;
  for (int i = 1; i <= 12; ++i) out.push_back(most * i / 12);
  return out;
}

// The best of all candidates, which a refusal reports.
struct Nearest {
  double share = 0;   // largest torque of all candidates / the torque of the task
  double motion = 0;  // largest range of motion [rad]
  int count = 0;
};

std::vector<Candidate> candidates(const JointSettings& s, const JointTask& task,
                                  const actuator::Actuator& own, const gas::Air& air,
                                  Nearest& nearest) {
  std::vector<Candidate> out;
  for (const auto& [rest_length, a] : family(s, own, air.atmosphere)) {
    const Stroke stroke = stroke_of(a, task.pressure, air.atmosphere);
    for (const double arm : arms_of(s, task, stroke)) {
      JointDesign one{a, 1, arm, 0};
      one.mount_length = 0.5 * (stroke.shortest + stroke.longest);
      nearest.motion = std::max(nearest.motion, motion_of(one, task.arm, stroke));
      one.mount_length = best_mount_length(one, task, stroke, air.atmosphere);
      if (!std::isfinite(one.mount_length)) continue;
      const double single = weakest_torque(one, task, 0, air.atmosphere).torque.value;
      nearest.share = std::max(nearest.share, s.most * single / task.torque);
      if (!(single > 0)) continue;
      const double least = std::ceil(task.torque / single * (1 - 1e-12));
      for (int count = static_cast<int>(std::min<double>(least, s.most + 1)); count <= s.most;
           ++count) {
        Candidate c{.joint = one, .rest_length = rest_length, .stroke = stroke};
        c.joint.count = count;
        c.weakest = weakest_torque(c.joint, task, 0, air.atmosphere);
        c.motion = motion_of(c.joint, task.arm, stroke);
        c.air = air_of_stroke(c.joint, task, air);
        c.opposed = co_contraction_left(c.joint, task, air.atmosphere);
        out.push_back(std::move(c));
      }
    }
  }
  std::ranges::stable_sort(out, [](const Candidate& a, const Candidate& b) {
    return std::pair(a.joint.count, a.air) < std::pair(b.joint.count, b.air);
  });
  return out;
}

// Returns the candidate with the fewest muscles whose whole interval has the torque; without an
// interval, or if none has, the first one.
const Candidate& choice(const std::vector<Candidate>& all, const JointTask& task) {
  const auto sure = std::ranges::find_if(
      all, [&](const Candidate& c) { return c.weakest.torque.low >= task.torque; });
  return sure == all.end() ? all.front() : *sure;
}

std::string what_limits(const Candidate& c, const JointTask& task) {
  JointDesign middle = c.joint;
  middle.mount_length = 0.5 * (c.stroke.shortest + c.stroke.longest);
  if (motion_of(middle, task.arm, c.stroke) <= task.motion * 1.1)
    return "range of motion: the arm cannot be much longer";
  if (c.weakest.angle >= 0.49 * task.angles) return "torque where the muscle is short";
  if (c.weakest.angle <= -0.49 * task.angles) return "torque where the muscle is long";
  return fmt::format("torque at {:.3g} deg from the middle", c.weakest.angle / units::degree);
}

void add_values(Result& out, const Candidate& c, const JointTask& task, const gas::Air& air) {
  const JointDesign& j = c.joint;
  const double percent = task.torque;
  const auto add = [&](Value v) { out.values.push_back(std::move(v)); };
  add({"torque_wanted_Nm", "torque that is needed", task.torque, "N m", unknown, unknown,
       "at each angle, both directions"});
  add({"count", "muscles side by side", static_cast<double>(j.count), "1"});
  if (std::isfinite(c.rest_length))
    add({"rest_length_m", "rest length of a muscle", c.rest_length, "m"});
  add({"moment_arm_m", "moment arm", j.moment_arm, "m"});
  add({"mount_length_m", "length at the middle", j.mount_length, "m", unknown, unknown,
       "both muscles"});
  add({"torque_Nm", "weakest torque", c.weakest.torque.value, "N m", c.weakest.torque.low,
       c.weakest.torque.high,
       fmt::format("at {:.3g} deg from the middle{}", c.weakest.angle / units::degree,
                   std::isnan(c.weakest.torque.low) ? "" : "; interval of the force: 95 %")});
  add({"torque_margin", "torque margin", c.weakest.torque.value / percent - 1, "1",
       c.weakest.torque.low / percent - 1, c.weakest.torque.high / percent - 1});
  add({"motion_rad", "range of motion", c.motion, "rad", unknown, unknown, "without a load"});
  const Stroke& stroke = c.stroke;
  add({"widest_motion_mount_length_m", "length at the middle for the largest range",
       0.5 * (stroke.shortest + stroke.longest), "m", unknown, unknown, "half the stroke"});
  JointDesign middle = j;
  middle.mount_length = 0.5 * (stroke.shortest + stroke.longest);
  add({"widest_motion_rad", "largest range of motion", motion_of(middle, task.arm, stroke), "rad"});
  add({"stiffness_low_Nm_per_rad", "stiffness at the middle, vented",
       stiffness_at_middle(j, 0, air.atmosphere), "N m/rad", unknown, unknown, "bladder and ends"});
  add({"stiffness_high_Nm_per_rad", "stiffness at the middle, both at the pressure",
       stiffness_at_middle(j, task.pressure, air.atmosphere), "N m/rad", unknown, unknown,
       "pressure held"});
  add({"co_contraction_left_Pa", "co-contraction left", c.opposed, "Pa gauge", unknown, unknown,
       "pressure of the opposing muscle at which the torque is just reached"});
  add({"air_per_stroke_kg", "air of one stroke", c.air, "kg", unknown, unknown,
       "muscle filled from vented, at room temperature"});
  add({"volume_m3", "largest volume of one muscle",
       j.count * actuator::volume(j.actuator, length_at(j, task.arm, task.angles / 2)) +
           task.external_volume,
       "m3", unknown, unknown, "side by side, with hose"});
}

Table table_of(const std::vector<Candidate>& all, const JointTask& task) {
  Table out{"designs",
            "Feasible designs, fewest muscles and least air first",
            {{"count", "count"},
             {"rest_length_m", "rest", "m"},
             {"moment_arm_m", "arm", "m"},
             {"mount_length_m", "mount", "m"},
             {"torque_margin", "margin"},
             {"torque_margin_low", "margin from"},
             {"motion_rad", "motion", "rad"},
             {"co_contraction_left_Pa", "opposed", "Pa gauge"},
             {"air_per_stroke_kg", "air", "kg"},
             {"limit", "limited by"}},
            {}};
  for (const Candidate& c : all)
    out.rows.push_back({static_cast<double>(c.joint.count), c.rest_length, c.joint.moment_arm,
                        c.joint.mount_length, c.weakest.torque.value / task.torque - 1,
                        c.weakest.torque.low / task.torque - 1, c.motion, c.opposed, c.air,
                        what_limits(c, task)});
  return out;
}

// Returns the torque over the angles of motion, with its interval and the torque that is needed.
report::Plot torque_plot(const Candidate& c, const JointTask& task, double atmosphere) {
  report::Plot out{.name = "torque",
                   .title = "Torque over the range of motion",
                   .x = {"angle from the middle", "rad"},
                   .y = {"torque", "N m"}};
  report::Curve torque{.label = "one muscle at the pressure", .bold = true};
  report::Curve band{
      .label = "95 % interval of the force", .style = report::Curve::Style::band, .color = 6};
  report::Curve need{.label = "needed", .kind = report::Curve::Kind::desired, .color = 1};
  constexpr int steps = 60;
  for (int i = 0; i <= steps; ++i) {
    const double angle = c.motion * (static_cast<double>(i) / steps - 0.5);
    const Torque t = torque_at(c.joint, task, angle, task.pressure, 0, atmosphere);
    torque.xs.push_back(angle), torque.ys.push_back(t.value);
    if (std::isfinite(t.low))
      band.xs.push_back(angle), band.ys.push_back(t.low), band.ys_high.push_back(t.high);
  }
  for (const double side : {-0.5, 0.5})
    need.xs.push_back(side * task.angles), need.ys.push_back(task.torque);
  if (!band.xs.empty()) out.curves.push_back(band);
  out.curves.push_back(torque);
  out.curves.push_back(need);
  return out;
}

report::Plot margin_plot(const std::vector<Candidate>& all, const JointTask& task) {
  report::Plot out{.name = "margin",
                   .title = "Torque margin of all feasible designs",
                   .x = {"moment arm", "m"},
                   .y = {"torque margin", "-"}};
  int color = 0;
  for (int count = 1; count <= 100; ++count) {
    report::Curve one{.label = fmt::format("{} side by side", count),
                      .style = report::Curve::Style::points,
                      .color = color};
    for (const Candidate& c : all)
      if (c.joint.count == count)
        one.xs.push_back(c.joint.moment_arm),
            one.ys.push_back(c.weakest.torque.value / task.torque - 1);
    if (one.xs.empty()) continue;
    out.curves.push_back(std::move(one));
    ++color;
  }
  return out;
}

// Returns the robot's file over `base`: the joint with this arm, and its two muscles.
std::string robot_file(const JointSettings& s, const Candidate& c, double external_volume,
                       const std::string& out) {
  namespace fs = std::filesystem;
  const experiment::MachineFile base = experiment::load_machine_file(s.base);
  const robot::Robot& robot = base.experiment.robot;
  const robot::Joint& joint = config::named(robot.joints, s.joint, "joint", "joint", s.base);
  const std::string source = fmt::format("sinew design joint with {}", s.actuator);
  // Each value has its own source: one of the table would replace that of the base's values.
  const auto put_sourced = [&](config::Node& table, std::string_view key, config::Node value) {
    config::Node sourced = config::make_table(key);
    sourced.put(std::move(value));
    sourced.put(config::make_text("source", source));
    table.put(std::move(sourced));
  };
  const auto put = [&](config::Node& table, std::string_view key, double value, const char* unit) {
    put_sourced(table, key,
                config::make_text("value", units::format_quantity(value, unit, unit, 10)));
  };
  config::Node joints = config::make_table("joint"), one = config::make_table(joint.name);
  put(one, "moment_arm", c.joint.moment_arm, "m");
  joints.put(one);
  config::Node muscles = config::make_table("muscle");
  for (const robot::Muscle& m : robot.muscles) {
    if (m.joint != joint.name || !m.second.joint.empty()) continue;
    config::Node muscle = config::make_table(m.name);
    muscle.put(config::make_text("actuator", c.joint.actuator.name));
    put_sourced(muscle, "count", config::make_integer("value", c.joint.count));
    put(muscle, "mount_length", c.joint.mount_length, "m");
    put(muscle, "external_volume", external_volume, "m3");
    const actuator::Bladder& bladder = c.joint.actuator.bladder;
    if (std::isfinite(m.bladder_stiffness))
      put(muscle, "bladder_stiffness", bladder.stiffness, "N/m");
    if (std::isfinite(m.bladder_rest_length))
      put(muscle, "bladder_rest_length", bladder.rest_length, "m");
    muscles.put(muscle);
  }
  if (muscles.children.size() != 2)
    config::refuse_setting("joint",
                           fmt::format("{} muscles of this joint alone", muscles.children.size()),
                           "a flexor and an extensor");
  config::Node root = identify::robot_over(s.base, out);
  config::Node files = config::make_table("files");
  files.put(config::make_text(
      "actuator", fs::absolute(s.actuator).lexically_relative(fs::absolute(out).parent_path())));
  root.put(files);
  root.put(joints);
  root.put(muscles);
  return config::to_toml(root);
}

std::string refusal(const Nearest& nearest, const JointTask& task, const JointSettings& s) {
  if (nearest.motion < task.motion)
    return fmt::format(
        "no design: the largest range of motion is {:.3g} deg with these arms, {:.3g} deg are "
        "needed; try a shorter arm or a longer muscle",
        nearest.motion / units::degree, task.motion / units::degree);
  const double enough = nearest.share > 0 ? std::ceil(s.most / nearest.share) : 1e9;
  return fmt::format(
      "no design: {} side by side reach {:.3g} of {:.3g} N m at the weakest angle; try {}a higher "
      "pressure, a smaller range of angles or a longer muscle",
      s.most, std::max(nearest.share, 0.0) * task.torque, task.torque,
      enough <= 100 ? fmt::format("most={:.0f}, ", enough) : "");
}

// Adds warnings of what the interval of the torque does not show, or of a torque within it.
void add_doubts(Result& out, const Candidate& best, const JointTask& task) {
  const actuator::Prediction& p = best.joint.actuator.prediction;
  const double low = best.weakest.torque.low;
  if (!(p.inside_95 > 0)) {
    out.warnings.emplace_back(
        "the actuator's file has no interval of its force: the margin has none");
  } else if (std::isnan(low)) {
    out.warnings.push_back(
        fmt::format("the interval of the force is unknown at some angles: the muscle was measured "
                    "at {:.4g} to "
                    "{:.4g} mm and up to {:.4g} bar gauge; the margin has none",
                    1e3 * p.lengths.front(), 1e3 * p.lengths.back(), 1e-5 * p.highest));
  } else if (low < task.torque) {
    const double enough = low > 0 ? std::ceil(best.joint.count * task.torque / low) : 1e9;
    out.warnings.push_back(
        "the torque that is needed is within the 95 % interval of the weakest torque; " +
        (enough <= 100 ? fmt::format("with {:.0f} side by side it would be below", enough)
                       : std::string("more muscles of this law do not make it sure")));
  }
}

}  // namespace

Result design(const JointSettings& s) {
  const experiment::MachineFile file = experiment::load_machine_file(s.actuator);
  const gas::Air& air = file.experiment.air;
  const config::SettingValues values(s, air.atmosphere);
  const actuator::Actuator& own =
      config::named(file.experiment.actuators, s.name, "name", "actuator", s.actuator);
  const JointTask task = task_of(s, values);
  Nearest nearest;
  const std::vector<Candidate> all = candidates(s, task, own, air, nearest);
  Result out{.method = "joint",
             .title = fmt::format("a joint of {:.4g} N m over {:.3g} deg with muscles `{}`",
                                  task.torque, task.angles / units::degree, own.name)};
  out.unseen = {"Friction of the joint and the weight of its limb: add them to the torque.",
                "Tendons that stretch, a muscle that touches the limb, cams that it leaves.",
                "How fast the joint moves: see `sinew design valve`; how long it lasts: see "
                "`sinew design life`."};
  if (all.empty()) {
    out.refused = refusal(nearest, task, s);
    return out;
  }
  const Candidate& best = choice(all, task);
  add_values(out, best, task, air);
  out.tables = {table_of(all, task)};
  out.plots = {torque_plot(best, task, air.atmosphere), margin_plot(all, task)};
  if (!s.base.empty() && s.rest_length.empty() && task.arm == Arm::cam)
    out.file = [s, best, volume = task.external_volume](const std::string& path) {
      return robot_file(s, best, volume, path);
    };
  if (!s.rest_length.empty())
    out.notes.push_back(fmt::format(
        "the actuator's file of this muscle: sinew identify scale {} rest_length=\"{}\"",
        s.actuator, units::format_quantity(best.rest_length, "m", "mm")));
  out.notes.push_back("limited by: " + what_limits(best, task));
  add_doubts(out, best, task);
  return out;
}

}  // namespace sinew::design
