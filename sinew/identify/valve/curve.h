// identify/valve/curve.h - a pressure that rises or falls once, made ready for a fit: where it
// begins and ends, which part of it tells something, and what speaks against it.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

struct Curve {
  std::vector<double> time, pressure;  // [s], [Pa abs]; the part that is fitted
  double start = 0, end = 0;           // before it moves, and where it settles [Pa abs]
  double opening = 0;                  // when it begins to move, roughly [s]
  bool opening_seen = false;           // the curve begins before
  bool settled = true;                 // it has all but stopped at its end
  double rate = 0;                     // dP/dt between 15 and 50 % of the way [Pa/s]
  std::vector<std::string> notes;

  // Does the pressure rise? And by how much does it change  [Pa].
  bool fills() const { return end > start; }
  double range() const { return fills() ? end - start : start - end; }
  double share(double p) const { return (p - start) / (end - start); }  // of the way
};

// Columns `time` and `pressure`. Throws Refusal where the pressure is constant, the samples are too
// few, the sensor's end cuts the curve, or it moves to and fro.
Curve curve_of(const Measured& data);

}  // namespace sinew::identify
