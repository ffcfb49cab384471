// identify/sensor/sensor.h - calibration of sensors: output per newton, radian or pascal, with its
// uncertainty.
//
//   V_out = S_V x                    proportional    x    known value from rest (angle, no load)
//   V_out = V_0 + S_V x              line            V_0  output of the sensor there
//   V_out = V_0 + S_V x + S_2 x^2    quadratic       S_V  sensitivity at rest, V/N, V/rad, ...
//
// Fitted to the mean of the readings at every known value, separately for each direction;
// errors are those of the output, in percent of its span. The known values are assumed exact.
// Source: 4.4, 4.5, table 4-1 of Colbrunn, whose "% error from average" is (average - S_V)/S_V.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/contest/fit.h"
#include "sinew/identify/sensor/readings.h"

namespace sinew::identify {

// Result for one sensor. Values that the data do not determine are NaN.
struct SensorResult {
  std::string name;
  Report report;
  std::size_t straight = 0;  // index of the best straight fit in the report: robots have no other

  double sensitivity = 0,
         sensitivity_uncertainty = 0;           // V per unit of the known quantity; half 95 %
  double at_rest = 0, at_rest_uncertainty = 0;  // [V]
  double span = 0;                              // span of the output [V]
  double linearity = 0;   // largest distance of a point from the straight fit / span [-]
  double hysteresis = 0;  // largest difference between both directions / span [-]
  double noise = 0;       // standard deviation of repeated readings [V]
  double step = 0;        // resolution: step between readings [V]
  double deviation = 0;   // (average - S_V)/S_V over all sensors [-]
};

// Calibration of sensors of one kind.
struct Calibration {
  SensorKind kind = SensorKind::tension;
  std::string file;
  std::vector<SensorResult> sensors;
  double average = 0;  // average sensitivity
  std::vector<std::string> notes, warnings;
};

// Calibrates the sensors. `rest`: the known value at rest. `other`: a second calibration of the
// same sensors to score the models; without it every known value is predicted from the others.
// Throws Refusal if a sensor cannot be calibrated, and config::Error if `other` lacks one.
Calibration identify_sensors(const SensorData& data, const CountScale& converter, double rest = 0,
                             const SensorData* other = nullptr);

}  // namespace sinew::identify
