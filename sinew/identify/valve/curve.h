// identify/valve/curve.h - preparation of a pressure that rises or falls once: its start and end,
// the part to be fitted, and checks.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/data/measured.h"

namespace sinew::identify {

struct Curve {
  std::vector<double> time, pressure;  // [s], [Pa abs]; the part that is fitted
  double start = 0, end = 0;           // before it moves, and settled value [Pa abs]
  double opening = 0;                  // approximate start of the motion [s]
  bool opening_seen = false;           // the record begins before the opening
  bool settled = true;                 // nearly constant at its end
  double rate = 0;                     // dP/dt between 15 and 50 % of the change [Pa/s]
  std::vector<std::string> notes;

  // Return whether the pressure rises, its change [Pa], and the share of the change at a pressure.
  bool fills() const { return end > start; }
  double range() const { return fills() ? end - start : start - end; }
  double share(double p) const { return (p - start) / (end - start); }
};

// Prepares the columns `time` and `pressure`. Throws Refusal if the pressure is constant, there are
// too few samples, the sensor clips the curve, or it reverses.
Curve curve_of(const Measured& data);

}  // namespace sinew::identify
