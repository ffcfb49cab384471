#include "fmu/export/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "fmu/export/archive.h"
#include "fmu/export/model_description.h"
#include "fmu/machine/machine.h"
#include "fmu/muscle/joint.h"
#include "fmu/muscle/muscle.h"
#include "fmu/muscle/tube.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/host/module.h"
#include "sinew/run/muscle/muscle_setup.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/setup/machine_setup.h"

namespace sinew::fmu {

namespace fs = std::filesystem;

namespace {

// Model to be packed.
struct Made {
  std::string kind, name, doc;
  Description description;
  std::vector<Variable> variables;
  std::string module;  // module with its functions
  bool sources = false;
  double stop_time = 1, step = 1e-3;  // [s]
};

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

template <class Model>
Made make_light(Description description, std::string name, std::string doc) {
  Made out{.kind = std::string(Model::kind),
           .name = std::move(name),
           .doc = std::move(doc),
           .module = "sinew_fmu_muscle.so",
           .sources = true};
  out.variables = Model(description).sheet().variables();
  out.description = std::move(description);
  return out;
}

Made make_tube(const ExportRequest& request, const std::string& kind) {
  if (kind == "actuator") {
    const auto file = experiment::load_machine_file(request.file, request.sets);
    const actuator::Actuator& a =
        config::named(file.experiment.actuators, request.actuator, request.file, "actuator");
    return make_light<Tube>(Tube::describe(a, file.experiment.air, 1, 0), a.name,
                            "A braided pneumatic muscle whose pressure is given");
  }
  const run::MuscleSetup read = run::muscle_setup(request.file, request.muscle, request.sets);
  const air::Muscle& m = read.muscle;
  return make_light<Tube>(Tube::describe(m.actuator, read.air, m.count, m.external_volume), m.name,
                          "A braided pneumatic muscle whose pressure is given");
}

Made make_muscle(const ExportRequest& request) {
  const run::MuscleSetup read = run::muscle_setup(request.file, request.muscle, request.sets);
  const double length = read.length > 0 ? read.length : read.muscle.actuator.long_end.length;
  return make_light<Muscle>(
      Muscle::describe(read.muscle, read.air, read.supply, {length, read.pressure}),
      read.muscle.name, "A braided pneumatic muscle with its valves");
}

Made make_joints(const ExportRequest& request) {
  const auto file = experiment::load_machine_file(request.file, request.sets);
  const experiment::Experiment& e = file.experiment;
  std::vector<std::string> joints = request.joints;
  if (joints.empty())
    for (const robot::Joint& j : e.robot.joints)
      if (j.kind == robot::Joint::Kind::driven) joints.push_back(j.name);
  const double pressure = e.start.pressure > 0 ? e.start.pressure : e.air.atmosphere;
  std::string name = fs::path(request.file).stem().string();
  if (!request.joints.empty()) name = fmt::format("{}", fmt::join(joints, "_"));
  return make_light<Joint>(
      Joint::describe(e.robot, run::muscles_of(e), joints, e.air, e.supply, pressure), name,
      fmt::format("Joints with their braided muscles and valves: {}", fmt::join(joints, ", ")));
}

Made make_machine(const ExportRequest& request) {
  const experiment::Experiment e = run::buildable(request.file, request.sets);
  Made out{.kind = std::string(Machine::kind),
           .name = e.name,
           .doc = e.title.empty() ? "A machine with its controllers" : e.title,
           .module = "sinew_fmu_machine.so",
           .step = 0.01};
  out.description = Machine::describe(e, {request.inputs, request.outputs, request.parameters});
  const Machine machine(out.description);
  out.variables = machine.sheet().variables();
  out.stop_time = machine.duration();
  return out;
}

Made make(const ExportRequest& request) {
  const std::string kind(config::tables_kind(config::compose(request.file, request.sets)));
  const bool of_machine =
      !request.inputs.empty() || !request.outputs.empty() || !request.parameters.empty();
  const bool of_joint = !request.joints.empty(), of_muscle = !request.muscle.empty();
  if (of_joint && of_muscle) refuse("found a muscle and joints; expected one of them");
  if (of_machine && (of_joint || of_muscle || kind != "experiment"))
    refuse(
        "inputs, outputs and parameters: expected an experiment, not one of its muscles or joints; "
        "other FMUs expose everything");
  if (of_joint && request.without_valves)
    refuse("found joints without valves; expected a muscle for that");
  if (!request.actuator.empty() && kind != "actuator")
    refuse("actuator: found a " + kind + " file; expected an actuator file");
  if (kind == "actuator") {
    if (of_joint || of_muscle)
      refuse("found an actuator file; expected a robot for muscle or joint");
    return make_tube(request, kind);
  }
  if (kind == "rig" || of_muscle) {
    if (of_joint) refuse("joint: found a rig, which has none; expected a robot or an experiment");
    return request.without_valves ? make_tube(request, kind) : make_muscle(request);
  }
  if (request.without_valves)
    refuse("found no muscle whose valves are to be left out; expected one");
  if (kind == "robot" || of_joint) return make_joints(request);
  if (kind == "experiment") return make_machine(request);
  config::fail({request.file, 0, 0}, "format", config::in_quotes(kind),
               "an actuator, rig, robot or experiment file");
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string out{std::istreambuf_iterator<char>(in), {}};
  if (!in || out.empty()) throw std::runtime_error(file.string() + ": cannot be read");
  return out;
}

// Returns a name that is valid for a C compiler and a file system.
std::string identifier_of(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool digit = c >= '0' && c <= '9';
    out += letter || (digit && !out.empty()) ? c : '_';
  }
  return out.empty() ? "model" : out;
}

fs::path module_of(const Made& made, const std::string& folder) {
  if (!folder.empty()) {
    if (!fs::is_regular_file(fs::path(folder) / made.module))
      refuse(fmt::format(
          "modules: found no {} in {}; expected the folder lib/sinew of an installation",
          made.module, folder));
    return fs::path(folder) / made.module;
  }
  fs::path found = host::find_module(made.module.c_str());
  for (const char* place : {"/usr/local/lib/sinew", "/usr/lib/sinew"})
    if (std::error_code none;
        found.empty() && fs::is_regular_file(place / fs::path(made.module), none))
      found = place / fs::path(made.module);
  if (found.empty())
    throw std::runtime_error(
        made.module +
        ": found no such module next to the program; expected it in lib/sinew of "
        "this installation; try cmake --build --preset all");
  return found;
}

void add_sources(std::vector<ArchiveFile>& files, const fs::path& folder, int version) {
  if (!fs::is_directory(folder))
    throw std::runtime_error(folder.string() +
                             ": found no sources of FMUs there; expected them "
                             "next to the modules; try cmake --build --preset all");
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) found.push_back(entry.path());
  std::ranges::sort(found);
  // The sources of the other version are left out.
  const std::string other = version == 2 ? "fmi3" : "fmi2";
  for (const fs::path& file : found)
    if (!file.filename().string().starts_with(other))
      files.push_back({"sources/" + fs::relative(file, folder).generic_string(), bytes_of(file)});
}

