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
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/signals/port.h"
#include "sinew/signals/table.h"
#include "sinew/signals/tick.h"

namespace sinew::identify {

// A channel of a run, with its samples in ascending time: counts of a sensor, or angles, tensions
// and pressures of a recording, each at the instant at which it was sampled.
//
//   reading = at_zero + per_unit x quantity + noise, within the converter's ends
//
// A run of ours has one row per period; a sensor's counts there are those of its last conversion,
// which began some ticks before. Another program's recording has its own times.
struct RunChannel {
  // What it measures: a joint's angle from its rest [rad] or rate [rad/s], a muscle's tension [N]
  // or gauge pressure [Pa], the cylinder's travel [m].
  enum class Of { angle, rate, tension, pressure, lift };

  std::string name;  // "lever_angle", or "/joint/lever/angle" of a recording without its counts
  std::string unit;  // "count", "rad"
  Of of = Of::angle;
  std::size_t index = 0;  // of the joint or muscle, in the robot's order
  double at_zero = 0, per_unit = 1;
  double noise = 0;  // standard deviation of a reading, rounding included, in `unit`
  double bottom = -std::numeric_limits<double>::infinity();  // the converter's ends
  double top = std::numeric_limits<double>::infinity();

  std::vector<signals::Tick> at;
  std::vector<double> value;

  // Returns the quantity in SI, by what a simulation knows; gauges read against `atmosphere` [Pa].
  double quantity(const plant::Truth& truth, const robot::Robot& robot, double atmosphere) const;
  // Returns the mean of what a converter reads of that quantity: near its ends they cut the noise.
  double expected(double quantity) const;
};

// Returns the channels that the recording has of what a simulated machine says. Samples are left
// out that say nothing: long ones at a converter's end, and what is no number. `imported`: the
// recording is somebody else's. Throws config::Error where there is no channel.
std::vector<RunChannel> run_channels(const experiment::Experiment& experiment,
                                     const signals::Table& recorded, bool imported,
                                     const std::string& name = "recording");

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
