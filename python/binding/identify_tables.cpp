// python/binding/identify_tables.cpp - the methods of identification, asked as `sinew identify`
// asks them: tables and settings in, a report and parameter files out.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <functional>
#include <optional>

#include "python/binding/recording.h"
#include "python/binding/settings.h"
#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/motion/decay.h"
#include "sinew/identify/page/fit_page.h"
#include "sinew/identify/sensor/sensor_file.h"
#include "sinew/identify/task/creep_task.h"
#include "sinew/identify/task/dynamic_task.h"
#include "sinew/identify/task/geometry_task.h"
#include "sinew/identify/task/joint_task.h"
#include "sinew/identify/task/pair_task.h"
#include "sinew/identify/task/run_task.h"
#include "sinew/identify/task/scale_task.h"
#include "sinew/identify/task/sensor_task.h"
#include "sinew/identify/task/static_task.h"
#include "sinew/identify/task/tables.h"
#include "sinew/identify/task/valve_task.h"
#include "sinew/json/json.h"
#include "sinew/report/page/page.h"

namespace sinew::python {

namespace {

using Sources = std::vector<identify::Source>;

// What a method found, whatever the method.
struct Identified {
  using File = std::function<std::string(const std::string& out)>;

  std::string report;       // as --json prints it
  std::vector<File> files;  // texts of parameter files, as they would stand at `out`
  std::string refused;      // what the data do not support
  std::function<identify::TimingFile(const std::string&)> timing;  // a valve's

