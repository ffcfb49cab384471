// identify/task/static_task.h - `sinew identify static` and `check`: the static law of an actuator
// from force, length and pressure, and what is wrong with such tables.
#pragma once

#include <string>
#include <vector>

#include "sinew/identify/actuator/static.h"
#include "sinew/identify/check/checkup.h"
#include "sinew/identify/task/settings.h"

namespace sinew::identify {

// Settings of `static`, as texts; fields() describes them.
struct StaticSettings {
  std::string rest_length, actuator, branch = "both";
  std::vector<std::string> fit_where;
  HeldOut hold_out;
  std::string diameter;
  bool anyway = false;
  std::vector<std::string> predict;
  std::string model, name = "bpa";
  host::Tally* tried = nullptr;  // counts laws that have been tried; null: nothing
};

// Settings of `check`: those of `static` which concern the tables.
struct CheckSettings {
  StaticSettings how;
};

constexpr config::Range actuator_length = config::above_zero(1000, "of an actuator");

// What concerns the tables.
template <class Visitor>
void table_fields(Visitor& v, StaticSettings& s) {
  v.quantity(
      {"rest_length", "of the muscle without pressure and load; without it the longest length", "m",
       actuator_length},
      s.rest_length);
  v.file({"actuator", "a file whose braid is taken as known"}, s.actuator);
  v.choice({"branch", "the points that are fitted: of filling, of venting, or both"}, s.branch,
           {"fill", "vent", "both"});
  v.texts({"fit_where", "NAME=VALUE,...: only such rows are fitted, the others held out"},
          s.fit_where);
  v.hold_out({"hold_out",
              "pressure (every second), length or muscle (each once) or another FILE, to score "
              "what was not seen"},
             s.hold_out);
  v.quantity({"diameter", "of the muscle without pressure and load, to compare its force with", "m",
              config::above_zero(1, "of a muscle")},
             s.diameter);
}

template <class Visitor>
void fields(Visitor& v, StaticSettings& s) {
  v.method({"static", "the static law of an actuator from force, length and pressure",
            Tables::needed, static_models().size()});
  table_fields(v, s);
  v.flag({"anyway", "fit where a check is red, too; see `sinew identify check`"}, s.anyway);
  v.texts({"predict",
           "rest_length=LENGTH: also a muscle that nobody measured, in a file of its own", "m"},
          s.predict);
  v.text({"model", "this one alone"}, s.model);
  v.text({"name", "of the actuator"}, s.name);
}

template <class Visitor>
void fields(Visitor& v, CheckSettings& s) {
  v.method({"check", "are measurements plausible, and what can `identify static` find in them"});
  table_fields(v, s.how);
}

// Holds what was found, with the actuators' files.
struct StaticFound {
  StaticResult result;
  std::vector<std::string> files;  // the actuator's, of each muscle; the longest first

  // Muscles of the rest lengths that `predict` named, and their files.
  std::vector<StaticMuscle> predicted;
  std::vector<std::string> predicted_files;
};

// Returns the points of the tables, as a static law would be fitted to them. Throws config::Error
// and Refusal.
StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings);

// Checks the tables first (identify/check/check.h): what is red is refused unless it is to be
// fitted anyway, suspicions become warnings of the report. Throws config::Error and Refusal.
StaticFound find_static(const std::vector<Source>& sources, const StaticSettings& settings);

// Returns what a fit would not report, and what it could find: see identify/check/checkup.h.
// Throws config::Error for settings that are none.
Checkup check_before_static(const std::vector<Source>& sources, const StaticSettings& settings);

}  // namespace sinew::identify
