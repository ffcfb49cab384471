// identify/task/sensor_task.h - `sinew identify sensor`: calibrations to the sensors of a robot's
// file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/sensor/sensor.h"

namespace sinew::identify {

struct SensorSettings {
  std::string known;                 // the column that was set; empty: the only one
  std::vector<std::string> sensors;  // columns to calibrate; empty: all in volts or counts
  std::string rest;                  // the known value at rest; empty: 0, or …
  std::optional<double> rest_value;  // … the same in SI
  int bits = 12;                     // of the converter
  std::string full_scale = "5 V";    // of the converter
  std::optional<Source> held_out;    // another calibration; else each known value by the others
  bool average = false;              // the controller believes in one scale for all of them
  std::string base;                  // the robot's file whose sensors these are; empty: none
};

// Holds what was found, and the robot's file that is written with it.
struct SensorFound {
  Calibration calibration;
  std::string display;  // unit of the known values, as they were given
  CountScale converter;
  bool average = false;
  std::string base;

  // The robot's file, as it would stand at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// Throws config::Error and Refusal.
SensorFound find_sensors(const std::vector<Source>& sources, const SensorSettings& settings);

}  // namespace sinew::identify
