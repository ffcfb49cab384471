// run/bring_up/strokes.h - the travel of a joint from end to end, as its muscles turn it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/run/bring_up/muscles.h"

namespace sinew::run {

// A joint whose angle is measured, with the muscles that turn it alone.
struct BenchJoint {
  std::string name, angle_sensor;
  std::size_t angle = 0;              // channel of the board
  std::vector<std::size_t> muscles;   // numbers of BenchMuscles, the flexor first
  std::uint16_t lowest = 0, top = 0;  // limits of its sensor in a run [count]
};
std::vector<BenchJoint> bench_joints(const control::Board& board,
                                     const std::vector<BenchMuscle>& muscles);

// Returns the stages that fill one muscle completely, for a joint that hangs empty.
std::vector<Stage> stroke_of(const BenchMuscle& muscle, std::size_t joints);

// Returns the joint's angle while the muscle was full: the mean over the stage's last 50 ms
// [count].
double end_of_stroke(const BenchJoint& joint, const Trial& trial);

// Returns sentences with the faults of a joint's ends and their remedies; empty if there is no
// fault. `ends` has one value per muscle, in their order.
std::vector<std::string> wrong_with_ends(const BenchJoint& joint,
                                         const std::vector<BenchMuscle>& muscles,
                                         const std::vector<double>& ends);

}  // namespace sinew::run
