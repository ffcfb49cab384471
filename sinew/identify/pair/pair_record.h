// identify/pair/pair_record.h - one recording of a sealed pair that is moved: measured values and
// derivatives of the position.
//
// Rate and acceleration are those of the least squares parabola through the samples within
// `window`/2 of each, so they do not lag. A measured velocity, which often lags, is not used.
#pragma once

#include <cstddef>
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

// --- samples that are fitted or predicted ---

// Indices of samples of a recording, ascending.
using PairRows = std::vector<std::size_t>;

// Number of time blocks that cross-validation leaves out, one after the other.
inline constexpr std::size_t pair_blocks = 5;

// Returns the samples whose time is in [from, to], or those outside.
PairRows pair_rows(const PairRecord& record, double from, double to, bool inside);

// Returns the rows of the k-th of `pair_blocks` blocks, or those of all the others.
PairRows pair_block(const PairRows& rows, std::size_t k, bool inside);

// Returns the recording with every k-th sample, about 2000: more samples of a smooth series add no
// information.
PairRecord pair_thinned(const PairRecord& record);

}  // namespace sinew::identify
