// identify/machine/driven_run.h - a machine in simulation, driven by the valves of a recorded run:
// what its sensors would have read at the instants at which they were read.
//
// As replay of a plant (run/simulation/replay_plant.h): the machine stands at the experiment's
// start and its valves do what the recording says, so that it has to move as the recorded one did.
// Here nothing looks on, and readings come without noise and rounding, so that they change smoothly
// with every number of the machine. A simulation has no state besides its own: many at once give
// the bits of one after the other.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/identify/machine/run_channels.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"

namespace sinew::identify {

class DrivenRun {
 public:
  // Throws config::Error for a recording without valves' commands or without readings.
  DrivenRun(const experiment::Experiment& experiment, const signals::Table& recorded, bool imported,
            const std::string& name = "recording");

  // Returns the channels, and how many samples they have together.
  const std::vector<RunChannel>& channels() const { return channels_; }
  std::size_t samples() const { return instants_.size(); }
  // Returns the last sample's time [s].
  double duration() const;
  // Returns a sample's time [s]; samples are counted channel by channel.
  double time(std::size_t sample) const { return time_[sample]; }
  // The topics of duties that edges were made from.
  const std::vector<std::string>& rebuilt() const { return rebuilt_; }
  // The topics of edges that an imported table knows to one of its rows only, and has no duties of.
  const std::vector<std::string>& coarse() const { return coarse_; }

  // Writes what each sample's mean is if the machine is that one, whose description differs from
  // the constructor's in numbers only. Samples later than `until` [s] are left as they are. False
  // where the machine does not get so far in finite numbers. Throws std::invalid_argument for a
  // robot that no plant can hold.
  bool predict(const experiment::Experiment& machine, std::span<double> out, double until) const;

  // Returns how often a foot or a disc of that machine comes down on the ground, as far as samples
  // up to `until` [s] see it; one that stands on it from the beginning does not.
  int landings(const experiment::Experiment& machine, double until) const;

 private:
  // Simulates the machine, and calls visit(instant, truth) for each sample in ascending time. False
  // where the machine does not get so far, or a visit returns false.
  template <class Visit>
  bool drive(const experiment::Experiment& machine, double until, Visit visit) const;

  // A sample: its place in `out`, and its channel.
  struct Instant {
    signals::Tick at = 0;
    std::size_t sample = 0, channel = 0;
  };

  std::vector<RunChannel> channels_;
  std::vector<signals::Edge> edges_;
  std::vector<std::string> rebuilt_, coarse_;
  std::vector<Instant> instants_;  // in ascending time
  std::vector<double> time_;       // by sample
};

}  // namespace sinew::identify
