#include "sinew/run/simulation/run.h"

#include <string_view>

#include <fmt/format.h>

#include "sinew/control/setup/supervision.h"
#include "sinew/robot/actuator_of.h"
#include "sinew/run/setup/installation.h"
#include "sinew/units/quantity.h"

namespace sinew::run {

namespace {

std::string_view word(signals::Status status) {
  using signals::Status;
  if (status == Status::late) return "a late reading";
  if (status == Status::invalid) return "an invalid reading";
  return status == Status::ended ? "the body's end" : "a fault";
}

std::string inches(double metres) { return units::format_quantity(metres, "m", "in"); }

// Returns the length at which the braid's chamber has no volume, if that is the cause.
std::string describe_length(const air::Failure& failure, const actuator::Actuator& actuator) {
  const double thread = actuator.braid.thread_length, caps = actuator.caps.length;
  if (failure.length <= caps)
    return fmt::format(
        "it was {} long, where a muscle has no volume; try a smaller moment arm or "
        "a longer mount_length",
        inches(failure.length));
  if (failure.length - caps >= thread)
    return fmt::format(
        "it was {} long, where its thread of {} is straight and holds no air; try "
        "an external_volume above 0, or a smaller moment arm",
        inches(failure.length), inches(thread));
  return {};
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

std::string to_text(const air::Failure& failure, const std::string& who,
                    const actuator::Actuator& actuator, const std::string& step) {
  using Of = air::Failure::Of;
  std::string what = "the motion";
  if (failure.of == Of::air) what = "the air of " + who;
  if (failure.of == Of::cylinder) what = "the air of the cylinder";
  what += fmt::format(" was not finite at {:.4f} s: ", failure.time);
  const std::string remedy = "less stiffness or damping, or a smaller " + step;
  const double thread = actuator.braid.thread_length;
  const bool near = failure.length > -thread && failure.length < 2 * thread;
  const std::string length =
      failure.of == Of::air && near ? describe_length(failure, actuator) : std::string();
  if (length.empty()) return what + "the motion ran away; try " + remedy;
  return failure.time > 0 ? what + length + "; or, where the motion ran away, " + remedy
                          : what + length;
}

}  // namespace sinew::run
