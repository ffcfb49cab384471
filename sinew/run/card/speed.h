// run/card/speed.h - how fast a graphics card is.
#pragma once

#include "sinew/experiment/experiment.h"

namespace sinew::run {

class Card;  // on_card.h

// Runs an experiment, which a batch can hold (batch.h), with Card::runs() seeds in one launch
// without recording. Returns the runs per second of that launch, copies to the card and back
// included; the program has been compiled before. Throws std::runtime_error if the card fails, or
// if a run does not end as it does on the processor.
double runs_per_second(Card& card, const experiment::Experiment& experiment);

}  // namespace sinew::run
