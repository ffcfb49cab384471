// identify/machine/driven_run.h - simulation of a machine with the valve commands of a recorded
// run: predicted sensor readings at the instants of the recorded ones.
//
// Similar to the replay of a plant (run/simulation/replay_plant.h): the machine begins at
// the experiment's start and its valves follow the recording, so that it should move like the
// recorded one. Nothing is shown, and readings are without noise and rounding, so they are smooth
// functions of the machine's parameters. Simulations share no state: parallel ones give the same
// bits as sequential ones.
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
// and pressures of a recording, each at the instant of its sampling.
//
//   reading = at_zero + per_unit x quantity + noise, within the converter's limits
//
// One of our runs has one row per period; its counts are those of the sensor's last
// conversion, which began some ticks before. A recording of another program has its own times.
struct RunChannel {
  // The quantity: a joint's angle from rest [rad] or rate [rad/s], a muscle's tension [N] or gauge
  // pressure [Pa], the cylinder's travel [m].
  enum class Of { angle, rate, tension, pressure, lift };

  std::string name;  // "lever_angle", or "/joint/lever/angle" without counts
  std::string unit;  // "count", "rad"
  Of of = Of::angle;
  std::size_t index = 0;  // index of the joint or muscle in the robot
  double at_zero = 0, per_unit = 1;
  double noise = 0;  // standard deviation of a reading with rounding, in `unit`
  double bottom = -std::numeric_limits<double>::infinity();  // limits of the converter
  double top = std::numeric_limits<double>::infinity();

  std::vector<signals::Tick> at;
  std::vector<double> value;

  // Returns the quantity of a simulation in SI; `atmosphere` is the reference of gauges [Pa].
  double quantity(const plant::Truth& truth, const robot::Robot& robot, double atmosphere) const;
  // Returns the mean reading for that quantity; near the converter's limits they clip the noise.
  double expected(double quantity) const;
};

// Returns the channels of the recording that a simulated machine has too. Samples without
// information are left out: long runs at a converter's limit, and values that are not finite.
// `imported`: the recording is from another program. Throws config::Error if there is no channel.
std::vector<RunChannel> run_channels(const experiment::Experiment& experiment,
                                     const signals::Table& recorded, bool imported,
                                     const std::string& name = "recording");

class DrivenRun {
 public:
  // Throws config::Error for a recording without valve commands or without readings.
  DrivenRun(const experiment::Experiment& experiment, const signals::Table& recorded, bool imported,
            const std::string& name = "recording");

  // Return the channels, and their total number of samples.
  const std::vector<RunChannel>& channels() const { return channels_; }
  std::size_t samples() const { return instants_.size(); }
  // Returns the last sample's time [s].
  double duration() const;
  // Returns a sample's time [s]; samples are numbered channel by channel.
  double time(std::size_t sample) const { return time_[sample]; }
  // Returns the topics of duties from which edges were computed.
  const std::vector<std::string>& rebuilt() const { return rebuilt_; }
  // Returns the topics of edges of an imported table that are only known to a row, without duties.
  const std::vector<std::string>& coarse() const { return coarse_; }

  // Writes the predicted mean of each sample for `machine`, which differs from the constructor's
  // experiment in parameters only. Samples later than `until` [s] are not written. Returns false
  // if the simulation fails before. Throws std::invalid_argument for a robot that no plant can
  // simulate.
  bool predict(const experiment::Experiment& machine, std::span<double> out, double until) const;

  // Returns the number of ground contacts of feet and discs, as far as samples up to `until` [s]
  // show it; initial contacts are not counted.
  int landings(const experiment::Experiment& machine, double until) const;

 private:
  // Simulates the machine, and calls visit(instant, truth) for each sample in ascending time.
  // Returns false if the simulation fails before, or a visit returns false.
  template <class Visit>
  bool drive(const experiment::Experiment& machine, double until, Visit visit) const;

  // A sample: its index in `out`, and its channel.
  struct Instant {
    signals::Tick at = 0;
    std::size_t sample = 0, channel = 0;
  };

  std::vector<RunChannel> channels_;
  std::vector<signals::Edge> edges_;
  std::vector<std::string> rebuilt_, coarse_;
  std::vector<Instant> instants_;  // in ascending time
  std::vector<double> time_;       // for each sample
};

}  // namespace sinew::identify
