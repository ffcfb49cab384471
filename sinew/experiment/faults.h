// experiment/faults.h - the list [[fault]] of an experiment as a whole: what is wrong with it, and
// how it is told.
#pragma once

#include <string>
#include <vector>

#include "sinew/experiment/experiment.h"
#include "sinew/robot/robot.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

// Adds what cannot be: parts that do not exist, words of other parts, two faults of one part of the
// air at a time.
void check_faults(const Experiment& experiment, std::vector<robot::Contradiction>& out);

// Returns where the log has whether a fault acts, "/true/valve/hip_flexor/inlet/fault".
std::string topic_of(const Fault& fault);

// "hip_flexor.inlet stuck open from 3 s to 3.2 s", "hip_flexor leaking (0.1 mm2) from 1 s on".
std::string in_words(const Fault& fault);

// Returns why a fault changes nothing of a run that ends at `end`, at a tick: it begins too late,
// its amount is 0, or it falls between two readings of its sensor. Empty: it acts.
std::string why_idle(const Experiment& experiment, const Fault& fault, signals::Tick end);

}  // namespace sinew::experiment
