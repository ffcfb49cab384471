#include "sinew/run/setup/buildable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "sinew/actuator/body.h"
#include "sinew/air/network.h"
#include "sinew/config/compose.h"
#include "sinew/config/setting.h"
#include "sinew/control/gait/legs.h"
#include "sinew/control/setup/joint_controllers.h"
#include "sinew/experiment/check.h"
#include "sinew/mechanism/planar/muscle_routing.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/units/quantity.h"
#include "sinew/world/machine.h"

namespace sinew::run {

using experiment::Experiment;

namespace {

using List = std::vector<robot::Contradiction>;

// The range of a joint's motion: its start, and its setpoints in one step of the plan [rad].
struct Reach {
  double low = 0, high = 0, start = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;  // of the setpoints

  void add(double angle) {
    low = std::min(low, angle);
    high = std::max(high, angle);
    least = std::min(least, angle);
    most = std::max(most, angle);
  }

  // Returns whether only the start takes the joint to this angle.
  bool is_of_start(double angle) const {
    const double from_middle = std::remainder(start - (least + most) / 2, 2 * std::numbers::pi);
    return angle == start && least <= most && std::abs(from_middle) > (most - least) / 2 + 1e-6;
  }
};

// Adds the present setpoints of a leg's joints.
void add_desired(const Experiment& e, const gait::Legs& legs, std::size_t leg,
                 std::vector<Reach>& out) {
  const gait::Desired& desired = legs.desired(leg);
  if (desired.stage != gait::Stage::walking) return;
  const std::vector<int>& joints = legs.parts(leg).joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto j = static_cast<std::size_t>(joints[i]);
    const robot::Joint& joint = e.robot.joints[j];
    const double turned = desired.joint[i].angle - joint.rest_angle;  // 0 deg is 360 deg
    if (joint.kind == robot::Joint::Kind::driven)
      out[j].add(joint.rest_angle + std::remainder(turned, 2 * std::numbers::pi));
  }
}

std::vector<Reach> reaches(const Experiment& e) {
  std::vector<Reach> out;
  for (const robot::Joint& j : e.robot.joints) {
    const double start = e.start.joint_angles.at(j.name);
    out.push_back({start, start, start});
  }
  gait::Legs legs(e.robot, e.plan);
  gait::MachineMeasured still;
  for (std::size_t j = 0; j < out.size(); ++j) still.angle[j] = e.robot.joints[j].rest_angle;
  const auto settle = std::llround(e.start.settle / e.plan.high_level_period);
  gait::Plan once = e.plan;
  once.repeat = 1;
  const auto last = gait::periods(e.robot, once);
  for (std::int64_t k = settle; k <= last; ++k) {
    legs.update(still, k);
    for (std::size_t l = 0; l < legs.count(); ++l) add_desired(e, legs, l, out);
  }
  return out;
}

// Adds muscles whose chamber has no volume within the joints' range: their pressure is undefined.
void check_volumes(const Experiment& e, const plant::Setup& setup, List& out) {
  const std::vector<Reach> reach = reaches(e);
  const plant::MuscleRouting tendons(e.robot);
  for (const bool high : {false, true}) {
    std::array<double, robot::max_joints> angle{}, still{};
    for (std::size_t j = 0; j < reach.size(); ++j) angle[j] = high ? reach[j].high : reach[j].low;
    air::Lanes<plant::most_muscles> length{}, rate{};
    plant::MuscleRouting::MomentArms<plant::most_muscles> pulls{};
    tendons.at(angle.data(), still.data(), length, rate, pulls);
    for (int i = 0; i < tendons.count(); ++i) {
      const auto m = static_cast<std::size_t>(i);
      const actuator::Actuator& a = setup.muscles[m].actuator;
      const bool none = length[i] - a.caps.length <= 0;
      const bool taut = length[i] - a.caps.length >= a.braid.thread_length;
      if (!none && !(taut && setup.muscles[m].external_volume <= 0)) continue;
      const robot::Muscle& muscle = e.robot.muscles[m];
      const std::string& joint = muscle.joint;
      const auto j = static_cast<std::size_t>(tendons.joint(i, 0));
      const double at = angle[j];
      const std::string key = "muscle." + muscle.name;
      if (std::ranges::any_of(out, [&](const auto& c) { return c.key.starts_with(key + "."); }))
        continue;
      const auto text = [&](double metres) {
        return config::quantity_like(e.origins, key + ".mount_length", metres, "m", "in");
      };
      if (reach[j].is_of_start(at)) {
        const std::string start = "start.joint_angles." + joint;
        const auto shown = [&](double rad) {
          return config::quantity_like(e.origins, start, rad, "rad", "deg");
        };
        out.push_back({start,
                       shown(at) + ", where the chamber of " + muscle.name +
                           " has no volume: the muscle is " + text(length[i]) + " long",
                       "an angle near those of the plan, " + shown(reach[j].least) + " to " +
                           shown(reach[j].most),
                       ""});
        continue;
      }
      out.push_back(
          {key + (none ? ".mount_length" : ".external_volume"),
           "a chamber without volume: with joint " + joint + " at " +
               config::quantity_like(e.origins, "joint." + joint + ".rest_angle", at, "rad",
                                     "deg") +
               " the muscle is " + text(length[i]) + " long",
           none ? "a length above 0 wherever the plan takes the joint"
                : "less than the thread's " + text(a.braid.thread_length) +
                      ", or an external volume",
           none ? "a smaller joint." + joint + ".moment_arm, or another rest_angle"
                : "an external_volume above 0, or a smaller joint." + joint + ".moment_arm"});
    }
  }
}

// Warns of an end of a joint's range that no muscle can pull to: each muscle that turns the joint
// in that direction reaches its shortest length, where its pull ends, before.
void warn_of_reach(const Experiment& e, const plant::Setup& setup,
                   const plant::MuscleRouting& tendons, std::size_t joint, const Reach& reach,
                   bool high, List& out) {
  std::array<double, robot::max_joints> angle{}, still{};
  for (std::size_t j = 0; j < e.robot.joints.size(); ++j) angle[j] = e.robot.joints[j].rest_angle;
  angle[joint] = high ? reach.high : reach.low;
  air::Lanes<plant::most_muscles> length{}, rate{};
  plant::MuscleRouting::MomentArms<plant::most_muscles> arms{};
  tendons.at(angle.data(), still.data(), length, rate, arms);
  int nearest = -1;  // the muscle that comes closest
  double left = 0;   // its length above the shortest [m]
  for (int i = 0; i < tendons.count(); ++i)
    for (std::size_t s = 0; s < plant::MuscleRouting::most; ++s) {
      const auto m = static_cast<std::size_t>(i);
      if (tendons.joint(i, static_cast<int>(s)) != static_cast<int>(joint)) continue;
      if (high != (arms[m][s] > 0)) continue;
      const double above = length[i] - actuator::shortest_length(setup.muscles[m].actuator);
      if (above > 0) return;
      if (nearest < 0 || above > left) nearest = i, left = above;
    }
  if (nearest < 0) return;
  const robot::Joint& of = e.robot.joints[joint];
  const robot::Muscle& muscle = e.robot.muscles[static_cast<std::size_t>(nearest)];
  const auto text = [&](double metres) {
    return config::quantity_like(e.origins, "muscle." + muscle.name + ".mount_length", metres, "m",
                                 "in");
  };
  out.push_back({"joint." + of.name,
                 "a plan that takes it to " +
                     config::quantity_like(e.origins, "joint." + of.name + ".rest_angle",
                                           angle[joint], "rad", "deg") +
                     ", where " + muscle.name + " would be " + text(length[nearest]) + " long",
                 "more than its shortest length, " + text(length[nearest] - left) +
                     ", at which it pulls no more",
                 "an angle nearer to the rest angle, a longer muscle, or a smaller moment_arm"});
}

// Adds air or joints that are so quick that a run would take too long.
void check_steps(const plant::Setup& s, List& out) {
  constexpr double shortest = 2e-6;  // step [s]
  const double air =
      air::AirNetwork<plant::most_muscles>(s.muscles, s.air, s.supply, s.cylinder, {}, s.steps.body)
          .longest_step();
  const auto micro = [](double step) { return units::format_number(1e6 * step) + " us"; };
  if (s.air.wall_time > 0 && air < shortest) {  // else quick air is integrated ahead
    out.push_back({"air", "a hose or a cylinder's chamber that fills within " + micro(air),
                   "at least 2 us", "a larger volume, a hose without one, or no air.wall_time"});
    return;
  }
  const double step = plant::Machine(s).shortest_step();
  if (step < shortest && step < s.steps.body)
    out.push_back({"plant_steps.body", "a machine that needs steps of " + micro(step),
                   "at least 2 us", "less damping or stiffness, a smaller leak, heavier links"});
}

// Adds contradictions between the simulated machine and its plan.
void check_motion(const Experiment& e, List& out) {
  const plant::Setup setup = planar_setup(e);
  check_volumes(e, setup, out);
  if (out.empty()) check_steps(setup, out);
}

}  // namespace

