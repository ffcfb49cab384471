#include "sinew/run/setup/installation.h"

#include <cmath>

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

std::vector<control::Board> boards_of(const experiment::Experiment& e) {
  if (!e.stand) return control::boards(installation(e));
  const gas::Valve* inlet = find_valve(e, e.stand->element.inlet);
  const bool three_way = inlet != nullptr && inlet->kind == gas::Valve::Kind::three_way;
  const auto period = std::lround(e.stand->drive.period / signals::tick_seconds);
  return {control::stand_board(*e.stand, three_way, static_cast<std::uint16_t>(period))};
}

robot::Robot named_parts(const experiment::Experiment& e) {
  robot::Robot out = e.robot;
  if (!e.stand) return out;
  out.joints.emplace_back().name = e.stand->element.name;
  for (const robot::Transducer& t : e.stand->sensors) out.sensors.emplace_back().name = t.name;
  return out;
}

}  // namespace sinew::run
