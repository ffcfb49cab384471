// run/bring_up/wires.h - where a board's sensors and valves are to be wired.
#pragma once

#include <string>
#include <vector>

#include "sinew/control/setup/boards.h"
#include "sinew/experiment/experiment.h"

namespace sinew::run {

struct Wire {
  std::string name;       // "hip_angle", "hip_flexor inlet"
  std::string at;         // on the board: "input 1", "output 0"
  std::string elsewhere;  // the robot's own numbers: "bit 0, pins 31 and 32"

  std::string in_words() const { return at + ": " + elsewhere; }
};

// By the board's channels and by its valves: input i is its channel i, output i its valve i.
std::vector<Wire> sensor_wires(const experiment::Experiment& e, const control::Board& board);
std::vector<Wire> valve_wires(const experiment::Experiment& e, const control::Board& board);

}  // namespace sinew::run
