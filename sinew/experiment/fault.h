// experiment/fault.h - what breaks while an experiment runs: the list [[fault]]. Sensors, whose
// readings then lie, and parts of the air, which then really leak, stick or fail.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "sinew/robot/robot.h"

namespace sinew::experiment {

struct Fault {
  // Says what breaks.
  enum class What {
    // of a sensor
    open,     // its wire is broken: the converter's input is pulled up to its top count
    shorted,  // to ground: count 0
    stuck,    // the counts of the moment, for as long as it lasts
    offset,   // counts are added, for as long as it lasts
    slip,     // a potentiometer slips on its shaft: counts are added from then on
    noise,    // of a standard deviation, beside its own
    dropout,  // conversions do not come in time; the last counts stand

    // of the air
    stuck_open,  // a valve, whatever its coil says
    stuck_shut,
    leaking,   // a valve that does not seal, or a muscle
    ruptured,  // a muscle: a hole to the room
    blocked,   // a muscle's hose: nothing passes
    failed,    // the supply: its line stands at another pressure
  };

  double at = 0;                  // sensors: the first reading that it acts on; the air: begin [s]
  double lasts = robot::not_set;  // `for`; not set: to the end [s]
  std::string of;                 // sensor; "hip_flexor.inlet"; "hip_flexor"; "supply"
  What what = What::open;
  double amount = robot::not_set;  // offset, slip, noise [count]; dropout: share of them [-]

  double area =
      robot::not_set;      // leaking, ruptured: of the hole; not set: none, or its default [m^2]
  double conductance = 0;  // leaking: mass flow per pressure difference [kg/(s Pa)]
  double share = 0;        // leaking: of a valve's area, that stays open [-]
  double pressure = robot::not_set;  // failed: of the line, absolute; not set: the room's [Pa]
};

// Answers whether a word is one of the sensors'.
constexpr bool is_of_sensor(Fault::What what) { return what < Fault::What::stuck_open; }

// Does it take an amount, and in which unit? "" : none.
constexpr std::string_view unit_of_amount(Fault::What what) {
  using enum Fault::What;
  if (what == offset || what == slip || what == noise) return "count";
  return what == dropout ? "1" : "";
}

// Returns when it ends; infinite: it lasts to the end of the run [s].
inline double end_of(const Fault& fault) {
  return std::isfinite(fault.lasts) ? fault.at + fault.lasts
                                    : std::numeric_limits<double>::infinity();
}

// Does it act at that time? [s]
inline bool acts(const Fault& fault, double time) {
  return time >= fault.at && !(time >= fault.at + fault.lasts);
}

}  // namespace sinew::experiment
