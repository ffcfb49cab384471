// experiment/fault.h - what breaks while an experiment runs: the list [[fault]]. Sensors, for now.
#pragma once

#include <string>
#include <string_view>

#include "sinew/robot/robot.h"

namespace sinew::experiment {

struct Fault {
  enum class What {
    open,     // its wire is broken: the converter's input is pulled up to its top count
    shorted,  // to ground: count 0
    stuck,    // the counts of the moment, for as long as it lasts
    offset,   // counts are added, for as long as it lasts
    slip,     // a potentiometer slips on its shaft: counts are added from then on
    noise,    // of a standard deviation, beside its own
    dropout,  // conversions do not come in time; the last counts stand
  };

  double at = 0;                  // first reading that it acts on [s]
  double lasts = robot::not_set;  // `for`; not set: to the end [s]
  std::string of;                 // sensor
  What what = What::open;
  double amount = robot::not_set;  // offset, slip, noise [count]; dropout: share of them [-]
};

// Does it take an amount, and in which unit? "" : none.
constexpr std::string_view unit_of_amount(Fault::What what) {
  using enum Fault::What;
  if (what == offset || what == slip || what == noise) return "count";
  return what == dropout ? "1" : "";
}

// Does it act at that time? [s]
inline bool acts(const Fault& fault, double time) {
  return time >= fault.at && !(time >= fault.at + fault.lasts);
}

}  // namespace sinew::experiment
