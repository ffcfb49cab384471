// run/bring_up/clicks.h - each valve of a board alone: five clicks, that a person hears.
#pragma once

#include <string>
#include <vector>

#include "sinew/run/bring_up/muscles.h"

namespace sinew::run {

// A valve that is to be heard clicking.
struct BenchValve {
  std::string what;  // "the inlet of hip_flexor (output 0: bit 0, pins 31 and 32)"
  std::size_t board_joint = 0;
  std::int32_t control::Duties::*duty = nullptr;  // that opens it
};

// All valves that the board's outputs drive: those of the muscles, then a cylinder's four; `pins`
// as of wires.h.
std::vector<BenchValve> bench_valves(const experiment::Experiment& experiment,
                                     const control::Board& board,
                                     const std::vector<BenchMuscle>& muscles, const Pins* pins);

// The stages that click it.
std::vector<Stage> clicks_of(const BenchValve& valve, std::size_t joints);

// Returns what moves the machine and what no step of a bring-up tries with air: cylinders and
// regulators, by name.
std::vector<std::string> not_tried(const experiment::Experiment& experiment,
                                   const control::Board& board);

}  // namespace sinew::run
