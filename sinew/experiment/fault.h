// experiment/fault.h - a fault during an experiment: an item of the list [[fault]]. A sensor gives
// wrong readings; a part of the air leaks, sticks or fails physically.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "sinew/robot/robot.h"

namespace sinew::experiment {

struct Fault {
  // Kind of fault.
  enum class What {
    // sensors
    open,     // broken wire: the converter's input is pulled up to its top count
    shorted,  // short circuit to ground: count 0
    stuck,    // counts keep their value from the start until the fault ends
    offset,   // counts are added, until the fault ends
    slip,     // a potentiometer slips on its shaft: counts are added permanently
    noise,    // noise of this standard deviation, in addition to the sensor's own
    dropout,  // conversions are not ready in time; the last counts remain

    // air
    stuck_open,  // a valve, independent of its coil
    stuck_shut,
    leaking,   // a valve that does not seal, or a muscle
    ruptured,  // a muscle: a hole to the room
    blocked,   // a muscle's hose: nothing passes
    failed,    // the supply: its line has another pressure
  };

  double at = 0;                  // begin; sensors: the first reading that it affects [s]
  double lasts = robot::not_set;  // `for`; not set: to the end of the run [s]
  std::string of;                 // a sensor, "hip_flexor.inlet", "hip_flexor" or "supply"
  What what = What::open;
  double amount = robot::not_set;  // offset, slip, noise [count]; dropout: share of readings [-]

  double area =
      robot::not_set;      // area of the hole (leaking, ruptured); not set: 0 or default [m^2]
  double conductance = 0;  // leaking: mass flow per pressure difference [kg/(s Pa)]
  double share = 0;        // leaking: share of a valve's area that stays open [-]
  double pressure = robot::not_set;  // failed: pressure of the line, absolute; not set: room [Pa]
};

// Returns whether a fault of this kind is one of a sensor.
constexpr bool is_of_sensor(Fault::What what) { return what < Fault::What::stuck_open; }

// Returns the unit of the fault's amount; "" if it has no amount.
constexpr std::string_view unit_of_amount(Fault::What what) {
  using enum Fault::What;
  if (what == offset || what == slip || what == noise) return "count";
  return what == dropout ? "1" : "";
}

// Returns the end of a fault [s]; infinite: it lasts to the end of the run.
inline double end_of(const Fault& fault) {
  return std::isfinite(fault.lasts) ? fault.at + fault.lasts
                                    : std::numeric_limits<double>::infinity();
}

// Returns whether the fault acts at that time [s].
inline bool acts(const Fault& fault, double time) {
  return time >= fault.at && !(time >= fault.at + fault.lasts);
}

}  // namespace sinew::experiment
