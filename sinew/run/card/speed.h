// run/card/speed.h - how fast a graphics card is.
#pragma once

#include "sinew/experiment/experiment.h"

namespace sinew::run {

class Card;  // on_card.h

// Runs an experiment that fits_batch() with Card::runs() seeds in one launch, without recording.
// Returns the runs per second of that launch, including the copies to the card and back but not the
// compilation of its program. Throws std::runtime_error if the card fails, or if a run ends
// differently on the processor.
double runs_per_second(Card& card, const experiment::Experiment& experiment);

}  // namespace sinew::run
