// identify/task/methods.h - the methods of identification: results found in tables with the
// settings of settings.fields.h. All throw config::Error and Refusal.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/actuator/actuator.h"
#include "sinew/identify/actuator/creep.h"
#include "sinew/identify/actuator/geometry.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/identify/check/checkup.h"
#include "sinew/identify/joint/joint.h"
#include "sinew/identify/machine/run_fit.h"
#include "sinew/identify/motion/dynamic.h"
#include "sinew/identify/pair/pair.h"
#include "sinew/identify/plan/plan.h"
#include "sinew/identify/sensor/force_beam.h"
#include "sinew/identify/sensor/sensor.h"
#include "sinew/identify/task/found.h"
#include "sinew/identify/task/settings.fields.h"
#include "sinew/identify/valve/valve.h"
#include "sinew/units/shown.h"

namespace sinew::identify {

// --- results ---

// Result of `geometry`; its file: the actuator's.
struct GeometryFound : Found {
  actuator::Braid braid;  // computed from the measurements
};

// Result of `sensor`; its file: the sensors, or the robot's.
struct SensorFound : Found {
  Calibration calibration;  // scale and offset of each sensor
  std::string display;      // original unit of the known values
};

// Return the scale for a sensitivity as in a robot's file, its uncertainty and its SI unit:
// potentiometers have a scale per volt, "rad/V", transducers in volts, "V/N".
double scale_of(const Calibration& c, double sensitivity);
double scale_uncertainty(const Calibration& c, const SensorResult& r);
std::string scale_unit(const Calibration& c);

// Returns that unit for known values in `display`: "V/lbf", "deg/V".
std::string scale_unit_for(const Calibration& c, const std::string& display);

using CreepFound = FoundBy<CreepResult>;      // without a file
using DynamicFound = FoundBy<DynamicResult>;  // its file: the actuator's, with its loss
using JointFound = FoundBy<JointResult>;      // its files: the robot's, and the actuator's
using PairFound = FoundBy<PairResult>;        // its file: the robot's; refused for a slide
using RunFitFound = FoundBy<RunFitResult>;    // its file: the robot's; further reports: scores
using StaticFound = FoundBy<StaticResult>;    // its files: one of each muscle, the longest first

// Returns whether the text is a range of times, "7 s..14 s", and not a file's name.
bool is_time_range(std::string_view text);

// Result of a method of valves. Its file is refused for delays without a flow, which a simulation
// could not use, and for values without support in the data.
struct ValveFound : FoundBy<ValveResult> {
  using FoundBy::FoundBy;
  std::string frequency;  // frequency of the pulses, as it was set; empty: 100 Hz
};

// predict.dat, with compensated valve delays.
struct TimingFile {
  std::string text;
  double frequency = 0;  // pulse frequency [Hz]
  double worst = 0;      // largest difference of delivered and commanded duty [-]
};

// Returns the timing; an empty `frequency` is the valve's. Throws Refusal if the delays are
// unknown.
TimingFile timing_of(const ValveFound& found, const std::string& frequency = "");

// Returns the braid of the actuator in a file; empty if no file is named.
std::optional<actuator::Braid> known_braid(const std::string& file_name);

// Returns the points of the tables that a static law would be fitted to. Throws config::Error and
// Refusal.
StaticData read_static(const std::vector<Source>& sources, const StaticSettings& settings);

// Fails if a check is red.
struct CheckFound : Found {
  Checkup checkup;
};

// A muscle scaled to another rest length.
struct ScaleFound : Found {
  actuator::Actuator actuator;
  double from = 0;          // rest length of the muscle in the file [m]
  double largest = 0;       // largest force within the lengths and pressures of the old one [N]
  double corrected_by = 1;  // factor of the law from the reading [-]
};

// A measurement plan, and the muscle that it is made for. Its file is a table with a row for each
// reading, in order, with an empty force column; filled in, it is input for `sinew identify
// static`.
struct PlanFound : Found {
  MeasurementPlan plan;
  ExpectedMuscle muscle;
  PlanOptions options;
  std::string subject;       // "a muscle of 250 mm, 12 mm wide"
  std::size_t measured = 0;  // existing readings
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
CreepFound find(const SourceList& sources, const CreepSettings& settings);
CheckFound find(const SourceList& sources, const CheckSettings& settings);
ScaleFound find(const SourceList& sources, const ScaleSettings& settings);
RunFitFound find(const SourceList& sources, const RunFitSettings& settings);
PlanFound find(const SourceList& sources, const PlanSettings& settings,
               double atmosphere = units::atmosphere);

}  // namespace sinew::identify
