// identify/task/dynamic_task.h - `sinew identify dynamic`: what a muscle loses in motion, from a
// mass that swings on trapped air.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/motion/dynamic.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Quantities are one for all tables, or one for each between commas.
struct DynamicSettings {
  std::string actuator;                  // file with braid, tension and ends: a start
  std::string name;                      // which actuator, where the file has several
  std::string mass;                      // that moves
  std::string pressure;                  // of the air as the mass hangs; empty: the measured one
  std::string external_volume = "0 m3";  // of hose and fittings up to the shut valve
  std::string exponent;                  // of the trapped air; empty: from the pressure, else 1.4
  int count = 1;                         // actuators in parallel
  std::vector<Source> held_out;          // score the laws; may be among the tables
  std::string model;                     // this law alone; empty: all
  WishTexts wishes;                      // frozen, tied, prior
};

// Holds what was found, with the actuator's file.
struct DynamicFound {
  DynamicResult result;
  std::string file;  // the actuator's, with its loss
};

// Throws config::Error and Refusal; std::invalid_argument for a model that there is not.
DynamicFound find_dynamic(const std::vector<Source>& sources, const DynamicSettings& settings);

// Returns the report with what each record says by itself, as `--json` prints it.
Json to_json(const DynamicFound& found);

}  // namespace sinew::identify
