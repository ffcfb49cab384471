// run/bring_up/muscles.h - bench tests of one muscle at a time: its own inlet fills it, its own
// exhaust empties it, it pulls its joint in the right direction, and it holds its air.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/bring_up/pins.h"
#include "sinew/run/bring_up/trial.h"

namespace sinew::run {

// A muscle that a board's valves fill and empty.
struct BenchMuscle {
  std::string name, joint;
  std::size_t board_joint = 0;
  bool flexor = true, two_joints = false;
  bool has_exhaust = true;  // false: a 3-way valve, which empties it whenever it does not fill it
  int direction = 1;        // sign of the change of its joint's counts while it shortens
  std::optional<std::size_t> tension, angle;  // channels of the board
  int tension_sign = 1;                       // sign of the change of its counts while it pulls
  std::string inlet, exhaust;                 // their wiring, for a message: "bit 0 (pin 31)"
  std::string angle_sensor, tension_sensor;
};

// Returns the muscles that valves fill, in the order of the joints, flexor first; `pins` as in
// wires.h.
std::vector<BenchMuscle> bench_muscles(const experiment::Experiment& experiment,
                                       const control::Board& board, const Pins* pins);

// Returns the stages that try a muscle; evaluate() evaluates their recording.
std::vector<Stage> stages_for(const BenchMuscle& muscle, std::size_t joints);

struct MuscleResult {
  std::vector<std::string> wrong;  // faults and their remedies; empty: no fault
  std::string findings;            // the measured figures
};
// Returns the faults of one of the muscles in the recording of its trial.
MuscleResult evaluate(const std::vector<BenchMuscle>& all, std::size_t which, const Trial& trial);

// Returns the duties that fill only this muscle and empty its antagonist [%].
control::Duties fill(const BenchMuscle& muscle);
inline constexpr control::Duties empty_both{0, 100, 0, 100};

// --- the travel of a joint from end to end, as its muscles turn it ---

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
