// identify/task/methods.h - every method of identification: what it finds in tables by its settings
// (settings.fields.h). All throw config::Error and Refusal. At the end is what treats the methods
// alike: the command line and Python use that.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/actuator/creep.h"
#include "sinew/identify/actuator/geometry.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/identify/check/checkup.h"
#include "sinew/identify/fit/evidence.h"
#include "sinew/identify/fit/fit.h"
#include "sinew/identify/joint/joint.h"
#include "sinew/identify/machine/run_fit.h"
#include "sinew/identify/motion/dynamic.h"
#include "sinew/identify/pair/pair.h"
#include "sinew/identify/plan/plan.h"
#include "sinew/identify/sensor/force_beam.h"
#include "sinew/identify/sensor/sensor.h"
#include "sinew/identify/task/settings.fields.h"
#include "sinew/identify/valve/valve.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

// --- geometry ---

// Holds what was found, with the actuator's file.
struct GeometryFound {
  actuator::Braid braid;
  std::optional<Report> report;  // none: it was counted
  std::string file;              // the actuator's
};

// --- sensor ---

// Holds what was found, and the robot's file that is written with it.
struct SensorFound {
  Calibration calibration;
  std::string display;  // unit of the known values, as they were given
  CountScale converter;
  bool average = false;
  std::string base;

  // The robot's file, as it would stand at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// Return the scale that a robot's file has for a sensitivity, its uncertainty and its SI unit:
// potentiometers are given per volt, "rad/V", transducers in volts, "V/N".
double scale_of(const Calibration& c, double sensitivity);
double scale_uncertainty(const Calibration& c, const SensorResult& r);
std::string scale_unit(const Calibration& c);

// Returns that unit where the known values were in `display`: "V/lbf", "deg/V".
std::string scale_unit_for(const Calibration& c, const std::string& display);

// --- dynamic ---

// Holds what was found, with the actuator's file.
struct DynamicFound {
  DynamicResult result;
  std::string file;  // the actuator's, with its loss
};

// --- joint ---

// Holds what was found, with the files of robot and actuator.
struct JointFound {
  JointResult result;
  JointSetup setup;
  JointNames names;
  std::string base, source;
  std::string actuator_file;  // with the effectiveness

  // The robot's file, as it would stand at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// --- pair ---

// Holds what was found, with the robot's file.
struct PairFound {
  PairResult result;
  std::string joint, base, source;

  // The robot's file, as it would stand at `out`. Throws config::Error, and Refusal for a slide.
  std::string file(const std::string& out) const;
};

// Returns whether the text is a range of times, "7 s..14 s", rather than a file's name.
bool is_time_range(std::string_view text);

// --- valve ---

// Holds what was found, and the valves file that is written with it.
struct ValveFound {
  ValveResult result;

  // The valves file; `out` is what a refusal calls it. Throws Refusal for delays without a flow,
  // which no simulation could use, and for what the data do not support.
  std::string file(const std::string& out) const;
};

// predict.dat, compensated for the valve's delays.
struct TimingFile {
  std::string text;
  double frequency = 0;  // of the pulses [Hz]
  double worst = 0;      // the delivered duty differs from the commanded one by that at most [-]
};

// Throws Refusal where the delays are not known; empty `frequency` is 100 Hz.
TimingFile timing_of(const ValveFound& found, const std::string& frequency);

// --- static and check ---

// Holds what was found, with the actuators' files.
struct StaticFound {
  StaticResult result;
  std::vector<std::string> files;  // the actuator's, of each muscle; the longest first

  // Muscles of the rest lengths that `predict` named, and their files.
  std::vector<StaticMuscle> predicted;
  std::vector<std::string> predicted_files;
};

// Returns the braid of the actuator in a file; nothing where no file is named.
std::optional<actuator::Braid> known_braid(const std::string& file_name);

// Returns the points of the tables, as a static law would be fitted to them. Throws config::Error
// and Refusal.
StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings);

// --- scale ---

// The new muscle.
struct ScaleFound {
  actuator::Actuator actuator;
  double from = 0;          // rest length of the muscle in the file [m]
  double largest = 0;       // force of the new one where the old one was measured [N]
  double corrected_by = 1;  // what its reading made of the law [-]
  std::string doubt;        // of the reading, in words; empty: none
  std::string file;         // sinew.actuator/1
};

// --- run ---

// Holds what was found, with the robot's file.
struct RunFitFound {
  RunFitResult result;
  std::string base, source;
  std::vector<Report> score = {};  // on a recording that was not fitted; empty: not scored