// Returns FMI's name of this platform; 2.0 has names only for x86-64.
std::string platform_folder(int version) {
#if defined(__x86_64__)
  return version == 2 ? "linux64" : "x86_64-linux";
#else
  if (version == 2) refuse("version: FMI 2.0 has no name for this kind of computer; expected 3");
  return "aarch64-linux";
#endif
}

// Variables must have unique names, by which importers find them.
void refuse_twins(const std::vector<Variable>& variables) {
  std::set<std::string> names;
  for (const Variable& v : variables)
    if (!names.insert(v.name).second)
      refuse(v.name +
             ": found twice among the variables; expected each joint, input, output and "
             "parameter once");
}

void refuse_unprintable(const std::string& name) {
  const bool blank = name.find_first_not_of(' ') == std::string::npos;
  if (!name.empty() && !blank &&
      std::ranges::all_of(name, [](char c) { return c >= ' ' && c <= '~'; }))
    return;
  refuse("name: found " + std::string(blank ? "nothing" : "characters that are no letters") +
         "; expected a name in plain letters");
}

}  // namespace

Fmu make_fmu(const ExportRequest& request) {
  if (request.version != 2 && request.version != 3)
    refuse(fmt::format("version: found {}; expected 2 or 3", request.version));
  Made made = make(request);
  if (!request.name.empty()) made.name = request.name;
  refuse_unprintable(made.name);
  refuse_twins(made.variables);

  ModelDescription model{.name = made.name,
                         .identifier = identifier_of(made.name),
                         .token = made.description.hash(),
                         .description = made.doc,
                         .version = SINEW_VERSION,
                         .stop_time = made.stop_time,
                         .step = made.step,
                         .sources = made.sources,
                         .variables = made.variables};
  std::vector<ArchiveFile> files;
  files.push_back({"modelDescription.xml",
                   request.version == 2 ? fmi2_description(model) : fmi3_description(model)});
  files.push_back({"documentation/index.html", variables_page(model)});
  const fs::path module = module_of(made, request.modules);
  files.push_back(
      {fmt::format("binaries/{}/{}.so", platform_folder(request.version), model.identifier),
       bytes_of(module)});
  files.push_back({"resources/model.txt", made.description.text()});
  for (const auto& [name, text] : made.description.attached())
    files.push_back({"resources/" + name, text});
  if (made.sources) {
    add_sources(files, module.parent_path() / "fmu_sources", request.version);
    if (request.version == 3)
      files.push_back({"sources/buildDescription.xml", build_description(model)});
  }
  return {made.kind, made.name, model.identifier, model.token, made.variables, archive_of(files)};
}

}  // namespace sinew::fmu
