// identify/fit/evidence.h - what a report has beside its models: how sure the chosen one is, what
// was measured and left out, and what a further measurement would buy.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sinew::identify {

// The chosen model along one group of rows, between and beyond them: its value, and the half-widths
// about it that hold 68 and 95 % of measured ones; not finite where nobody knows.
struct PredictedCurve {
  std::string group;
  std::vector<double> at, value, half_68, half_95;  // as in Rows
};

// A measurement that no fit has seen, with what explains it where that is known.
struct OmittedRow {
  double at = 0, measured = 0;  // as in Rows
  std::string group;
  std::string why;  // "1/10 of what the law has: a slipped decimal?"
};

// Holds what was left out for one reason.
struct Omitted {
  std::string reason;            // "pressure still moving"
  std::string told_by;           // how it was told from the others
  std::size_t count = 0;         // how many were
  std::vector<OmittedRow> rows;  // all of them, or evenly some where there are many
};

// A length, the pressures to read at, and the errors that are expected afterwards.
struct FurtherMount {
  double length = 0;              // [m]
  std::vector<double> pressures;  // gauge, up and down again [Pa]
  std::size_t readings = 0;
  double time = 0;           // of this one and those before [s]
  double rms = 0, half = 0;  // root mean square, half of 95 % at the worst place  [%]
};

// Says what further measurements of one muscle would buy, the most useful first.
struct Further {
  std::string of;            // "the muscle of 225 mm"; empty: there is but one
  std::size_t readings = 0;  // that there are
  double rms = 0, half = 0;  // expected before any of them  [%]
  std::vector<FurtherMount> mounts;
  std::string note;  // what is taken for granted
};

}  // namespace sinew::identify
