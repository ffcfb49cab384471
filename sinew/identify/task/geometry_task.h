// identify/task/geometry_task.h - `sinew identify geometry`: thread length and turns of a braid,
// from lengths and diameters or from counted trapezoids.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/actuator/geometry.h"
#include "sinew/json/json.h"

namespace sinew::identify {

struct GeometrySettings {
  std::string name = "bpa";               // of the actuator
  std::string thread_thickness = "0 mm";  // taken off diameters
  std::string trapezoids;                 // "37,16": counted lengthwise and around
  std::string side;                       // of one trapezoid
};

// Holds what was found, with the actuator's file.
struct GeometryFound {
  actuator::Braid braid;
  std::optional<Report> report;  // none: it was counted
  std::string file;              // the actuator's
};

// Throw config::Error and Refusal. The first asks tables, the second what was counted.
GeometryFound find_geometry(const std::vector<Source>& sources, const GeometrySettings& settings);
GeometryFound count_geometry(const GeometrySettings& settings);

// Returns the report, if there is one, with the braid, as `--json` prints it.
Json to_json(const GeometryFound& found);

}  // namespace sinew::identify
