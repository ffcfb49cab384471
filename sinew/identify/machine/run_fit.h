// identify/machine/run_fit.h - identification of a machine's parameters from a run: friction,
// damping, dead times, volumes and leaks from valve commands, angles, tensions and pressures.
// The machine is simulated with the recorded valve commands, and its readings are fitted to the
// recorded ones.
//
//   minimise  sum ((reading_i - mean_i(p))/noise_i)^2     over the parameters p
//
//   mean_i    mean reading of the simulated machine's sensor at that instant (driven_run.h)
//   noise_i   the sensor's own noise and its rounding
//
// The whole run is one simulation from its start: under recorded valve commands the influence of
// the initial state of a machine in the air decays, and its readings are smooth functions of its
// parameters. Two kinds of jump remain:
//
//   dead times   valves are switched at ticks of 0.1 ms, and a pulse no longer than the opening
//                delay is lost (gas/delay.h): when the delay passes a tick, pulses appear or vanish
//   contact      a slightly earlier touchdown changes all later motion: for a walk the fit
//                reports its solution, but no intervals
//
// Therefore the search begins with a coarse scan of each parameter, dead times in whole ticks, and
// continues with Gauss-Newton (contest/least_squares.h); both are repeated while the residuals
// exceed the noise.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sinew/config/node.h"
#include "sinew/experiment/experiment.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/machine/driven_run.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Prior knowledge of a parameter.
struct RunPrior {
  std::string key;
  double value = 0, standard_deviation = 0;  // in SI
};

// The fit needs the rest of the run, unless the whole run is held out and nothing is fitted.
inline constexpr double most_held_out = 0.9;
constexpr bool is_share_held_out(double share) {
  return (share >= 0 && share < most_held_out) || share == 1;
}

// Options of a fit to a run.
struct RunFitOptions {
  std::vector<std::string> fit;     // keys and groups (machine_numbers.h); empty: all groups
  std::vector<std::string> frozen;  // keys of these that are not searched
  // Share of the run, at its end, that scores the result; 1: nothing is fitted, and the described
  // machine is scored.
  double hold_out = 0.2;
  std::vector<RunPrior> priors;
  int threads = 0;  // parallel simulations; 0: number of processors
  int rounds = 12;  // most rounds of trying other dead times
  double from = 0;  // samples before are not compared [s]
  std::function<void(const std::string&)> progress;  // receives progress messages
};

// Residuals of a channel.
struct ChannelScore {
  std::string name, unit;
  std::size_t samples = 0;
  double noise = 0;                 // noise of its sensor, in `unit`
  double fitted = 0, held_out = 0;  // rms of the residuals, in `unit`
};

// Result of a fit to a run.
struct RunFitResult {
  Report report;
  std::vector<std::string> keys;  // keys of the parameters to be fitted
  std::vector<ChannelScore> channels;
  std::vector<std::string> undetermined;  // combinations of parameters, in words
  experiment::Experiment machine;         // with the identified values

  // Why no intervals are given: the readings jump with the parameters, or the residuals are far
  // above the noise, so derivatives near the solution give no error bounds. Empty: they are given.
  std::string no_intervals;
  bool rough = false;    // derivatives over a longer step differ
  double roughness = 0;  // relative difference of the derivatives
  int landings = 0;      // landings of feet, within the fitted time

  int simulations = 0;
  double at_start = 0;  // rms of the residuals at the start, in units of the noise
};

// Fits the parameters. The experiment gives start values and all other parameters. Throws
// config::Error for keys that the robot does not have, and Refusal if the run cannot support the
// fit.
RunFitResult fit_run(const experiment::Experiment& experiment, const DrivenRun& run,
                     const RunFitOptions& options);

// Returns the text of a robot's file: `robot` with the identified keys, each with its source and
// uncertainty. Keys that the run does not determine are left out.
std::string run_file(const RunFitResult& found, const std::string& source, config::Node robot);

// Returns what the report does not contain: channels, undetermined combinations, and the effort.
Json describe(const RunFitResult& found);

}  // namespace sinew::identify
