// identify/task/sensor_task.h - `sinew identify sensor`: calibrations to the sensors of a robot's
// file.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/sensor/sensor.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them.
struct SensorSettings {
  std::string known;
  std::vector<std::string> sensors;
  std::string rest;
  int bits = 12;
  std::string full_scale = "5 V";
  HeldOut hold_out;
  bool average = false;
  std::string base;
};

template <class Visitor>
void fields(Visitor& v, SensorSettings& s) {
  v.method({"sensor", "scale, offset, linearity, hysteresis and noise of calibrated sensors"});
  v.text({"known",
          "load, force, tension, angle, length, position, pressure or velocity: what was set, "
          "where the file has several"},
         s.known);
  v.texts(Setting{"sensors", "columns to calibrate; absent: all in volts or counts"}.at_commas(),
          s.sensors);
  v.quantity({"rest", "the known value at the joint's rest angle; absent: 0"}, s.rest);
  v.integer({"bits", "of the converter", "", {1, 16, "of a converter"}}, s.bits);
  v.quantity({"full_scale", "of the converter", "V", config::above_zero(1000, "of a converter")},
             s.full_scale);
  v.hold_out({"hold_out",
              "level: every known value is predicted from the others; or another calibration; "
              "absent: level"},
             s.hold_out);
  v.flag({"average", "the controller assumes one scale for all of them, as the thesis's did"},
         s.average);
  v.file(Setting{"base", "the robot whose sensors these are: the parameter file is then a robot"}
             .of_file(),
         s.base);
}

// Holds what was found, and the robot's file that is written with it.
struct SensorFound {
  Calibration calibration;
  std::string display;  // unit of the known values, as they were given
  CountScale converter;
  bool average = false;
  std::string base;

  // The robot's file, as it would stand at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// Throws config::Error and Refusal.
SensorFound find_sensors(const std::vector<Source>& sources, const SensorSettings& settings);

// Return the scale that a robot's file has for a sensitivity, its uncertainty and its SI unit:
// potentiometers are given per volt, "rad/V", transducers in volts, "V/N".
double scale_of(const Calibration& c, double sensitivity);
double scale_uncertainty(const Calibration& c, const SensorResult& r);
std::string scale_unit(const Calibration& c);

// Returns that unit where the known values were in `display`: "V/lbf", "deg/V".
std::string scale_unit_for(const Calibration& c, const std::string& display);

// Returns format sinew.identification/1 of a calibration; what there is of a single sensor stands
// where other methods have it.
Json to_json(const Calibration& c);

}  // namespace sinew::identify
