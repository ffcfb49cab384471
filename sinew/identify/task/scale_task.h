// identify/task/scale_task.h - `sinew identify scale`: the actuator of a muscle that nobody
// measured, from the file of one of its make and another rest length.
#pragma once

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// The settings of `sinew identify scale`, as texts.
struct ScaleSettings {
  std::string file;         // with the actuator that was identified
  std::string actuator;     // its name; empty: the only one
  std::string rest_length;  // of the new muscle, "120 mm"

  std::string reading;  // of the new muscle at rest, "115 mm, 4 bar gauge, 210 N"; empty: none
  std::string name;     // of the new actuator; empty: as in the file
  std::string atmosphere = "14.7 psi";
};

// The new muscle.
struct ScaleFound {
  actuator::Actuator actuator;
  double from = 0;          // rest length of the muscle in the file [m]
  double largest = 0;       // force of the new one where the old one was measured [N]
  double corrected_by = 1;  // what its reading made of the law [-]
  std::string file;         // sinew.actuator/1
};

// Throws config::Error for a file or a value that is none, Refusal where the file does not tell
// the muscle's rest length or the reading is of something else.
ScaleFound find_scaled(const ScaleSettings& settings);

// Returns it as `--json` prints it, in SI; null where nobody knows.
Json to_json(const ScaleFound& found);

}  // namespace sinew::identify
