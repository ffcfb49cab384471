#include "sinew/run/setup/installation.h"

namespace sinew::run {

control::Installation installation(const experiment::Experiment& e) {
  return {.robot = e.robot,
          .actuators = e.actuators,
          .valves = e.valves,
          .atmosphere = e.air.atmosphere,
          .supply_pressure = e.supply.pressure,
          .timing = e.timing,
          .settle = e.start.settle};
}

}  // namespace sinew::run
