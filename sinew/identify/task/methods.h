// identify/task/methods.h - the methods of identification: results found in tables with the
// settings of settings.fields.h. All throw config::Error and Refusal. The functions at the end
// treat all methods alike, for the command line and Python.
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
#include "sinew/identify/contest/evidence.h"
#include "sinew/identify/contest/fit.h"
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

// Result, with the actuator's file.
struct GeometryFound {
  actuator::Braid braid;
  std::optional<Report> report;  // empty: the braid was counted
  std::string file;              // actuator's file
};

// --- sensor ---

// Result, from which the robot's file is written.
struct SensorFound {
  Calibration calibration;
  std::string display;  // original unit of the known values
  CountScale converter;
  bool average = false;
  std::string base;

  // Returns the robot's file as it would be written at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// Return the scale for a sensitivity as in a robot's file, its uncertainty and its SI unit:
// potentiometers have a scale per volt, "rad/V", transducers in volts, "V/N".
double scale_of(const Calibration& c, double sensitivity);
double scale_uncertainty(const Calibration& c, const SensorResult& r);
std::string scale_unit(const Calibration& c);

// Returns that unit for known values in `display`: "V/lbf", "deg/V".
std::string scale_unit_for(const Calibration& c, const std::string& display);

// --- dynamic ---

// Result, with the actuator's file.
struct DynamicFound {
  DynamicResult result;
  std::string file;  // actuator's file, with its loss
};

// --- joint ---

// Result, with the files of robot and actuator.
struct JointFound {
  JointResult result;
  JointSetup setup;
  JointNames names;
  std::string base, source;
  std::string actuator_file;  // with the identified effectiveness

  // Returns the robot's file as it would be written at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// --- pair ---

// Result, with the robot's file.
struct PairFound {
  PairResult result;
  std::string joint, base, source;

  // Returns the robot's file as it would be written at `out`. Throws config::Error, and Refusal for
  // a slide.
  std::string file(const std::string& out) const;
};

// Returns whether the text is a range of times, "7 s..14 s", and not a file's name.
bool is_time_range(std::string_view text);

// --- valve ---

// Result, from which the valves file is written.
struct ValveFound {
  ValveResult result;

  // Returns the valves file; `out` is its name in a refusal. Throws Refusal for delays without a
  // flow, which a simulation could not use, and for values that the data do not support.
  std::string file(const std::string& out) const;
};

// predict.dat, with compensated valve delays.
struct TimingFile {
  std::string text;
  double frequency = 0;  // pulse frequency [Hz]
  double worst = 0;      // largest difference of delivered and commanded duty [-]
};

// Returns the timing. An empty `frequency` is 100 Hz. Throws Refusal if the delays are unknown.
TimingFile timing_of(const ValveFound& found, const std::string& frequency);

// --- static and check ---

// Result, with the actuators' files.
struct StaticFound {
  StaticResult result;
  std::vector<std::string> files;  // actuator's file of each muscle, the longest first

  // Muscles with the rest lengths of the setting `predict`, and their files.
  std::vector<StaticMuscle> predicted;
  std::vector<std::string> predicted_files;
};

// Returns the braid of the actuator in a file; empty if no file is named.
std::optional<actuator::Braid> known_braid(const std::string& file_name);

// Returns the points of the tables that a static law would be fitted to. Throws config::Error and
// Refusal.
StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings);

// --- scale ---

// A muscle scaled to another rest length.
struct ScaleFound {
  actuator::Actuator actuator;
  double from = 0;          // rest length of the muscle in the file [m]
  double largest = 0;       // largest force within the lengths and pressures of the old one [N]
  double corrected_by = 1;  // factor of the law from the reading [-]
  std::string doubt;        // doubt about the reading, in words; empty: none
  std::string file;         // sinew.actuator/1
};

// --- run ---

// Result, with the robot's file.
struct RunFitFound {
  RunFitResult result;
  std::string base, source;
  std::vector<Report> score = {};  // scores on a recording that was not fitted; empty: not scored

  // Returns the robot's file as it would be written at `out`. Throws config::Error.
  std::string file(const std::string& out) const;
};

// --- plan ---

// A measurement plan, and the muscle that it is made for.
struct PlanFound {
  MeasurementPlan plan;
  ExpectedMuscle muscle;
  PlanOptions options;
  std::string subject;             // "a muscle of 250 mm, 12 mm wide"
  std::vector<std::string> notes;  // assumptions, in sentences
  std::size_t measured = 0;        // existing readings

  // Returns a table with a row for each reading, in order, with an empty force column; filled in,
  // it is input for `sinew identify static`.
  std::string file(const std::string& out) const;
};

// Returns the three mounts that reduce the error most, with the errors expected before and after
// each, as `sinew identify plan DATA --error "1.05 %" --most 3` does; leaves out muscles with too
// few points for a plan.
std::vector<Further> further_measurements(const StaticResult& result, double atmosphere,
                                          const std::optional<actuator::Braid>& braid);

// --- force-beam ---

// Name of a bridge arrangement.
struct Arrangement {
  std::string_view name;
  Bridge::Arms arms;
};
inline constexpr Arrangement arrangements[] = {{"quarter", Bridge::Arms::quarter},
                                               {"half", Bridge::Arms::half},
                                               {"poisson", Bridge::Arms::poisson},
                                               {"bending", Bridge::Arms::bending}};

// Returns lines of text: strain, stress, safety, output, in SI and in the thesis's units; or in the
// units of `shown` alone, if given.
std::string text_of(const Transducer& transducer, const units::ShownUnits* shown = nullptr);

// Returns a line for each arrangement: the distance of the gages from the load for the wanted
// sensitivity [V/N].
std::string text_of_places(const Transducer& transducer, double wanted,
                           const units::ShownUnits* shown = nullptr);

// Returns both as JSON, in SI.
std::string json_of(const Transducer& transducer, std::optional<double> wanted);

// Return the transducer, and the wanted sensitivity [V/N] if given. Throw config::Error.
Transducer transducer_of(const TransducerSettings& settings);
std::optional<double> wanted_sensitivity(const TransducerSettings& settings);

// --- all methods ---

// Calls `each` with default settings of every method, in the order of their help.
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

// Return the result of a method on the tables. Geometry and plan may have no tables:
// then trapezoids were counted, or the muscle has not been measured; `atmosphere` is the
// ambient pressure [Pa] of its gauges. A static law is fitted after its tables were checked
// (identify/check/check.h).
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

// Return the output of `--json`: the report and further results, in SI with the unit in the key;
// null if unknown.
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

// Return the reports of a result for its page, the method's own first. Empty if the result has no
// law, such as a counted braid.
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

// Returns the title of a method's page; empty: that of its first report.
template <class Found>
std::string title_of(const Found& found) {
  if constexpr (requires { found.calibration; })
    return "calibration of sensors from " + found.calibration.file;
  else
    return "";
}

// Returns why there is a report but no file; empty: a file is possible.
template <class Found>
std::string refused(const Found& found) {
  if constexpr (requires { found.result.refused; })
    return found.result.refused;
  else
    return "";
}

// Returns functions for the texts of the parameter files, each as it would be written at `out`, the
// method's own first. They throw config::Error or Refusal if the file is not possible.
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
