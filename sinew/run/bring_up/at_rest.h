// run/bring_up/at_rest.h - a sensor of a machine that hangs empty and still: what it reads, and
// what is wrong with that.
#pragma once

#include <string>

#include "sinew/control/supervise/limits.h"
#include "sinew/robot/robot.h"
#include "sinew/run/bring_up/trial.h"

namespace sinew::run {

struct Rest {
  double mean = 0, deviation = 0;  // [count]
  int readings = 0, bad = 0;       // bad: did not come in time, or are none
};
// Returns what a channel read while nothing moved.
Rest rest_of(const Recording& recording, std::size_t channel);

// Returns what is wrong with it and what to look at, in a sentence; empty: nothing. `top` is the
// converter's highest count, `wire` says where the sensor is wired.
std::string wrong_with(const robot::Sensor& sensor, const Rest& rest,
                       const control::SensorLimits& limits, double top, const std::string& wire);

}  // namespace sinew::run
