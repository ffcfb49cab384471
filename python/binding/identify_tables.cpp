// python/binding/identify_tables.cpp - methods of identification like `sinew identify`: tables and
// settings in, a report and parameter files out.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <memory>

#include "python/binding/keywords.h"
#include "python/binding/recording.h"
#include "sinew/host/side_by_side.h"
#include "sinew/identify/task/inputs.h"
#include "sinew/identify/task/methods.h"
#include "sinew/identify/task/settings.h"
#include "sinew/report/page/page.h"

namespace sinew::python {

namespace {

using Sources = std::vector<identify::Source>;

// Result of any method, and the tables that it was found in.
struct Identified {
  std::shared_ptr<const identify::Found> found;
  std::shared_ptr<const identify::ValveFound> valve =
      nullptr;  // `found` as a valve's result; else null
  Sources sources;
};

// Runs the method without Python's lock.
template <class Method>
Identified found_by(Method settings, const Sources& sources, const py::dict& given) {
  Keywords keywords(given);
  fields(keywords, settings);
  keywords.refuse_others();
  Identified out{.found = nullptr, .sources = sources};
  std::atomic<bool> stop = false;
  do_interruptibly(stop, [&] {
    const host::Stoppable stoppable(&stop);
    const auto found = std::make_shared<const decltype(identify::find(sources, settings))>(
        identify::find(sources, settings));
    out.found = found;
    if constexpr (std::is_assignable_v<decltype(out.valve)&, decltype(found)>) out.valve = found;
  });
  return out;
}

// Calls `use` with the settings of the named method. Throws std::invalid_argument if it is unknown.
template <class Use>
void with_method(const std::string& name, const Use& use) {
  bool known = false;
  identify::for_each_method([&](const auto& settings) {
    if (identify::SettingList(settings).of.name != name) return;
    known = true;
    use(settings);
  });
  if (!known)
    throw std::invalid_argument(fmt::format("method: found \"{}\"; expected one there is", name));
}

// Runs a method on tables given as dicts, see source_of().
Identified identify_tables(const std::string& method, const py::list& tables,
                           const py::dict& given) {
  Sources sources;
  for (const py::handle table : tables) sources.push_back(source_of(table));
  Identified out;
  with_method(method, [&](const auto& settings) { out = found_by(settings, sources, given); });
  return out;
}

// Returns the output of `sinew force-beam --json`.
py::object force_beam(const py::dict& given) {
  identify::TransducerSettings s;
  Keywords keywords(given);
  fields(keywords, s);
  return parsed(identify::json_of(identify::transducer_of(s), identify::wanted_sensitivity(s)));
}

// Returns the rows of a method's settings, see SettingList.
py::object identify_settings(const std::string& method) {
  if (method == "force-beam")
    return parsed(identify::SettingList(identify::TransducerSettings()).rows.text());
  std::string rows;
  with_method(method,
              [&](const auto& settings) { rows = identify::SettingList(settings).rows.text(); });
  return parsed(rows);
}

// Returns the SI unit of each column that a method reads; columns of `sensor` have arbitrary names.
py::dict identify_columns(const std::string& method) {
  py::dict out;
  for (const identify::MethodInputs& inputs : identify::method_inputs())
    if (inputs.method == method && method != "sensor")
      for (const identify::ColumnSpec& spec : inputs.columns)
        out[py::str(std::string(spec.name))] = std::string(spec.unit);
  return out;
}

// Returns the output of `sinew identify columns METHOD --json`.
py::object identify_inputs(const std::string& method) {
  return parsed(to_json(identify::inputs_of(method)).text());
}

// Returns the output of `--template`.
std::string identify_template(const std::string& method, const std::string& kind) {
  return identify::template_of(identify::inputs_of(method), kind);
}

std::string text_of(const Identified& of, std::size_t which, const std::string& out) {
  if (which >= of.found->files.size())
    throw py::index_error(
        fmt::format("file: found {}; expected less than {}", which, of.found->files.size()));
  return of.found->file(out, which);
}

// Returns the page with data and models, like `--report`.
std::string page_of(const Identified& of) {
  if (of.found->reports.empty())
    throw std::invalid_argument("page: found a braid that was counted; expected a table to show");
  return of.found->page(of.sources, of.sources.empty() ? 0 : of.sources.front().atmosphere,
                        SINEW_VERSION);
}

// Returns the page for a notebook cell.
py::object cell(const Identified& of) {
  if (of.found->reports.empty() || !report::has_page()) return py::none();
  return in_a_cell(page_of(of));
}

py::tuple timing(const Identified& of, const py::object& given) {
  if (!of.valve) throw std::invalid_argument("timing: found no valve");
  std::string frequency;
  py::dict only;
  only["frequency"] = given;
  Settings(only).quantity("frequency", "Hz", frequency);
  const identify::TimingFile file = identify::timing_of(*of.valve, frequency);
  return py::make_tuple(file.text, file.worst);
}

}  // namespace

void bind_identify_tables(py::module_& m) {
  py::class_<Identified>(m, "Identified", "What a method of identification found.")
      .def_property_readonly(
          "report", [](const Identified& of) { return parsed(of.found->json.text()); },
          "The report, as `sinew identify --json` prints it.")
      .def_property_readonly(
          "files", [](const Identified& of) { return of.found->files.size(); },
          "How many parameter files there are.")
      .def_property_readonly(
          "refused", [](const Identified& of) { return of.found->refused; },
          "What the data do not support; empty: nothing.")
      .def("text", &text_of, py::arg("which"), py::arg("out"),
           "Returns the text of a parameter file, as it would stand at `out`.")
      .def("page", &page_of, "Returns the page with the data and the models, as HTML.")
      .def("cell", &cell, "Returns the page as HTML for a notebook; None without one.")
      .def("timing", &timing, py::arg("frequency"),
           "Returns predict.dat of a valve, and by how much a duty is off at most.");
  m.def("identify_tables", &identify_tables, py::arg("method"), py::arg("tables"),
        py::arg("settings"));
  m.def("force_beam", &force_beam, py::arg("settings"));
  m.def("identify_settings", &identify_settings, py::arg("method"));
  m.def("identify_columns", &identify_columns, py::arg("method"));
  m.def("identify_inputs", &identify_inputs, py::arg("method"));
  m.def("identify_template", &identify_template, py::arg("method"), py::arg("kind"));
}

}  // namespace sinew::python
