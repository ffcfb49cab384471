// identify/task/scale_task.h - `sinew identify scale`: the actuator of a muscle that nobody
// measured, from the file of one of its make and another rest length.
#pragma once

#include <string>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them.
struct ScaleSettings {
  std::string file, rest_length, actuator, reading, name, atmosphere = "14.7 psi";
};

template <class Visitor>
void fields(Visitor& v, ScaleSettings& s) {
  v.method(
      {"scale", "a muscle of another rest length than those that were measured", Tables::none});
  v.file(Setting{"file", "an actuator that `identify static` wrote"}.required().called("FILE"),
         s.file);
  v.quantity(Setting{"rest_length", "of the new muscle, without pressure and load", "m",
                     config::above_zero(1000, "of a muscle")}
                 .required(),
             s.rest_length);
  v.text({"actuator", "which one, where the file has several"}, s.actuator);
  v.text(
      {"reading", "one of the new muscle at rest, to correct the law: \"LENGTH, PRESSURE, FORCE\""},
      s.reading);
  v.text({"name", "of the new actuator; as in the file"}, s.name);
  v.text({"atmosphere", "the pressure of the room"}, s.atmosphere);
}

// The new muscle.
struct ScaleFound {
  actuator::Actuator actuator;
  double from = 0;          // rest length of the muscle in the file [m]
  double largest = 0;       // force of the new one where the old one was measured [N]
  double corrected_by = 1;  // what its reading made of the law [-]
  std::string file;         // sinew.actuator/1
};

// Throws config::Error for a file or a value that is none, Refusal where the file does not have
// the muscle's rest length or the reading is of something else.
ScaleFound find_scaled(const ScaleSettings& settings);

// Returns it as `--json` prints it, in SI; null where it is unknown.
Json to_json(const ScaleFound& found);

}  // namespace sinew::identify
