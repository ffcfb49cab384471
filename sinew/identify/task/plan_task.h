// identify/task/plan_task.h - `sinew identify plan`: which lengths and pressures to measure so that
// a static law is known well enough, and how long that takes.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/plan/plan.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings, as texts; fields() describes them. Empty quantities are not known, or follow from the
// others.
struct PlanSettings {
  std::string rest_length, branch = "both", diameter, actuator, pressure, noise;
  std::string length_error = "0.1 mm", law_error = "1 %", error = "2 %", criterion = "mean";
  std::string mount_time = "10 min", step_time = "30 s", shortest, longest, lowest;
  int most = 12;
};

// What is known of the muscle and of the measurement.
template <class Visitor>
void measurement_fields(Visitor& v, PlanSettings& s) {
  constexpr config::Range length = config::above_zero(1000, "of an actuator");
  v.quantity({.name = "rest_length",
              .unit = "m",
              .range = length,
              .doc = "of the muscle without pressure and load; without it the longest length"},
             s.rest_length);
  v.choice(
      {.name = "branch", .doc = "of DATA: fill, vent or both", .words = {"fill", "vent", "both"}},
      s.branch);
  v.quantity({.name = "diameter",
              .unit = "m",
              .range = config::above_zero(1, "of a muscle"),
              .doc = "of the mesh without pressure and load"},
             s.diameter);
  v.file({.name = "actuator",
          .doc = "a file with a muscle like it, in place of the diameter; with DATA: whose braid "
                 "is known"},
         s.actuator);
  v.quantity({.name = "pressure",
              .unit = "Pa gauge",
              .range = config::above_zero(5e6, "above the room's, in a muscle"),
              .doc = "the highest that will be measured"},
             s.pressure);
  v.quantity({.name = "noise",
              .unit = "N",
              .range = config::above_zero(1e4, "of a force"),
              .doc = "of one reading of force, a standard deviation; absent: 2 N, or what DATA "
                     "scatter"},
             s.noise);
  v.quantity({.name = "length_error",
              .unit = "m",
              .range = config::from_zero(0.1, "of a mount"),
              .doc = "of a mount's length"},
             s.length_error);
}

// What is wanted.
template <class Visitor>
void aim_fields(Visitor& v, PlanSettings& s) {
  constexpr config::Range time = config::from_zero(86400, "more than a day for one step");
  constexpr config::Range length = config::above_zero(1000, "of an actuator");
  v.quantity({.name = "law_error",
              .unit = "1",
              .range = config::from_zero(0.5, "of the largest force"),
              .doc = "that the law itself is off by, of the largest force; no measurement lowers "
                     "it"},
             s.law_error);
  v.quantity({.name = "error",
              .unit = "1",
              .range = config::above_zero(0.5, "of the largest force"),
              .doc = "wanted, of the largest force"},
             s.error);
  v.choice({.name = "criterion",
            .doc = "mean: the error is a root mean square over the region; worst: half of the 95 % "
                   "interval at its worst place",
            .words = {"mean", "worst"}},
           s.criterion);
  v.quantity({.name = "mount_time", .unit = "s", .range = time, .doc = "to change the length"},
             s.mount_time);
  v.quantity({.name = "step_time",
              .unit = "s",
              .range = time,
              .doc = "to change the pressure, wait and read"},
             s.step_time);
  v.quantity({.name = "shortest",
              .unit = "m",
              .range = length,
              .doc = "length at which the law is wanted"},
             s.shortest);
  v.quantity({.name = "longest",
              .unit = "m",
              .range = length,
              .doc = "length at which it is; absent: the rest length"},
             s.longest);
  v.quantity({.name = "lowest",
              .unit = "Pa gauge",
              .range = config::above_zero(5e6, "above the room's, in a muscle"),
              .doc = "pressure at which it is"},
             s.lowest);
  v.integer({.name = "most",
             .range = {3, 100, "mounts; fewer cannot try a law"},
             .doc = "mounts at most"},
            s.most);
}

template <class Visitor>
void fields(Visitor& v, PlanSettings& s) {
  v.method({.name = "plan",
            .doc = "which lengths and pressures to measure for an error, and in how many minutes",
            .tables = Tables::optional,
            .has_file = false});
  measurement_fields(v, s);
  aim_fields(v, s);
}

// Holds a plan, and for which muscle it is.
struct PlanFound {
  MeasurementPlan plan;
  ExpectedMuscle muscle;
  PlanOptions options;
  std::string subject;             // "a muscle of 250 mm, 12 mm wide"
  std::vector<std::string> notes;  // what was taken for granted, in sentences
  std::size_t measured = 0;        // readings that there are already

  // Returns a table with a row for each reading, in order, whose force is to be filled in: then
  // `sinew identify static` reads it.
  std::string file(const std::string& out) const;
};

// Plans what to measure next; without tables for a muscle that nobody has measured, at
// `atmosphere`, which gauges read against [Pa]. Throws config::Error and Refusal.
PlanFound find_plan(const std::vector<Source>& sources, const PlanSettings& settings,
                    double atmosphere = units::atmosphere);

// Returns the plan as `--json` prints it.
Json to_json(const PlanFound& found);

}  // namespace sinew::identify
