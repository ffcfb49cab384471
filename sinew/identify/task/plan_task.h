// identify/task/plan_task.h - `sinew identify plan`: which lengths and pressures to measure so that
// a static law is known well enough, and how long that takes.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/plan/plan.h"
#include "sinew/identify/task/static_task.h"
#include "sinew/json/json.h"

namespace sinew::identify {

// Empty quantities are not known, or follow from the others.
struct PlanSettings {
  std::string rest_length;              // without pressure and load
  std::string diameter;                 // of the mesh, without pressure and load
  std::string actuator;                 // a file with a muscle like it, in place of the diameter
  std::string pressure;                 // the highest, "600 kPa gauge"
  std::string noise;                    // of one reading of force; empty: 2 N, or what data scatter
  std::string length_error = "0.1 mm";  // of a mount
  std::string law_error = "1 %";        // that the law is off by, of the largest force
  std::string error = "2 %";            // wanted, of the largest force
  std::string mount_time = "10 min", step_time = "30 s";
  std::string shortest, longest, lowest;  // the region; empty: where the muscle pulls
  std::string criterion = "mean";         // or worst
  int most = 12;                          // mounts
};

// Holds a plan, and for which muscle it is.
struct PlanFound {
  MeasurementPlan plan;
  ExpectedMuscle muscle;
  PlanOptions options;
  std::string subject;             // "a muscle of 250 mm, 12 mm wide"
  std::vector<std::string> notes;  // what was taken for granted, in sentences
  std::size_t measured = 0;        // readings that there are already
};

// Throw config::Error and Refusal. The first plans for a muscle that nobody has measured; the
// second says what to measure next: its settings are those of a static law, and its actuator's
// braid is known.
PlanFound find_plan(const PlanSettings& settings, double atmosphere = units::atmosphere);
PlanFound find_next(const std::vector<Source>& sources, const StaticSettings& how,
                    const PlanSettings& settings);

// Returns a table with a row for each reading, in order, whose force is to be filled in: then
// `sinew identify static` reads it.
std::string plan_table(const PlanFound& found);

// Returns the plan as `--json` prints it.
Json to_json(const PlanFound& found);

}  // namespace sinew::identify
