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
  v.method({"dynamic", "viscous loss and dry friction from a mass that swings on trapped air"});
  v.file(Setting{"actuator", "file with braid, tension and ends; a start"}.required(), s.actuator);
  v.text({"name", "which actuator, where the file has several"}, s.name);
  v.quantities(Setting{"mass", "that moves; one, or one per file with commas", "kg",
                       config::above_zero(1e6, "hangs on the muscle")}
                   .required(),
               s.mass);
  v.quantities(
      {"pressure", "of the air as the mass hangs; one, or one per file; absent: the measured one",
       "Pa abs", config::air_pressure},
      s.pressure);
  v.quantities(
      {"external_volume", "of hose and fittings up to the shut valve; one, or one per file", "m3",
       config::air_volume},
      s.external_volume);
  v.quantity({"exponent", "of the trapped air; absent: from the measured pressure, else 1.4 [39]",
              "1", config::polytropic},
             s.exponent);
  v.integer({"count", "actuators in parallel", "", parallel_actuators}, s.count);
  v.hold_out(Setting{"hold_out",
                     "a file that scores the laws and is not fitted; absent: each file in turn, or "
                     "the last third of the only one"}
                 .repeated(),
             s.hold_out);
  v.choice({"model", "only this law"}, s.model, dynamic_models());
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
