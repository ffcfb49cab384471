// identify/machine/run_channels.h - what a run of a robot measured, as a simulation can say it:
// counts of its sensors, or angles, tensions and pressures of a recording, each at the instant at
// which it was sampled.
//
//   reading = at_zero + per_unit x quantity + noise, within the converter's ends
//
// A run of ours has one row per period; a sensor's counts there are those of its last conversion,
// which began some ticks before. A recording of somebody else stands at its own times.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/mechanism/planar/setup.h"
#include "sinew/signals/table.h"
#include "sinew/signals/tick.h"

namespace sinew::identify {

// A channel of a run, with its samples in ascending time.
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

}  // namespace sinew::identify
