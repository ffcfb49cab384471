#include "sinew/run/bring_up/strokes.h"

#include <fmt/format.h>

#include <algorithm>

namespace sinew::run {

namespace {

// Distance to the sensor's limits that a run needs for noise and for some swing beyond the end
// [count].
constexpr double margin = 20;
// Smallest distance between a joint's ends that is a stroke [count].
constexpr double least_stroke = 60;

// Index of the stage of a stroke that fills its muscle.
constexpr std::size_t filled = 2;

}  // namespace

std::vector<BenchJoint> bench_joints(const control::Board& board,
                                     const std::vector<BenchMuscle>& muscles) {
  std::vector<BenchJoint> out;
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    const BenchMuscle& m = muscles[i];
    if (!m.angle || m.two_joints) continue;
    if (out.empty() || out.back().name != m.joint) {
      const control::SensorLimits& limits = board.limits.sensor[*m.angle];
      out.push_back({m.joint, m.angle_sensor, *m.angle, {}, limits.low, limits.high});
    }
    out.back().muscles.push_back(i);
  }
  return out;
}

std::vector<Stage> stroke_of(const BenchMuscle& m, std::size_t joints) {
  const std::vector<control::Duties> all_empty(joints, empty_both);
  std::vector<control::Duties> one_full = all_empty;
  one_full[m.board_joint] = fill(m);
  return {{0.5, all_empty}, {0.1, {}}, {1.5, one_full}, {1.5, all_empty}};
}

double end_of_stroke(const BenchJoint& joint, const Trial& t) {
  return t.stages[filled].after(joint.angle);
}

std::vector<std::string> wrong_with_ends(const BenchJoint& joint,
                                         const std::vector<BenchMuscle>& muscles,
                                         const std::vector<double>& ends) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (ends[i] < joint.lowest + margin || ends[i] > joint.top - margin)
      out.push_back(
          fmt::format("{} reads {:.0f} where {} has pulled {} to its end; expected {:.0f} to "
                      "{:.0f}: a run would "
                      "end there; turn the sensor on its shaft, or put a stop to the joint",
                      joint.angle_sensor, ends[i], muscles[joint.muscles[i]].name, joint.name,
                      joint.lowest + margin, joint.top - margin));
  if (ends.size() == 2) {
    const double stroke = muscles[joint.muscles[0]].direction * (ends[0] - ends[1]);
    if (stroke < least_stroke)
      out.push_back(
          fmt::format("{} goes {:.0f} count from end to end; expected {:.0f} at least: is "
                      "something in its way, or a tendon loose?",
                      joint.name, stroke, least_stroke));
  }
  return out;
}

}  // namespace sinew::run
