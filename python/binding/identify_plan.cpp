// python/binding/identify_plan.cpp - before anything is measured: which columns a method reads, and
// which lengths and pressures are worth the time.
#include <pybind11/stl.h>

#include "python/binding/settings.h"
#include "sinew/identify/task/inputs.h"
#include "sinew/identify/task/plan_task.h"
#include "sinew/json/json.h"

namespace sinew::python {

namespace {

py::object loaded(const std::string& json) {
  return py::module_::import("json").attr("loads")(json);
}

// Returns what `sinew identify METHOD --columns --json` prints.
py::object inputs(const std::string& method) {
  return loaded(to_json(identify::inputs_of(method)).text());
}

// Returns what `--template` writes.
std::string table_to_fill_in(const std::string& method, const std::string& kind) {
  return identify::template_of(identify::inputs_of(method), kind);
}

// The plan as `--json` prints it, and the table to fill in. Without tables nothing is measured yet.
py::tuple plan(const py::list& tables, const py::dict& given) {
  const Settings settings(given);
  identify::PlanSettings s;
  identify::StaticSettings how;
  settings.quantity("rest_length", "m", s.rest_length);
  settings.quantity("diameter", "m", s.diameter);
  settings.path("actuator", s.actuator);
  settings.quantity("pressure", "Pa gauge", s.pressure);
  settings.quantity("noise", "N", s.noise);
  settings.quantity("length_error", "m", s.length_error);
  settings.quantity("law_error", "1", s.law_error);
  settings.quantity("error", "1", s.error);
  settings.quantity("mount_time", "s", s.mount_time);
  settings.quantity("step_time", "s", s.step_time);
  settings.quantity("shortest", "m", s.shortest);
  settings.quantity("longest", "m", s.longest);
  settings.quantity("lowest", "Pa gauge", s.lowest);
  settings.text("criterion", s.criterion);
  settings.integer("most", s.most);
  settings.text("branch", how.branch);
  how.rest_length = s.rest_length;
  how.actuator = s.actuator;
  std::vector<identify::Source> sources;
  for (const py::handle table : tables) sources.push_back(source_of(table));
  std::optional<identify::PlanFound> found;
  std::atomic<bool> unstoppable = false;
  do_interruptibly(unstoppable, [&] {
    found = sources.empty() ? identify::find_plan(s) : identify::find_next(sources, how, s);
  });
  return py::make_tuple(loaded(to_json(*found).text()), identify::plan_table(*found));
}

}  // namespace

void bind_identify_plan(py::module_& m) {
  m.def("identify_inputs", &inputs, py::arg("method"));
  m.def("identify_template", &table_to_fill_in, py::arg("method"), py::arg("kind"));
  m.def("identify_plan", &plan, py::arg("tables"), py::arg("settings"));
}

}  // namespace sinew::python
