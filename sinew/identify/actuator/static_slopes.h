// identify/actuator/static_slopes.h - force of a static law for one muscle, with its derivatives by
// all fitted parameters: those of the tension (actuator/tension_slopes.h), as the muscle's
// parameters are multiples of the reference's (static_model.h).
#pragma once

#include "sinew/identify/actuator/static_data.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_model.h"

namespace sinew::identify {

// Derivatives of the force of one point.
struct ForceSlopes {
  StaticSetting by_parameter;  // stored in the place of each parameter (value_of)
  double by_length = 0;        // at constant rest length [N/m]
  double by_rest_length = 0;   // at constant length of the muscle [N/m]

  // Returns the derivative by the error of the label, which also moves the mount at rest [N/m].
  double by_label(const StaticPoint& point) const {
    return by_rest_length + (at_rest(point.length, point.rest_length) ? by_length : 0);
  }
};

// Force law of one muscle.
class MuscleLaw {
 public:
  // `labelled` is the labelled rest length [m].
  MuscleLaw(const StaticSetting& setting, const StaticScales& scales, double labelled);

  // Returns the force [N] at a length [m], at the pressure and on the branch of a point.
  // Negative where the muscle would push.
  double force(double length, const StaticPoint& point) const;

  // Writes the derivatives of that force.
  void write_slopes(double length, const StaticPoint& point, double force, ForceSlopes& out) const;

 private:
  // A parameter whose value depends on the muscle's rest length: its derivative by the logarithm of
  // that, and its ratio to the reference's value.
  struct Multiple {
    FreeParameter free_parameter;
    double grows = 0, factor = 1;
  };

  StaticSetting own_;
  double rest_length_, atmosphere_;  // muscle's own [m], [Pa]
  std::vector<Multiple> multiples_;
};

}  // namespace sinew::identify
