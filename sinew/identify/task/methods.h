// identify/task/methods.h - every method of identification, for what treats them alike: the command
// line and Python. A method is its settings with their rows (identify/task/settings.h), and how
// tables and settings become what it found.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/task/creep_task.h"
#include "sinew/identify/task/dynamic_task.h"
#include "sinew/identify/task/geometry_task.h"
#include "sinew/identify/task/joint_task.h"
#include "sinew/identify/task/pair_task.h"
#include "sinew/identify/task/plan_task.h"
#include "sinew/identify/task/run_task.h"
#include "sinew/identify/task/scale_task.h"
#include "sinew/identify/task/sensor_task.h"
#include "sinew/identify/task/static_task.h"
#include "sinew/identify/task/valve_task.h"

namespace sinew::identify {

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

// Returns what a method finds in the tables. Throws config::Error and Refusal.
// clang-format off
using TableList = std::vector<Source>;
inline auto find(const TableList& t, const GeometrySettings& s) { return find_geometry(t, s); }
inline auto find(const TableList& t, const SensorSettings& s) { return find_sensors(t, s); }
inline auto find(const TableList& t, const DynamicSettings& s) { return find_dynamic(t, s); }
inline auto find(const TableList& t, const JointSettings& s) { return find_joint(t, s); }
inline auto find(const TableList& t, const PairSettings& s) { return find_pair(t, s); }
inline auto find(const TableList& t, const ValveSettings& s) { return find_valve(t, s); }
inline auto find(const TableList& t, const StaticSettings& s) { return find_static(t, s); }
inline auto find(const TableList& t, const CreepSettings& s) { return find_creep(t, s); }
inline auto find(const TableList& t, const CheckSettings& s) { return check_before_static(t, s.how); }
inline auto find(const TableList&, const ScaleSettings& s) { return find_scaled(s); }
inline auto find(const TableList&, const RunFitSettings& s) { return find_run_fit(s); }
inline auto find(const TableList& t, const PlanSettings& s) { return find_plan(t, s); }
// clang-format on

// Returns the reports of what a method found, for its page; the first one is the method's own.
// Empty: what was found is no law, such as a counted braid.
template <class Found>
std::vector<const Report*> reports_of(const Found& found) {
  if constexpr (requires { found.report.fits; }) {
    return {&found.report};
  } else if constexpr (requires { found.result.air; }) {
    std::vector<const Report*> out{&found.result.report};
    if (found.result.air) out.push_back(&found.result.air->report);
    return out;
  } else if constexpr (requires { found.result.report; }) {
    return {&found.result.report};
  } else if constexpr (requires { found.report.value(); }) {
    return found.report ? std::vector<const Report*>{&*found.report} : std::vector<const Report*>{};
  } else if constexpr (requires { found.calibration; }) {
    std::vector<const Report*> out;
    for (const SensorResult& sensor : found.calibration.sensors) out.push_back(&sensor.report);
    return out;
  } else {
    return {};
  }
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

// Returns what `--json` prints.
template <class Found>
Json json_of(const Found& found) {
  if constexpr (requires { found.calibration; })
    return to_json(found.calibration);
  else if constexpr (requires { to_json(found); })
    return to_json(found);
  else
    return to_json(found.result.report);
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
