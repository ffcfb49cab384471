#include "sinew/experiment/failure.h"

#include <fmt/format.h>

#include "sinew/config/quantity.h"
#include "sinew/experiment/run.h"
#include "sinew/experiment/supervision.h"
#include "sinew/robot/actuator_of.h"

namespace sinew::experiment {
namespace {

std::string inches(double metres) { return config::format_quantity(metres, "m", "in"); }

// Where a braid's chamber has no volume, if that is why.
std::string length_in_words(const muscle::Failure& failure, const actuator::Actuator& actuator) {
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

std::string_view word(signals::Status status) {
  using signals::Status;
  if (status == Status::late) return "a late reading";
  if (status == Status::invalid) return "an invalid reading";
  return status == Status::ended ? "the body's end" : "a fault";
}

}  // namespace

std::string in_words(const muscle::Failure& failure, const std::string& who,
                     const actuator::Actuator& actuator, const std::string& step) {
  using Of = muscle::Failure::Of;
  std::string what = "the motion";
  if (failure.of == Of::air) what = "the air of " + who;
  if (failure.of == Of::cylinder) what = "the air of the cylinder";
  what += fmt::format(" was no number any more at {:.4f} s: ", failure.time);
  const std::string remedy = "less stiffness or damping, or a smaller " + step;
  const double thread = actuator.braid.thread_length;
  const bool near = failure.length > -thread && failure.length < 2 * thread;
  const std::string length =
      failure.of == Of::air && near ? length_in_words(failure, actuator) : std::string();
  if (length.empty()) return what + "the motion ran away; try " + remedy;
  return failure.time > 0 ? what + length + "; or, where the motion ran away, " + remedy
                          : what + length;
}

std::string cause_of(const Experiment& e, const Outcome& outcome) {
  const control::Seen& seen = outcome.seen;
  if (outcome.failure) {
    const auto m = static_cast<std::size_t>(outcome.failure.muscle);
    if (m >= e.robot.muscles.size()) return in_words(outcome.failure, "", {}, "plant_steps.body");
    const robot::Muscle& muscle = e.robot.muscles[m];
    return in_words(outcome.failure, "muscle " + muscle.name,
                    robot::actuator_of(muscle, e.actuators), "plant_steps.body");
  }
  const std::string tripped = to_text(outcome.supervised.trip, e);
  if (!tripped.empty()) return tripped;
  const bool by_sensor = seen.fault != signals::Status::ok;
  std::string text(word(by_sensor ? seen.fault : outcome.status));
  if (by_sensor && seen.fault_channel.index < e.robot.sensors.size())
    text += " of sensor " + e.robot.sensors[seen.fault_channel.index].name;
  return text + fmt::format(" at {:.4f} s", outcome.duration);
}

}  // namespace sinew::experiment
