// run/bring_up/wires.h - where a board's sensors and valves are to be wired.
#pragma once

#include <string>
#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/bring_up/pins.h"

namespace sinew::run {

struct Wire {
  std::string name;       // "hip_angle", "hip_flexor inlet"
  std::string at;         // on the board: "input 1 (PA1)", "output 0"
  std::string elsewhere;  // the robot's own numbers: "bit 0, pins 31 and 32"
  bool driven = true;     // false: a number for a valve that is not there, as a 3-way's exhaust

  // Returns both in a line: on the board, and by the robot's numbers.
  std::string in_words() const { return at + ": " + elsewhere; }
};

// By the board's channels and by its valves: input i is its channel i, output i its valve i. `pins`
// of the board that is there; nullptr: its pins are not known.
std::vector<Wire> sensor_wires(const experiment::Experiment& e, const control::Board& board,
                               const Pins* pins);
std::vector<Wire> valve_wires(const experiment::Experiment& e, const control::Board& board,
                              const Pins* pins);

// Which wire goes where, as a picture.

// Returns an SVG of a board with its sensors on the left, its valves on the right, the supply and
// its dump valve below: channels and bits, the terminals' pins where the robot's [wiring] has them,
// and the board's own where `pins` is not nullptr.
std::string wiring_drawing(const experiment::Experiment& experiment, const control::Board& board,
                           const Pins* pins);

}  // namespace sinew::run
