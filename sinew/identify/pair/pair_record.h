// identify/pair/pair_record.h - one recording of a sealed pair that is moved: measured values and
// derivatives of the position.
//
// Rate and acceleration are those of the least squares parabola through the samples within
// `window`/2 of each, so they do not lag. A measured velocity, which often lags, is not used.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// Returns the columns: time, force and displacement or torque and angle, pressure_1 and pressure_2
// if present.
std::span<const ColumnSpec> pair_columns();

// Samples of a slide (force, displacement) or of a joint (torque, angle).
struct PairRecord {
  std::string file;
  std::string rig = "rig";  // recordings of one rig have common sensors
  bool held_out = false;    // scored, but no physics is fitted to it
  bool rotary = false;
  std::vector<double> time;                // [s]
  std::vector<double> at;                  // displacement [m] or angle [rad]
  std::vector<double> effort;              // force [N] or torque [N m]
  std::vector<double> rate, acceleration;  // derivatives of `at`, per second and per second squared
  std::vector<std::vector<double>> pressure;  // for each muscle with a sensor, absolute [Pa]
  double resolution = 0;                      // smallest step between samples of `at`
  std::vector<std::string> notes;

  std::size_t size() const { return time.size(); }
};

// Returns the recording; `window` [s]. Throws Refusal for a recording without effort or position,
// with both kinds, with fewer than 100 samples, without motion, or with clipped sensors.
PairRecord pair_record(const Measured& data, double window = 0.02);

}  // namespace sinew::identify
