// identify/pair/pair_record.h - one recording of a sealed pair that is moved: what was measured,
// and how fast it moved.
//
// Rate and acceleration are those of the parabola of least squares through the samples within
// `window`/2 of each, so that neither lags; a measured velocity, which often does, is not asked
// for.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

// time, force and displacement or torque and angle, pressure_1 and pressure_2 where there are such.
std::span<const Wanted> pair_columns();

// Samples of a slide (force, displacement) or of a joint (torque, angle).
struct PairRecord {
  std::string file;
  std::string rig = "rig";  // recordings of one rig have their sensors in common
  bool held_out = false;    // scored, but no physics is fitted to it
  bool rotary = false;
  std::vector<double> time;                   // [s]
  std::vector<double> at;                     // displacement [m] or angle [rad]
  std::vector<double> effort;                 // force [N] or torque [N m]
  std::vector<double> rate, acceleration;     // of `at`, per second and its square
  std::vector<std::vector<double>> pressure;  // of each muscle that has one, absolute [Pa]
  double resolution = 0;                      // smallest step between samples of `at`
  std::vector<std::string> notes;

  std::size_t size() const { return time.size(); }
};

// Returns the recording; `window` [s]. Throws Refusal for one without effort or position, with both
// kinds, with fewer than 100 samples, that does not move, or whose sensors are at their ends.
PairRecord pair_record(const Measured& data, double window = 0.02);

}  // namespace sinew::identify
