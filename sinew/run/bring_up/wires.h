// run/bring_up/wires.h - wiring of a board's sensors and valves, as a list and as a drawing.
#pragma once

#include <string>
#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/bring_up/pins.h"
#include "sinew/run/folder/files.h"

namespace sinew::run {

struct Wire {
  std::string name;          // "hip_angle", "hip_flexor inlet"
  std::string at;            // on the board: "input 1 (PA1)", "output 0"
  std::string robot_wiring;  // in the robot's own numbers: "bit 0, pins 31 and 32"
  bool driven = true;        // false: an output without a valve, as the exhaust of a 3-way valve

  // Returns both in a line: on the board, and in the robot's numbers.
  std::string to_text() const { return at + ": " + robot_wiring; }
};

// Return the wires in the order of the board's channels and of its valves: input i is its channel
// i, output i its valve i. `pins` are those of the connected board; nullptr: unknown.
std::vector<Wire> sensor_wires(const experiment::Experiment& e, const control::Board& board,
                               const Pins* pins);
std::vector<Wire> valve_wires(const experiment::Experiment& e, const control::Board& board,
                              const Pins* pins);

// Drawing of the wiring.

// Kind of the drawing's file.
inline constexpr FileKind wiring_kind{"drawing of `sinew firmware wiring`", "such a drawing",
                                      "valves,eachbehindadriver"};

// Returns an SVG of a board with its sensors on the left, its valves on the right, the supply and
// its dump valve below. It shows channels and bits, the terminals' pins if the robot has [wiring],
// and the board's own pins if `pins` is not nullptr.
std::string wiring_drawing(const experiment::Experiment& experiment, const control::Board& board,
                           const Pins* pins);

}  // namespace sinew::run
