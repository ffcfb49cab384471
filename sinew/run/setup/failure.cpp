#include "sinew/run/setup/failure.h"

#include <fmt/format.h>

#include "sinew/units/quantity.h"

namespace sinew::run {
namespace {

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
