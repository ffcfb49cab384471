// run/simulation/card_place.h - an experiment's machine at a card in this computer: which sensor is
// on which channel and which valve on which bit is said by robot and wiring.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/host/realtime.h"
#include "sinew/port/comedi/comedi_port.h"

namespace sinew::run {

// Throws config::Error for an experiment whose machine no card can drive.
plant::CardMachine card_machine(const experiment::Experiment& experiment, const std::string& place);

// A card that is open, with the clock of the loop that will drive it.
struct CardPlace {
  // Measures first how late this computer is, for a second.
  CardPlace(const std::string& device, const experiment::Experiment& experiment,
            const std::string& place);

  // How late this computer was, and what it does not permit.
  std::vector<std::string> told() const;

  host::Beat beat;
  plant::ComediPort port;
  host::Latency latency;
  std::vector<std::string> not_permitted;
};

}  // namespace sinew::run
