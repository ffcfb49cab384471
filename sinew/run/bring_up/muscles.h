// run/bring_up/muscles.h - one muscle at a time on the bench: is it filled by its own inlet,
// emptied by its own exhaust, does it pull its joint the right way, does it hold its air.
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
  int direction = 1;        // of its joint's counts while it shortens
  std::optional<std::size_t> tension, angle;  // channels of the board
  int tension_sign = 1;                       // of its counts while it pulls
  std::string inlet, exhaust;  // where they are wired, for a message: "bit 0 (pin 31)"
  std::string angle_sensor, tension_sensor;
};

// Those that valves fill, in the order of the joints, flexor first; `pins` as of wires.h.
std::vector<BenchMuscle> bench_muscles(const experiment::Experiment& experiment,
                                       const control::Board& board, const Pins* pins);

// The stages that try one of them (`judge` reads what comes of them).
std::vector<Stage> stages_for(const BenchMuscle& muscle, std::size_t joints);

struct Judgement {
  std::vector<std::string> wrong;  // what, and what to look at; empty: nothing
  std::string said;                // in figures
};
// Returns what is wrong with one of the muscles, by what its trial recorded.
Judgement judge(const std::vector<BenchMuscle>& all, std::size_t which, const Trial& trial);

// Only this of a joint's valves, in whole percent.
control::Duties fill(const BenchMuscle& muscle);
inline constexpr control::Duties empty_both{0, 100, 0, 100};

}  // namespace sinew::run
