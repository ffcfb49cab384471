// world/reading.h - what a converter makes of a machine: of a World, or of one that goes side
// by side with others.
#pragma once

#include <cmath>

#include "sinew/signals/port.h"

namespace sinew::plant {

// Returns the reading of a conversion that began at the tick `sampled`. The machine says failure()
// and ended(), and answers what its senses ask.
template <class Machine, class Senses>
signals::Reading reading(Machine& machine, const Senses& senses, signals::Channel channel,
                         signals::Tick sampled) noexcept {
  if (channel.index >= senses.channels()) return {0, signals::Status::invalid};
  const double t = static_cast<double>(sampled) * signals::tick_seconds;
  const double value = senses.quantity(machine, channel.index, t);
  // A state that ran away never comes back: every later reading says so too.
  if (machine.failure() || !std::isfinite(value)) return {0, signals::Status::fault};
  return {senses.counts(channel.index, value, sampled),
          machine.ended() ? signals::Status::ended : signals::Status::ok};
}

}  // namespace sinew::plant
