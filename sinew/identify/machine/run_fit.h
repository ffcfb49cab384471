// identify/machine/run_fit.h - numbers of a machine from a run of it: valve commands, angles,
// tensions, pressures -> friction, damping, dead times, volumes, leaks, by simulating the machine
// with the recorded valve commands until it reads what was read.
//
//   minimise  sum ((reading_i - mean_i(p))/noise_i)^2     over the numbers p
//
//   mean_i    what the simulated machine's sensor reads on average at that instant (driven_run.h)
//   noise_i   the sensor's own noise and its rounding
//
// The whole run is one simulation from its start: under recorded valve commands a machine in the
// air forgets where it was, and its readings change smoothly with its numbers. Two kinds of jump
// remain:
//
//   dead times   valves are switched at ticks of 0.1 ms, and a pulse no longer than the opening
//                delay is lost (gas/delay.h): where the delay passes a tick, pulses come or go
//   contact      a foot that touches down a little earlier leaves everything after it elsewhere: of
//                a walk the fit is told where it ends, not by how much it errs
//
// So the search begins with a coarse scan, each number by itself, dead times by whole ticks, and
// goes on by Gauss-Newton (fit/least_squares.h); where what is left is more than noise, both again.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/experiment/experiment.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/machine/driven_run.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// What is known of a number besides the run.
struct RunPrior {
  std::string key;
  double value = 0, standard_deviation = 0;  // in SI
};

// The run needs the rest for its fit, unless all of it is held out and nothing is fitted.
inline constexpr double most_held_out = 0.9;
constexpr bool is_share_held_out(double share) {
  return (share >= 0 && share < most_held_out) || share == 1;
}

// Says which numbers a fit to a run searches, and how hard.
struct RunFitOptions {
  std::vector<std::string> fit;     // keys and groups (machine_numbers.h); empty: all groups
  std::vector<std::string> frozen;  // keys of these that are not searched after all
  // Share of the run, at its end, that scores what was found; 1: nothing is fitted, and the machine
  // is scored as it is described.
  double hold_out = 0.2;
  std::vector<RunPrior> priors;
  int threads = 0;  // simulations at once; 0: as many as the computer has processors
  int rounds = 12;  // of trying other dead times, at most
  double from = 0;  // samples before it are not compared [s]
  std::function<void(const std::string&)> progress;  // told what is being done
};

// How well a channel is met.
struct ChannelScore {
  std::string name, unit;
  std::size_t samples = 0;
  double noise = 0;                 // that its sensor has, in `unit`
  double fitted = 0, held_out = 0;  // rms of what is left, in `unit`
};

// Holds the numbers that a run told of its machine.
struct RunFitResult {
  Report report;
  std::vector<std::string> keys;  // of the numbers that were to be fitted
  std::vector<ChannelScore> channels;
  std::vector<std::string> undetermined;  // combinations of numbers, in words
  experiment::Experiment machine;         // with what was found

  // Why intervals are not given: the readings jump with the numbers, so that what is known of them
  // near the solution says nothing of how far off it lies. Empty: they are given.
  std::string no_intervals;
  bool rough = false;    // derivatives over a longer step are others
  double roughness = 0;  // by that share of them
  int landings = 0;      // of feet on the ground, up to the end of what was fitted

  int simulations = 0;
  double at_start = 0;  // rms of what is left with the numbers as they stood, in noises
};

// Finds them. The experiment says where the search begins and what is not searched.
// Throws config::Error for keys that the robot does not have, and Refusal where the run cannot
// support the fit.
RunFitResult fit_run(const experiment::Experiment& experiment, const DrivenRun& run,
                     const RunFitOptions& options);

// Returns the text of a robot's file: `robot` with the keys that were found, each with its source
// and how far it can be trusted. What the run does not determine is left out.
std::string run_file(const RunFitResult& found, const std::string& source, config::Node robot);

// Returns what the report does not say: channels, what is not determined, and what it took.
Json describe(const RunFitResult& found);

}  // namespace sinew::identify
