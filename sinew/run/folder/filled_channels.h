// run/folder/filled_channels.h - what a recording of a machine lacks and what it has says.
//
// A laboratory records angles in degrees; a replay feeds the controller with the counts of its
// converter. Either follows from the other by the scales that the controller believes, of a
// transducer for forces by its own:
//
//   angle   = rest_angle + (count - assumed.at_rest) / assumed.scale
//   tension = (count - assumed.at_rest) / (scale counts_per_volt)
//   gauge   = (count - assumed.at_rest) / (assumed.scale counts_per_volt)
//   travel  = (count - assumed.at_rest) / assumed.scale
//
// Counts are whole, and end with the converter.
#pragma once

#include <string>
#include <vector>

#include "sinew/robot/robot.h"
#include "sinew/signals/table.h"

namespace sinew::run {

// Adds /sensor/<name>/count where its quantity is there, and the quantity where the counts are, if
// it is among the `logged`, those that a run logs; what was added says so in its description.
// `atmosphere` [Pa]. Returns a sentence for each kind of
// thing that was done, and for counts beyond the converter's ends.
std::vector<std::string> fill_channels(signals::Table& table, const robot::Robot& robot,
                                       double atmosphere,
                                       const std::vector<signals::Topic>& logged);

}  // namespace sinew::run
