// identify/task/geometry_task.h - `sinew identify geometry`: thread length and turns of a braid,
// from lengths and diameters or from counted trapezoids.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/actuator/geometry.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them.
struct GeometrySettings {
  std::string trapezoids, side, thread_thickness = "0 mm", name = "bpa";
};

template <class Visitor>
void fields(Visitor& v, GeometrySettings& s) {
  v.method({"geometry",
            "thread length and turns, from counted trapezoids or from lengths and diameters",
            Tables::optional});
  v.text({"trapezoids", "LENGTHWISE,AROUND counted on the opened mesh, instead of data"},
         s.trapezoids);
  v.quantity({"side", "of one trapezoid", "m",
              config::above_zero(1, "of one trapezoid between two threads")},
             s.side);
  v.quantity({"thread_thickness", "taken off diameters that were measured outside the threads", "m",
              config::from_zero(0.1, "of one thread")},
             s.thread_thickness);
  v.text({"name", "of the actuator"}, s.name);
}

// Holds what was found, with the actuator's file.
struct GeometryFound {
  actuator::Braid braid;
  std::optional<Report> report;  // none: it was counted
  std::string file;              // the actuator's
};

// Reads one table; without a table it takes the counted trapezoids. Throws config::Error and
// Refusal.
GeometryFound find_geometry(const std::vector<Source>& sources, const GeometrySettings& settings);

// Returns the report, if there is one, with the braid, as `--json` prints it.
Json to_json(const GeometryFound& found);

}  // namespace sinew::identify
