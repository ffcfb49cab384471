// actuator/operating_point.h - all laws of an actuator at one length and one pressure.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sinew/actuator/actuator.h"

namespace sinew::actuator {

// The surroundings of the actuator's air.
struct Surroundings {
  double atmosphere = 0;           // pressure to which gauge pressures refer [Pa]
  double polytropic_exponent = 0;  // exponent of the air when valves are shut
  double external_volume = 0;      // hose and fittings up to the valves [m3]
};

struct OperatingPoint {
  static constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

  double length = 0, gauge_pressure = 0;  // [m], [Pa]
  double tension = 0;                     // at rest, without losses [N]
  double effectiveness = 0;
  double coulomb_bound = 0;                            // bound of the dry friction [N]
  double velocity = not_given;                         // rate of the length [m/s]
  double sliding_tension = not_given;                  // tension with losses, [33] [N]
  double viscous_loss = not_given;                     // its viscous part [N]
  double stiffness_at_constant_pressure = 0;           // [26] [N/m]
  double stiffness_sealed = 0, passive_stiffness = 0;  // valves shut, and without air [N/m]
  double volume = 0, diameter = 0, braid_angle = 0;    // [m3], [m], [rad]; NaN: not defined
  double half_68 = not_given, half_95 = not_given;     // measured forces about the law [N];
                                                       // NaN: unknown, see prediction.h
  std::vector<std::string> beyond;  // limits of the model that are exceeded, as text
};

// Evaluates the laws at `length` [m] and `gauge` pressure [Pa], and at `velocity` [m/s] if given.
OperatingPoint operating_point(const Actuator& a, double length, double gauge,
                               const Surroundings& around,
                               double velocity = OperatingPoint::not_given);

}  // namespace sinew::actuator
