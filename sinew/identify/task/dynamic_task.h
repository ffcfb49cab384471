// identify/task/dynamic_task.h - `sinew identify dynamic`: what a muscle loses in motion, from a
// mass that swings on trapped air.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/motion/dynamic.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them.
struct DynamicSettings {
  std::string actuator, name, mass, pressure, external_volume = "0 m3", exponent;
  int count = 1;
  HeldOut hold_out;
  std::string model;
  WishTexts wishes;
};

constexpr config::Range parallel_actuators = {1, 100, "actuators in parallel"};

template <class Visitor>
void fields(Visitor& v, DynamicSettings& s) {
  v.method({.name = "dynamic",
            .doc = "viscous loss and dry friction from a mass that swings on trapped air"});
  v.file(
      {.name = "actuator", .doc = "file with braid, tension and ends; a start", .required = true},
      s.actuator);
  v.text({.name = "name", .doc = "which actuator, where the file has several"}, s.name);
  v.quantities({.name = "mass",
                .unit = "kg",
                .range = config::above_zero(1e6, "hangs on the muscle"),
                .doc = "that moves; one, or one per file with commas",
                .required = true},
               s.mass);
  v.quantities(
      {.name = "pressure",
       .unit = "Pa abs",
       .range = config::air_pressure,
       .doc = "of the air as the mass hangs; one, or one per file; absent: the measured one"},
      s.pressure);
  v.quantities({.name = "external_volume",
                .unit = "m3",
                .range = config::air_volume,
                .doc = "of hose and fittings up to the shut valve; one, or one per file"},
               s.external_volume);
  v.quantity({.name = "exponent",
              .unit = "1",
              .range = config::polytropic,
              .doc = "of the trapped air; absent: from the measured pressure, else 1.4 [39]"},
             s.exponent);
  v.integer({.name = "count", .range = parallel_actuators, .doc = "actuators in parallel"},
            s.count);
  v.hold_out({.name = "hold_out",
              .doc = "a file that scores the laws and is not fitted; absent: each file in turn, or "
                     "the last third of the only one",
              .repeats = true},
             s.hold_out);
  v.choice({.name = "model", .doc = "only this law", .words = dynamic_models()}, s.model);
  fields(v, s.wishes);
}

// Holds what was found, with the actuator's file.
struct DynamicFound {
  DynamicResult result;
  std::string file;  // the actuator's, with its loss
};

// Throws config::Error and Refusal.
DynamicFound find_dynamic(const std::vector<Source>& sources, const DynamicSettings& settings);

// Returns the report with the values of each record alone, as `--json` prints it.
Json to_json(const DynamicFound& found);

}  // namespace sinew::identify