  // What its page shows.
  std::string title;
  std::vector<identify::Report> reports;
  std::vector<std::string> read;  // tables, in words
  double atmosphere = 0;          // [Pa]
};

// Asks without Python's lock.
template <class Ask>
auto away(Ask ask) {
  std::optional<decltype(ask())> found;
  std::atomic<bool> unstoppable = false;
  do_interruptibly(unstoppable, [&] { found.emplace(ask()); });
  return std::move(*found);
}

Identified::File fixed(std::string text) {
  return [text = std::move(text)](const std::string&) { return text; };
}

void wishes_of(const Settings& given, identify::WishTexts& out) {
  given.texts("freeze", out.freeze);
  given.texts("prior", out.prior);
  given.texts("tie", out.tie);
}

Identified geometry(const Sources& sources, const Settings& given) {
  identify::GeometrySettings s;
  given.text("name", s.name);
  given.quantity("thread_thickness", "m", s.thread_thickness);
  given.text("trapezoids", s.trapezoids);
  given.quantity("side", "m", s.side);
  const auto found = away([&] {
    return s.trapezoids.empty() ? identify::find_geometry(sources, s) : identify::count_geometry(s);
  });
  Identified out{.report = to_json(found).text(), .files = {fixed(found.file)}};
  if (found.report) out.reports = {*found.report};
  return out;
}

identify::StaticSettings static_settings(const Settings& given) {
  identify::StaticSettings s;
  given.text("name", s.name);
  given.text("model", s.model);
  given.quantity("rest_length", "m", s.rest_length);
  given.path("actuator", s.actuator);
  given.text("branch", s.branch);
  given.texts("fit_where", s.fit_where);
  given.text("hold_out", s.hold_out);
  given.table("held_out", s.held_out);
  given.quantity("diameter", "m", s.diameter);
  given.flag("anyway", s.anyway);
  given.texts("predict", s.predict);
  return s;
}

Identified of_static(const Sources& sources, const Settings& given) {
  const identify::StaticSettings s = static_settings(given);
  const auto found = away([&] { return identify::find_static(sources, s); });
  Identified out{.report = to_json(found.result.report).text(), .reports = {found.result.report}};
  for (const std::string& file : found.files) out.files.push_back(fixed(file));
  for (const std::string& file : found.predicted_files) out.files.push_back(fixed(file));
  return out;
}

Identified scaled(const Sources&, const Settings& given) {
  identify::ScaleSettings s;
  given.path("file", s.file);
  given.text("actuator", s.actuator);
  given.quantity("rest_length", "m", s.rest_length);
  given.text("reading", s.reading);
  given.text("name", s.name);
  const auto found = away([&] { return identify::find_scaled(s); });
  return {.report = to_json(found).text(), .files = {fixed(found.file)}};
}

Identified of_run(const Sources&, const Settings& given) {
  identify::RunFitSettings s;
  given.path("run", s.run);
  given.path("machine", s.machine);
  given.texts("sets", s.sets);
  given.texts("fit", s.fit);
  given.texts("priors", s.priors);
  given.texts("freeze", s.freeze);
  given.text("hold_out", s.hold_out);
  given.quantity("from", "s", s.from);
  given.integer("threads", s.threads);
  given.path("base", s.base);
  const auto found = away([&] { return identify::find_run_fit(s); });
  return {.report = to_json(found).text(),
          .files = {fixed(found.file(""))},
          .reports = {found.result.report}};
}

Identified check_of(const Sources& sources, const Settings& given) {
  const identify::StaticSettings s = static_settings(given);
  return {.report =
              to_json(away([&] { return identify::check_before_static(sources, s); })).text()};
}

Identified dynamic(const Sources& sources, const Settings& given) {
  identify::DynamicSettings s;
  given.path("actuator", s.actuator);
  given.text("name", s.name);
  given.quantities("mass", "kg", s.mass);
  given.quantities("pressure", "Pa abs", s.pressure);
  given.quantities("external_volume", "m3", s.external_volume);
  given.quantity("exponent", "1", s.exponent);
  given.integer("count", s.count);
  given.tables("held_out", s.held_out);
  given.text("model", s.model);
  wishes_of(given, s.wishes);
  const auto found = away([&] { return identify::find_dynamic(sources, s); });
  return {.report = to_json(found).text(),
          .files = {fixed(found.file)},
          .reports = {found.result.report}};
}

Identified creep(const Sources& sources, const Settings&) {
  const auto found = away([&] { return identify::find_creep(sources); });
  return {.report = to_json(found).text(), .reports = {found.report}};
}

Identified joint(const Sources& sources, const Settings& given) {
  identify::JointSettings s;
  given.path("actuator", s.actuator);
  given.text("name", s.name);
  given.integer("count", s.count);
  given.text("joint", s.names.joint);
  given.text("flexor", s.names.flexor);
  given.text("extensor", s.names.extensor);
  given.text("flexion", s.names.flexion);
  given.quantity("rest_angle", "rad", s.rest_angle);
  given.quantity("load", "kg", s.load);
  given.quantity("lever", "m", s.lever);
  given.quantity("down", "rad", s.down);
  given.quantity("limb", "kg", s.limb);
  given.quantity("limb_lever", "m", s.limb_lever);
  given.quantity("moment_arm", "m", s.moment_arm);
  given.quantity("flexor_length", "m", s.flexor_length);
  given.quantity("extensor_length", "m", s.extensor_length);
  given.flag("keep_force", s.keep_force);
  given.flag("torque_bias", s.torque_bias);
  given.flag("torque_gain", s.torque_gain);
  given.flag("moving", s.moving);
  given.table("held_out", s.held_out);
  given.text("model", s.model);
  wishes_of(given, s.wishes);
  given.path("base", s.base);
  const auto found = std::make_shared<identify::JointFound>(
      away([&] { return identify::find_joint(sources, s); }));
  return {.report = to_json(*found).text(),
          .files = {[found](const std::string& out) { return found->file(out); },
                    fixed(found->actuator_file)},
          .reports = {found->result.report}};
}

Identified pair(const Sources& sources, const Settings& given) {
  identify::PairSettings s;
  given.text("rigs", s.rigs);
  given.text("hold_out", s.hold_out);
  given.tables("held_out", s.held_out);
  given.quantity("window", "s", s.window);
  wishes_of(given, s.wishes);
  given.text("model", s.model);
  given.text("joint", s.joint);
  given.path("base", s.base);
  const auto found =
      std::make_shared<identify::PairFound>(away([&] { return identify::find_pair(sources, s); }));
  Identified out{.report = to_json(*found).text(),
                 .files = {[found](const std::string& at) { return found->file(at); }},
                 .reports = {found->result.report}};
  if (found->result.air) out.reports.push_back(found->result.air->report);
  return out;
}

Identified sensor(const Sources& sources, const Settings& given) {
  identify::SensorSettings s;
  given.text("known", s.known);
  given.texts("sensors", s.sensors);
  if (given.is_number("rest"))
    given.number("rest", s.rest_value.emplace());
  else
    given.text("rest", s.rest);
  given.integer("bits", s.bits);
  given.quantity("full_scale", "V", s.full_scale);
  given.table("held_out", s.held_out);
  given.flag("average", s.average);
  given.path("base", s.base);
  const auto found = std::make_shared<identify::SensorFound>(
      away([&] { return identify::find_sensors(sources, s); }));
  Identified out{.report = to_json(found->calibration).text(),
                 .files = {[found](const std::string& at) { return found->file(at); }},
                 .title = "calibration of sensors from " + found->calibration.file};
  for (const auto& one : found->calibration.sensors) out.reports.push_back(one.report);
  return out;
}

Identified valve(const Sources& sources, const Settings& given) {
  identify::ValveSettings s;
  given.text("name", s.name);
  given.path("base", s.base);
  given.text("kind", s.kind);
  given.quantity("volume", "m3", s.volume);
  given.quantity("conductance", "m3/(s Pa)", s.conductance);
  given.flag("per_volume", s.per_volume);
  given.quantities("added_volume", "m3", s.added_volume);
  given.quantity("port", "Pa abs", s.port);
  given.quantity("exponent", "1", s.exponent);
  given.quantity("temperature", "K", s.temperature);
  given.quantity("frequency", "Hz", s.frequency);
  given.table("held_out", s.held_out);
  const auto found = std::make_shared<identify::ValveFound>(
      away([&] { return identify::find_valve(sources, s); }));
  return {.report = to_json(*found).text(),
          .files = {[found](const std::string& out) { return found->file(out); }},
          .refused = found->result.refused,
          .timing =
              [found, s](const std::string& frequency) {
                return identify::timing_of(*found, frequency.empty() ? s.frequency : frequency);
              },
          .reports = {found->result.report}};
}

// --- methods by their names ---

struct Method {
  std::string_view name;
  Identified (*ask)(const Sources&, const Settings&);
  std::span<const identify::Wanted> (*columns)();  // null: named by whoever measured
};
constexpr Method methods[] = {{"static", of_static, identify::static_columns},
                              {"check", check_of, identify::static_columns},
                              {"scale", scaled, nullptr},
                              {"run", of_run, nullptr},
                              {"dynamic", dynamic, identify::decay_columns},
                              {"creep", creep, identify::creep_columns},
                              {"joint", joint, [] { return identify::joint_columns(true); }},
                              {"pair", pair, identify::pair_columns},
                              {"geometry", geometry, identify::geometry_columns},
                              {"sensor", sensor, nullptr},
                              {"valve", valve, identify::valve_columns}};

const Method& method_of(const std::string& name) {
  for (const Method& method : methods)
    if (method.name == name) return method;
  throw std::invalid_argument(fmt::format("method: found \"{}\"; expected one there is", name));
}

// Tables are dicts, as source_of() has them.
Identified identify_tables(const std::string& name, const py::list& tables, const py::dict& given) {
  const Method& method = method_of(name);
  Sources sources;
  for (const py::handle table : tables) sources.push_back(source_of(table));
  const Settings settings(given);
  Identified found = method.ask(sources, settings);
  found.read = identify::words_of(sources);
  if (!sources.empty()) found.atmosphere = sources.front().atmosphere;
  return found;
}

// The SI units of the columns that a method wants, by their names.
py::dict identify_columns(const std::string& name) {
  py::dict out;
  if (const Method& method = method_of(name); method.columns)
    for (const identify::Wanted& wanted : method.columns())
      out[py::str(std::string(wanted.name))] = std::string(wanted.unit);
  return out;
}

std::string text_of(const Identified& found, std::size_t which, const std::string& out) {
  if (which >= found.files.size())
    throw py::index_error(
        fmt::format("file: found {}; expected less than {}", which, found.files.size()));
  return found.files[which](out);
}

// The values of the file stand on the page, where the data support one.
std::string file_for_page(const Identified& found) try {
  return found.files.empty() ? "" : found.files[0]("");
} catch (const identify::Refusal&) {
  return "";
}

// The page with the data beside the models, as `--report` leaves it.
std::string page_of(const Identified& found) {
  if (found.reports.empty())
    throw std::invalid_argument("page: found a braid that was counted; expected a table to show");
  std::vector<const identify::Report*> reports;
  for (const identify::Report& report : found.reports) reports.push_back(&report);
  const identify::Report& first = *reports[0];
  const std::string of_first = first.title.empty() ? first.subject : first.title;
  return identify::page({.title = found.title.empty() ? of_first : found.title,
                         .version = SINEW_VERSION,
                         .data = found.read,
                         .atmosphere = found.atmosphere,
                         .reports = reports,
                         .parameter_file = file_for_page(found)});
}

// A cell of a notebook shows the page within.
py::object cell(const Identified& found) {
  if (found.reports.empty() || !report::has_page()) return py::none();
  return in_a_cell(page_of(found));
}

py::tuple timing(const Identified& found, const py::object& given) {
  if (!found.timing) throw std::invalid_argument("timing: found no valve");
  std::string frequency;
  py::dict only;
  only["frequency"] = given;
  Settings(only).quantity("frequency", "Hz", frequency);
  const identify::TimingFile file = found.timing(frequency);
  return py::make_tuple(file.text, file.worst);
}

}  // namespace

void bind_identify_tables(py::module_& m) {
  py::class_<Identified>(m, "Identified", "What a method of identification found.")
      .def_property_readonly(
          "report",
          [](const Identified& f) { return py::module_::import("json").attr("loads")(f.report); },
          "The report, as `sinew identify --json` prints it.")
      .def_property_readonly(
          "files", [](const Identified& f) { return f.files.size(); },
          "How many parameter files there are.")
      .def_readonly("refused", &Identified::refused,
                    "What the data do not support; empty: nothing.")
      .def("text", &text_of, py::arg("which"), py::arg("out"),
           "Returns the text of a parameter file, as it would stand at `out`.")
      .def("page", &page_of, "Returns the page with the data beside the models, as HTML.")
      .def("cell", &cell, "Returns the page as HTML for a notebook; None without one.")
      .def("timing", &timing, py::arg("frequency"),
           "Returns predict.dat of a valve, and by how much a duty is off at most.");
  m.def("identify_tables", &identify_tables, py::arg("method"), py::arg("tables"),
        py::arg("settings"));
  m.def("identify_columns", &identify_columns, py::arg("method"));
}

}  // namespace sinew::python
