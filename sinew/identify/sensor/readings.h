// identify/sensor/readings.h - a measured calibration: one known quantity, and the readings of one
// or more sensors.
//
//   load [lb],gage_1 [V],gage_2 [V]        weights: a mass pulls with standard gravity
//   angle [deg],hip_angle [count]          volts, or counts of the converter
//
// The known quantity is found by its name, the sensors by their unit: every other column in volts
// or counts is a sensor.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"
#include "sinew/robot/robot.h"

namespace sinew::identify {

// Quantity of a sensor, named as in a robot's file.
using SensorKind = robot::Sensor::Kind;
// Names and units of one kind of sensor.
struct KindFacts {
  SensorKind kind;
  std::string_view word;         // e.g. "tension"
  std::string_view unit;         // SI unit of the known quantity, e.g. "N"
  std::string_view sensitivity;  // volts per unit, e.g. "V/N"
  std::string_view curvature;    // volts per unit squared, e.g. "V/N2"
};

// Returns the names and units of a kind.
const KindFacts& facts_of(SensorKind kind);

// Converter of the sensors: 2^bits counts are its full scale.
struct CountScale {
  int bits = 12;
  double full_scale = 5;  // [V]

  // Returns the voltage of one count [V].
  double volts_per_count() const { return full_scale / (1 << bits); }
  double top() const { return full_scale - volts_per_count(); }  // [V]
};

struct SensorReadings {
  std::string name;           // name of its column
  std::vector<double> volts;  // one per row
  bool counted = false;       // the file has counts
};

// Readings of sensors at known values.
struct SensorData {
  std::string file;
  SensorKind kind = SensorKind::tension;
  std::vector<double> known;  // SI, one per row
  std::string display;        // original unit of the known quantity; "lbf" for weights in lb
  std::vector<int> lines;
  std::vector<SensorReadings> sensors;
  std::vector<std::string> notes;
};

// Returns the columns that may contain the known quantity, and the time. Every other column in
// volts or counts is a sensor.
std::vector<ColumnSpec> sensor_columns();

// Read a calibration. `known`: the column of the known quantity, by one of the names above;
// empty if the file has only one. `sensors`: names of the sensors' columns; empty: all. Throw
// config::Error.
SensorData read_sensor_data(const Source& source, const CountScale& converter,
                            const std::string& known = "",
                            const std::vector<std::string>& sensors = {});
SensorData parse_sensor_data(std::string_view text, const Source& source,
                             const CountScale& converter, const std::string& known = "",
                             const std::vector<std::string>& sensors = {});

}  // namespace sinew::identify
