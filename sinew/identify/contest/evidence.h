// identify/contest/evidence.h - additional parts of a report: intervals of the chosen model,
// measurements that were left out, and the benefit of further measurements.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sinew::identify {

// Chosen model along one group of rows, also between and beyond them: its value, and the
// half-widths that contain 68 and 95 % of measured values; not finite if unknown.
struct PredictedCurve {
  std::string group;
  std::vector<double> at, value, half_68, half_95;  // as in Rows
};

// A measurement that was left out of every fit, with its probable cause if known.
struct OmittedRow {
  double at = 0, measured = 0;  // as in Rows
  std::string group;
  std::string why;  // e.g. "1/10 of what the law has: a slipped decimal?"
};

// Measurements left out for one reason.
struct Omitted {
  std::string reason;            // e.g. "pressure still moving"
  std::string criterion;         // criterion that recognised them
  std::size_t count = 0;         // number left out
  std::vector<OmittedRow> rows;  // all of them, or an even selection
};

// A mount to measure, its pressures, and the errors expected afterwards.
struct FurtherMount {
  double length = 0;              // [m]
  std::vector<double> pressures;  // gauge, rising then falling [Pa]
  std::size_t readings = 0;
  double time = 0;           // for this mount and those before [s]
  double rms = 0, half = 0;  // root mean square, and half-width of 95 % at the worst place [%]
};

// Further measurements of one muscle, the most useful first.
struct Further {
  std::string of;            // e.g. "the muscle of 225 mm"; empty: a single muscle
  std::size_t readings = 0;  // existing readings
  double rms = 0, half = 0;  // expected before the first mount [%]
  std::vector<FurtherMount> mounts;
  std::string note;  // assumptions
};

}  // namespace sinew::identify