  // The robot's file, as it would stand at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// --- plan ---

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

// Returns the three mounts that lower the error most, with the errors that are expected before and
// after each; none of a muscle whose points are too few for a plan. They are those of
// `sinew identify plan DATA --error "1.05 %" --most 3`.
std::vector<Further> further_measurements(const StaticResult& result, double atmosphere,
                                          const std::optional<actuator::Braid>& braid);

// --- force-beam ---

// What ways to wire the gages are called.
struct Arrangement {
  std::string_view name;
  Bridge::Arms arms;
};
inline constexpr Arrangement arrangements[] = {{"quarter", Bridge::Arms::quarter},
                                               {"half", Bridge::Arms::half},
                                               {"poisson", Bridge::Arms::poisson},
                                               {"bending", Bridge::Arms::bending}};

// Returns lines of text: strain, stress, safety, output, in SI and in the thesis's units; or in
// `shown` alone, where somebody asked for some.
std::string text_of(const Transducer& transducer, const units::ShownUnits* shown = nullptr);

// Returns a line for each arrangement: how far from the load the gages have to be for the wanted
// sensitivity [V/N].
std::string text_of_places(const Transducer& transducer, double wanted,
                           const units::ShownUnits* shown = nullptr);

// Returns both as JSON, in SI.
std::string json_of(const Transducer& transducer, std::optional<double> wanted);

// Returns the transducer, and the wanted sensitivity [V/N], if there is one. Throw config::Error.
Transducer transducer_of(const TransducerSettings& settings);
std::optional<double> wanted_sensitivity(const TransducerSettings& settings);

// --- all of them ---

// Calls `each` with a fresh value of the settings of every method, in the order of their help.
template <class Each>
void for_each_method(const Each& each) {
  each(GeometrySettings{});
  each(SensorSettings{});
  each(DynamicSettings{});
  each(JointSettings{});
  each(PairSettings{});
  each(ValveSettings{});
  each(StaticSettings{});
  each(CreepSettings{});
  each(CheckSettings{});
  each(ScaleSettings{});
  each(RunFitSettings{});
  each(PlanSettings{});
}

// Return what a method finds in the tables. Of geometry and plan there may be none: then trapezoids
// were counted, and nobody has measured the muscle, at the `atmosphere` [Pa] of its gauges. A
// static law is fitted after its tables were checked (identify/check/check.h).
using SourceList = std::vector<Source>;
GeometryFound find(const SourceList& sources, const GeometrySettings& settings);
SensorFound find(const SourceList& sources, const SensorSettings& settings);
DynamicFound find(const SourceList& sources, const DynamicSettings& settings);
JointFound find(const SourceList& sources, const JointSettings& settings);
PairFound find(const SourceList& sources, const PairSettings& settings);
ValveFound find(const SourceList& sources, const ValveSettings& settings);
StaticFound find(const SourceList& sources, const StaticSettings& settings);
CreepResult find(const SourceList& sources, const CreepSettings& settings);
Checkup find(const SourceList& sources, const CheckSettings& settings);
ScaleFound find(const SourceList& sources, const ScaleSettings& settings);
RunFitFound find(const SourceList& sources, const RunFitSettings& settings);
PlanFound find(const SourceList& sources, const PlanSettings& settings,
               double atmosphere = units::atmosphere);

// Return what `--json` prints: the report with what it does not hold, in SI with the unit in the
// key; null where it is unknown.
Json to_json(const GeometryFound& found);
Json to_json(const SensorFound& found);
Json to_json(const DynamicFound& found);
Json to_json(const JointFound& found);
Json to_json(const PairFound& found);
Json to_json(const ValveFound& found);
Json to_json(const StaticFound& found);
Json to_json(const CreepResult& found);
Json to_json(const ScaleFound& found);
Json to_json(const RunFitFound& found);
Json to_json(const PlanFound& found);

// Return the reports of what a method found, for its page; the first one is the method's own.
// Empty: what was found is no law, such as a counted braid.
using Reports = std::vector<const Report*>;
Reports reports_of(const GeometryFound& found);
Reports reports_of(const SensorFound& found);
Reports reports_of(const PairFound& found);
Reports reports_of(const RunFitFound& found);
inline Reports reports_of(const CreepResult& found) { return {&found.report}; }
inline Reports reports_of(const Checkup&) { return {}; }
inline Reports reports_of(const ScaleFound&) { return {}; }
inline Reports reports_of(const PlanFound&) { return {}; }
template <class Found>
Reports reports_of(const Found& found) {
  return {&found.result.report};
}

// Returns the title of a method's page; empty: its first report has one.
template <class Found>
std::string title_of(const Found& found) {
  if constexpr (requires { found.calibration; })
    return "calibration of sensors from " + found.calibration.file;
  else
    return "";
}

// Returns why there is no file although there is a report; empty: there may be one.
template <class Found>
std::string refused(const Found& found) {
  if constexpr (requires { found.result.refused; })
    return found.result.refused;
  else
    return "";
}

// Returns the texts of the parameter files, of each as it would stand at `out`; the first one is
// the method's own. A text throws config::Error or Refusal where there can be no such file.
using FileText = std::function<std::string(const std::string& out)>;
template <class Found>
std::vector<FileText> files_of(const std::shared_ptr<const Found>& found) {
  std::vector<FileText> out;
  const auto add = [&](const std::string& text) {
    out.emplace_back([found, &text](const std::string&) { return text; });
  };
  if constexpr (requires { found->file(""); })
    out.emplace_back([found](const std::string& at) { return found->file(at); });
  else if constexpr (requires { found->file; })
    add(found->file);
  if constexpr (requires { found->actuator_file; }) add(found->actuator_file);
  if constexpr (requires { found->predicted_files; }) {
    for (const std::string& text : found->files) add(text);
    for (const std::string& text : found->predicted_files) add(text);
  }
  return out;
}

}  // namespace sinew::identify
