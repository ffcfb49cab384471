// python/binding/fmu.cpp - export of files as FMUs.
#include <pybind11/stl.h>

#include "fmu/export/export.h"
#include "python/binding/bind.h"
#include "sinew/run/folder/files.h"

namespace sinew::python {

namespace {

using Names = std::vector<std::string>;

py::object export_fmu(const py::object& file, const py::object& path, const std::string& muscle,
                      const Names& joints, const std::string& actuator, bool without_valves,
                      const Names& inputs, const Names& outputs, const Names& parameters,
                      const py::object& sets, int fmi, const std::string& name, bool force) {
  const std::string from = path_of(file);
  const fmu::ExportRequest request{.file = from,
                                   .sets = sets_of(sets, from),
                                   .name = name,
                                   .version = fmi,
                                   .actuator = actuator,
                                   .muscle = muscle,
                                   .joints = joints,
                                   .without_valves = without_valves,
                                   .inputs = inputs,
                                   .outputs = outputs,
                                   .parameters = parameters};
  const std::string out = path_of(path);
  fmu::Fmu made;
  {
    const py::gil_scoped_release unlocked;
    made = fmu::make_fmu(request);
    run::refuse_to_overwrite(out, force, run::fmu_kind, {request.file});
    run::write_file(out, made.bytes);
  }
  const py::object about = parsed(fmu::json_of(made, ""));
  about["file"] = path_text(out);
  return about;
}

}  // namespace

void bind_fmu(py::module_& m) {
  m.def(
      "export_fmu", &export_fmu, py::arg("file"), py::arg("path"), py::kw_only(),
      py::arg("muscle") = "", py::arg("joints") = Names(), py::arg("actuator") = "",
      py::arg("without_valves") = false, py::arg("inputs") = Names(), py::arg("outputs") = Names(),
      py::arg("parameters") = Names(), py::arg("sets") = py::none(), py::arg("fmi") = 2,
      py::arg("name") = "", py::arg("force") = false,
      "Writes an FMU for co-simulation in another program, and returns what is in it: its kind "
      "and\n"
      "a dict for each variable, with name, value_reference, type, causality, unit (SI), start "
      "and\n"
      "meaning.\n\n"
      "An actuator file becomes a tube (length, rate, gauge pressure -> tension); a rig, or a\n"
      "`muscle` of a robot, a muscle with its valves, or without them a tube; a robot its "
      "`joints`,\n"
      "all that have muscles if none is named; an experiment the machine with its controllers,\n"
      "with settings of the plan as `inputs`, channels as `outputs` (all if none is named) and\n"
      "values of its files as `parameters`. `fmi` is 2 or 3. Raises InputError for what is wrong\n"
      "with the file or the path, ValueError for what does not go together.");
}

}  // namespace sinew::python
