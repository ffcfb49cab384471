// run/simulation/card_place.h - an experiment's machine at a card in this computer. Robot and
// wiring assign sensors to channels and valves to bits.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/host/realtime.h"
#include "sinew/port/comedi/comedi_port.h"

namespace sinew::run {

// Returns the machine as a card drives it. Throws config::Error if no card can drive it.
plant::CardMachine card_machine(const experiment::Experiment& experiment, const std::string& place);

// An open card, with the clock of the loop that will drive it.
struct CardPlace {
  // Measures the latency of this computer for a second, then opens the card.
  CardPlace(const std::string& device, const experiment::Experiment& experiment,
            const std::string& place);

  // Returns lines with the latency of this computer and the real-time features that it lacks.
  std::vector<std::string> messages() const;

  host::TickTimer beat;
  plant::ComediPort port;
  host::Latency latency;
  std::vector<std::string> not_permitted;
};

}  // namespace sinew::run
