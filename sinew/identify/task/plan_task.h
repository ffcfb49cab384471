// identify/task/plan_task.h - `sinew identify plan`: which lengths and pressures to measure so that
// a static law is known well enough, and how long that takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/fit/evidence.h"
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
  v.quantity(
      {"rest_length", "of the muscle without pressure and load; without it the longest length", "m",
       length},
      s.rest_length);
  v.choice({"branch", "of DATA: fill, vent or both"}, s.branch, {"fill", "vent", "both"});
  v.quantity({"diameter", "of the mesh without pressure and load", "m",
              config::above_zero(1, "of a muscle")},
             s.diameter);
  v.file(
      {"actuator",
       "a file with a muscle like it, in place of the diameter; with DATA: whose braid is known"},
      s.actuator);
  v.quantity({"pressure", "the highest that will be measured", "Pa gauge",
              config::above_zero(5e6, "above the room's, in a muscle")},
             s.pressure);
  v.quantity(
      {"noise", "of one reading of force, a standard deviation; absent: 2 N, or what DATA scatter",
       "N", config::above_zero(1e4, "of a force")},
      s.noise);
  v.quantity({"length_error", "of a mount's length", "m", config::from_zero(0.1, "of a mount")},
             s.length_error);
}

// What is wanted.
template <class Visitor>
void aim_fields(Visitor& v, PlanSettings& s) {
  constexpr config::Range time = config::from_zero(86400, "more than a day for one step");
  constexpr config::Range length = config::above_zero(1000, "of an actuator");
  v.quantity(
      {"law_error", "that the law itself is off by, of the largest force; no measurement lowers it",
       "1", config::from_zero(0.5, "of the largest force")},
      s.law_error);
  v.quantity({"error", "wanted, of the largest force", "1",
              config::above_zero(0.5, "of the largest force")},
             s.error);
  v.choice({"criterion",
            "mean: the error is a root mean square over the region; worst: half of the 95 % "
            "interval at its worst place"},
           s.criterion, {"mean", "worst"});
  v.quantity({"mount_time", "to change the length", "s", time}, s.mount_time);
  v.quantity({"step_time", "to change the pressure, wait and read", "s", time}, s.step_time);
  v.quantity({"shortest", "length at which the law is wanted", "m", length}, s.shortest);
  v.quantity({"longest", "length at which it is; absent: the rest length", "m", length}, s.longest);
  v.quantity({"lowest", "pressure at which it is", "Pa gauge",
              config::above_zero(5e6, "above the room's, in a muscle")},
             s.lowest);
  v.integer({"most", "mounts at most", "", {3, 100, "mounts; fewer cannot try a law"}}, s.most);
}

template <class Visitor>
void fields(Visitor& v, PlanSettings& s) {
  v.method({"plan", "which lengths and pressures to measure for an error, and in how many minutes",
            Tables::optional});
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

// Returns the three mounts that lower the error most, with the errors that are expected before and
// after each; none of a muscle whose points are too few for a plan. They are those of
// `sinew identify plan DATA --error "1.05 %" --most 3`.
std::vector<Further> further_measurements(const StaticResult& result, double atmosphere,
                                          const std::optional<actuator::Braid>& braid);

// Returns the plan as `--json` prints it.
Json to_json(const PlanFound& found);

}  // namespace sinew::identify
