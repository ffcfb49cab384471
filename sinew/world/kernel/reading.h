// world/kernel/reading.h - reading of a simulated machine's sensor.
#pragma once

#include <cmath>

#include "sinew/signals/port.h"

namespace sinew::plant {

// Returns the reading of a conversion that began at the tick `sampled`. The machine provides
// failure(), ended() and the functions that its senses call.
template <class Machine, class Senses>
signals::Reading reading(Machine& machine, const Senses& senses, signals::Channel channel,
                         signals::Tick sampled) noexcept {
  if (channel.index >= senses.channels()) return {0, signals::Status::invalid};
  const double t = static_cast<double>(sampled) * signals::tick_seconds;
  const double value = senses.quantity(machine, channel.index, t);
  // A state that is not finite stays so: every later reading reports the fault, too.
  if (machine.failure() || !std::isfinite(value)) return {0, signals::Status::fault};
  return {senses.counts(channel.index, value, sampled),
          machine.ended() ? signals::Status::ended : signals::Status::ok};
}

}  // namespace sinew::plant
