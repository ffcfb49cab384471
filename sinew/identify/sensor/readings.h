// identify/sensor/readings.h - a calibration as it was measured: one known quantity beside what one
// or more sensors made of it.
//
//   load [lb],gage_1 [V],gage_2 [V]        weights: a mass pulls with standard gravity
//   angle [deg],hip_angle [count]          volts, or counts of the converter
//
// The known quantity is found by its name, the sensors by their unit: every other column in volts
// or counts is one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// What a sensor measures, with the words of a robot's file.
enum class SensorKind { angle, tension, pressure, velocity, cylinder };

// The words for one kind of sensor.
struct KindFacts {
  SensorKind kind;
  std::string_view word;         // "tension"
  std::string_view unit;         // SI, of the known quantity: "N"
  std::string_view sensitivity;  // volts per that: "V/N"
  std::string_view curvature;    // and per its square: "V/N2"
};
// Returns them.
const KindFacts& facts_of(SensorKind kind);

// The converter behind the sensors: 2^bits counts are its full scale.
struct CountScale {
  int bits = 12;
  double full_scale = 5;  // [V]

  // Returns what a count is worth  [V].
  double volts_per_count() const { return full_scale / (1 << bits); }
  double top() const { return full_scale - volts_per_count(); }  // [V]
};

struct SensorReadings {
  std::string name;           // of its column
  std::vector<double> volts;  // one per row
  bool counted = false;       // the file has counts
};

// Readings of sensors at known values.
struct SensorData {
  std::string file;
  SensorKind kind = SensorKind::tension;
  std::vector<double> known;  // SI, one per row
  std::string display;        // the known quantity's unit as the file has it; "lbf" where lb hung
  std::vector<int> lines;
  std::vector<SensorReadings> sensors;
  std::vector<std::string> notes;
};

// Returns the columns that may hold the known quantity, and beside it the time. Every other one in
// volts or counts is a sensor.
std::vector<Wanted> sensor_columns();

// `known`: the column of the known quantity, by one of the names above; empty where the file has
// one only. `sensors`: names of the sensors' columns; empty: all. Throws config::Error.
SensorData read_sensor_data(const Source& source, const CountScale& converter,
                            const std::string& known = "",
                            const std::vector<std::string>& sensors = {});
SensorData parse_sensor_data(std::string_view text, const Source& source,
                             const CountScale& converter, const std::string& known = "",
                             const std::vector<std::string>& sensors = {});

}  // namespace sinew::identify
