// identify/sensor/sensor.h - calibration: what a sensor gives per newton, radian or pascal, and how
// well.
//
//   V_out = S_V x                    proportional    x    known value from rest (angle, no load)
//   V_out = V_0 + S_V x              line            V_0  output of the sensor there
//   V_out = V_0 + S_V x + S_2 x^2    quadratic       S_V  sensitivity at rest, V/N, V/rad, ...
//
// Fitted to the mean of the readings at every known value, each way by itself; errors are the
// output's, in percent of its span. The known values are taken for exact. Source: 4.4, 4.5,
// table 4-1 of Colbrunn, whose "% error from average" is (average - S_V)/S_V.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/fit/fit.h"
#include "sinew/identify/sensor/readings.h"

namespace sinew::identify {

// NaN where the data do not tell.
struct SensorResult {
  std::string name;
  Report report;
  std::size_t straight = 0;  // of the report's fits, the best straight one: robots know no other

  double sensitivity = 0,
         sensitivity_uncertainty = 0;           // V per unit of the known quantity; half 95 %
  double at_rest = 0, at_rest_uncertainty = 0;  // [V]
  double span = 0;                              // of the output  [V]
  double linearity = 0;   // largest distance of a point from the straight fit, of the span [-]
  double hysteresis = 0;  // largest difference between the two ways, of the span [-]
  double noise = 0;       // standard deviation of repeated readings [V]
  double step = 0;        // between readings: the resolution [V]
  double deviation = 0;   // (average - s)/s over all sensors [-]
};

// The scales of sensors of one kind.
struct Calibration {
  SensorKind kind = SensorKind::tension;
  std::string file;
  std::vector<SensorResult> sensors;
  double average = 0;  // of the sensitivities
  std::vector<std::string> notes, warnings;
};

// `rest`: the known value at rest. `other`: a second calibration of the same sensors that the
// models are scored on; without one every known value is predicted from the others. Throws Refusal
// where one of the sensors cannot be calibrated, and config::Error where `other` lacks one.
Calibration identify_sensors(const SensorData& data, const CountScale& converter, double rest = 0,
                             const SensorData* other = nullptr);

}  // namespace sinew::identify
