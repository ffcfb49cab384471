// identify/actuator/static_slopes.h - the force of a static law with its derivatives by everything
// that a fit sets free, for one muscle.
//
//   B(x, p)   pull of braid and bladder, pull.h        F = F_t(B)       x = L - C F, series.h
//
//   dF/dq = s dB/dq       s = F_t'/(1 + C F_t' dB/dx)       dF/dL = s dB/dx
//   dF/dC = -F dF/dL      dF/dF_toe = (F - F_t' B)/F_toe / (1 + C F_t' dB/dx)
//
//   q  a parameter of the muscle's own actuator, or the pressure. A law of several muscles has the
//      parameters of the reference, of which the muscle's are multiples (static_model.h).
#pragma once

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// The derivatives of the force of one point.
struct ForceSlopes {
  StaticSetting by_knob;      // in the place of each knob (value_of)
  double by_length = 0;       // at one rest length [N/m]
  double by_rest_length = 0;  // at one length of the muscle [N/m]
};

// The law of one muscle.
class MuscleLaw {
 public:
  // `labelled` is its rest length as labelled  [m].
  MuscleLaw(const StaticSetting& setting, const StaticScales& scales, double labelled);

  // Returns the force at a length [m] at the pressure and on the branch of a point: below zero
  // where the muscle would push  [N].
  double force(double length, const StaticPoint& point) const;

  // Writes the derivatives of that force.
  void write_slopes(double length, const StaticPoint& point, double force, ForceSlopes& out) const;

 private:
  // A knob of which the muscle's own value depends on its rest length: how it grows with the
  // logarithm of that, and what it is the reference's times.
  struct Multiple {
    Knob knob;
    double grows = 0, factor = 1;
  };

  StaticSetting own_;
  double rest_length_, atmosphere_;  // its own [m], [Pa]
  std::vector<Multiple> multiples_;
};

}  // namespace sinew::identify
