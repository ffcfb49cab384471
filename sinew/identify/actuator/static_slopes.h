// identify/actuator/static_slopes.h - the force of a static law for one muscle, with its
// derivatives by everything that a fit sets free: those of the tension (actuator/tension_slopes.h),
// as the muscle's parameters are multiples of the reference's (static_model.h).
#pragma once

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// The derivatives of the force of one point.
struct ForceSlopes {
  StaticSetting by_knob;      // in the place of each knob (value_of)
  double by_length = 0;       // at one rest length [N/m]
  double by_rest_length = 0;  // at one length of the muscle [N/m]

  // Returns that by the error of the muscle's label, which the mount at rest has as well  [N/m].
  double by_label(const StaticPoint& point) const {
    return by_rest_length + (at_rest(point.length, point.rest_length) ? by_length : 0);
  }
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