void refuse_unbuildable(const Experiment& e) {
  std::vector<robot::Contradiction> wrong;
  if (!e.stand) wrong = control::misfits(installation(e));
  check_air_faults(e.faults, wrong);
  if (e.stand) {
    check_stand_setup(e, wrong);
    return refuse(wrong, e);
  }
  if (wrong.empty()) check_motion(e, wrong);
  refuse(wrong, e);
}

void refuse_unbuildable(const experiment::MachineFile& file) {
  if (file.kind == "experiment") return refuse_unbuildable(file.experiment);
  if (file.kind == "robot")
    refuse(control::misfits(installation(file.experiment)), file.experiment);
}

Experiment buildable(const std::string& path, const std::vector<std::string>& sets) {
  return buildable(config::compose(path, sets), path);
}

Experiment buildable(const config::Node& root, const std::string& path) {
  Experiment e = experiment::load(root, path);
  refuse_unbuildable(e);
  return e;
}

Experiment buildable_robot(const config::Node& root, const std::string& path) {
  Experiment e = buildable(root, path);
  if (e.stand)
    config::fail({path, 0, 0}, "", "an experiment on a test stand", "one of a robot",
                 "sinew list experiments");
  return e;
}

std::vector<robot::Contradiction> beyond_reach(const Experiment& e) {
  if (e.stand) return {};
  List out;
  const plant::Setup setup = planar_setup(e);
  const plant::MuscleRouting tendons(e.robot);
  const std::vector<Reach> reach = reaches(e);
  for (std::size_t j = 0; j < reach.size(); ++j)
    for (const bool high : {false, true})
      if (reach[j].low < reach[j].high) warn_of_reach(e, setup, tendons, j, reach[j], high, out);
  return out;
}

}  // namespace sinew::run
