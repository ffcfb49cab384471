// design/methods.h - the design calculations: a result for the settings of settings.fields.h. All
// throw config::Error for a setting or a file that cannot be used.
#pragma once

#include "sinew/design/design.h"
#include "sinew/design/settings.fields.h"

namespace sinew::design {

// Calls `each` with default settings of every calculation, in the order of their help.
template <class Each>
void for_each_design(const Each& each) {
  each(JointSettings{});
  each(ValveSettings{});
  each(AirSettings{});
  each(LifeSettings{});
}

// Returns the feasible joints as a table, and the one with the fewest muscles and, among equals,
// the least air per stroke. The result has a robot file if `base` is set.
Result design(const JointSettings& settings);

// Returns the flow and the delays that a valve needs, and the valves of a catalogue that have them.
// It is refused if a valve is given by its flow and misses something.
Result design(const ValveSettings& settings);

// Returns the time, steps and distance on the store's air, with their spread, the store's exergy,
// and the cost of one more muscle. Refuses a store below the line's pressure.
Result design(const AirSettings& settings);

// Returns the cycles and the time until a muscle fails, the time to the first failure of all, and
// the probability that none fails, each as the range that its evidence allows.
Result design(const LifeSettings& settings);

}  // namespace sinew::design
