// run/bring_up/strokes.h - how far the muscles of a joint turn it, from end to end.
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
  std::uint16_t lowest = 0, top = 0;  // what its sensor may say in a run [count]
};
std::vector<BenchJoint> bench_joints(const control::Board& board,
                                     const std::vector<BenchMuscle>& muscles);

// The stages that fill one of them as far as it goes, for a joint that hangs empty.
std::vector<Stage> stroke_of(const BenchMuscle& muscle, std::size_t joints);

// Where the joint stood while it was full: the mean over the stage's last 50 ms [count].
double end_of_stroke(const BenchJoint& joint, const Trial& trial);

// Returns what is wrong with a joint's ends and what to do, in sentences; empty: nothing. `ends`
// are those of its muscles, in their order.
std::vector<std::string> wrong_with_ends(const BenchJoint& joint,
                                         const std::vector<BenchMuscle>& muscles,
                                         const std::vector<double>& ends);

}  // namespace sinew::run
