// python/binding/fmu.cpp - export of files as FMUs.
#include <pybind11/stl.h>

#include "fmu/export/export.h"
#include "python/binding/bind.h"
#include "sinew/files/values.h"
#include "sinew/run/folder/files.h"

namespace sinew::python {

namespace {

using Causality = fmu::Variable::Causality;
using Names = std::vector<std::string>;

py::object start_of(const fmu::Variable& v) {
  using T = fmu::Variable::Type;
  if (v.type == T::boolean) return py::bool_(v.start != 0);
  return v.type == T::integer ? py::object(py::int_(static_cast<int>(v.start)))
                              : py::object(py::float_(v.start));
}

py::dict summary_of(const fmu::Fmu& made, const std::string& path) {
  py::dict out;
  out["file"] = path_text(path);
  out["kind"] = made.kind;
  out["name"] = made.name;
  out["model_identifier"] = made.identifier;
  out["token"] = made.token;
  py::list variables;
  for (std::size_t k = 0; k < made.variables.size(); ++k) {
    const fmu::Variable& v = made.variables[k];
    py::dict entry;
    entry["name"] = v.name;
    entry["value_reference"] = k;
    entry["type"] = fmu::word(v.type);
    entry["causality"] = fmu::word(v.causality);
    if (!v.unit.empty()) entry["unit"] = v.unit;
    if (v.causality == Causality::parameter || v.causality == Causality::input)
      entry["start"] = start_of(v);
    entry["meaning"] = v.doc;
    variables.append(entry);
  }
  out["variables"] = variables;
  return out;
}

py::dict export_fmu(const py::object& file, const py::object& path, const std::string& muscle,
                    const Names& joints, const std::string& actuator, bool without_valves,
                    const Names& inputs, const Names& outputs, const Names& parameters,
                    const py::object& sets, int fmi, const std::string& name, bool force) {
  fmu::ExportRequest request{.file = path_of(file), .name = name, .version = fmi};
  config::Origins plain;  // for the units of numbers
  request.sets = sets_of(sets, [&]() -> const config::Origins& {
    if (plain.empty()) plain = files::values(request.file).origins;
    return plain;
  });
  request.actuator = actuator;
  request.muscle = muscle;
  request.joints = joints;
  request.without_valves = without_valves;
  request.inputs = inputs;
  request.outputs = outputs;
  request.parameters = parameters;
  const std::string out = path_of(path);
  fmu::Fmu made;
  {
    const py::gil_scoped_release unlocked;
    made = fmu::make_fmu(request);
    run::refuse_to_overwrite(out, force, {request.file}, ".fmu");
    run::write_file(out, made.bytes);
  }
  return summary_of(made, out);
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
