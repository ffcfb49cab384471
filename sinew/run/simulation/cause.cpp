#include <fmt/format.h>

#include <string>
#include <string_view>

#include "sinew/control/setup/supervision.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/run/setup/failure.h"
#include "sinew/run/setup/installation.h"
#include "sinew/run/simulation/run.h"

namespace sinew::run {
namespace {

std::string_view word(signals::Status status) {
  using signals::Status;
  if (status == Status::late) return "a late reading";
  if (status == Status::invalid) return "an invalid reading";
  return status == Status::ended ? "the body's end" : "a fault";
}

}  // namespace

std::string cause_of(const experiment::Experiment& e, const Outcome& outcome) {
  const ControllerTotals& controller = outcome.controller;
  if (e.stand && outcome.failure) {
    actuator::Actuator its;
    for (const actuator::Actuator& a : e.actuators)
      if (a.name == e.stand->element.actuator) its = a;
    return to_text(outcome.failure, "element " + e.stand->element.name, its, "step");
  }
  if (outcome.failure) {
    const auto m = static_cast<std::size_t>(outcome.failure.muscle);
    if (m >= e.robot.muscles.size()) return to_text(outcome.failure, "", {}, "plant_steps.body");
    const robot::Muscle& muscle = e.robot.muscles[m];
    return to_text(outcome.failure, "muscle " + muscle.name,
                   robot::actuator_of(muscle, e.actuators), "plant_steps.body");
  }
  const robot::Robot parts = named_parts(e);
  const std::string tripped =
      control::to_text(outcome.supervised.trip, parts, outcome.supervised.board);
  if (!tripped.empty()) return tripped;
  if (!outcome.line.empty()) return outcome.line + fmt::format(" at {:.4f} s", outcome.duration);
  const bool by_sensor = controller.fault != signals::Status::ok;
  std::string text(word(by_sensor ? controller.fault : outcome.status));
  if (by_sensor && controller.fault_channel.index < parts.sensors.size())
    text += " of sensor " + parts.sensors[controller.fault_channel.index].name;
  return text + fmt::format(" at {:.4f} s", outcome.duration);
}

}  // namespace sinew::run
