// identify/sensor/sensor_file.h - a calibration as the sensors of a robot's file, and for programs.
#pragma once

#include <string>

#include "sinew/config/node.h"
#include "sinew/identify/sensor/sensor.h"
#include "sinew/json/json.h"
#include "sinew/robot/robot.h"

namespace sinew::identify {

// Returns the kind of a robot's sensor.
robot::Sensor::Kind kind_of(SensorKind kind);

// Return the scale that a robot's file has for a sensitivity, its uncertainty and its SI unit:
// potentiometers are given per volt, "rad/V", transducers in volts, "V/N".
double scale_of(const Calibration& c, double sensitivity);
double scale_uncertainty(const Calibration& c, const SensorResult& r);
std::string scale_unit(const Calibration& c);

// Returns that unit where the known values were in `display`: "V/lbf", "deg/V".
std::string scale_unit_for(const Calibration& c, const std::string& display);

// Returns the text of a robot's file: `robot`, the beginning of one (robot_over.h), with the
// sensors. `average`: the controller believes in one scale for all of them, as the thesis's did.
std::string sensor_file(const Calibration& c, const CountScale& converter, bool average,
                        config::Node robot);

// Returns format sinew.identification/1 of a calibration; what there is of a single sensor stands
// where other methods have it.
Json to_json(const Calibration& c);

}  // namespace sinew::identify
