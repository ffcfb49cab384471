// cli/fmu.cpp - `sinew fmu export`: a file as an FMU, for co-simulation in other programs.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "fmu/export/export.h"
#include "sinew/json/json.h"
#include "sinew/run/folder/files.h"

namespace sinew::cli {

namespace {

struct FmuOptions {
  fmu::Asked asked;
  std::string out;
  bool force = false, json = false;
};

Json start_of(const fmu::Variable& v) {
  using T = fmu::Variable::Type;
  if (v.type == T::boolean) return v.start != 0;
  return v.type == T::integer ? Json(static_cast<int>(v.start)) : Json(v.start);
}

void print_json(const fmu::Fmu& made, const std::string& file) {
  Json out{{"file", file},
           {"kind", made.kind},
           {"name", made.name},
           {"model_identifier", made.identifier},
           {"token", made.token}};
  for (std::size_t k = 0; k < made.variables.size(); ++k) {
    const fmu::Variable& v = made.variables[k];
    Json entry{{"name", v.name},
               {"value_reference", k},
               {"type", fmu::word(v.type)},
               {"causality", fmu::word(v.causality)}};
    if (!v.unit.empty()) entry["unit"] = v.unit;
    using C = fmu::Variable::Causality;
    if (v.causality == C::parameter || v.causality == C::input) entry["start"] = start_of(v);
    entry["meaning"] = v.doc;
    out["variables"].push_back(entry);
  }
  fmt::print("{}\n", out.text(2));
}

void print_text(const fmu::Fmu& made, const std::string& file) {
  using C = fmu::Variable::Causality;
  const auto row = [&](C causality, const char* title) {
    std::string names;
    int count = 0;
    for (const fmu::Variable& v : made.variables)
      if (v.causality == causality && ++count <= 12) names += (count > 1 ? ", " : "") + v.name;
    if (count > 12) names += fmt::format(", … {} in all", count);
    if (count > 0) fmt::print("{:<12}{}\n", title, names);
  };
  fmt::print("{}: {} \"{}\", {:.0f} KB\n", file, made.kind, made.name,
             static_cast<double>(made.bytes.size()) / 1000);
  row(C::input, "inputs");
  row(C::output, "outputs");
  row(C::parameter, "parameters");
}

ExitCode export_fmu(const FmuOptions& options) {
  const fmu::Fmu made = fmu::make_fmu(options.asked);
  const std::string file = options.out.empty() ? made.identifier + ".fmu" : options.out;
  run::refuse_to_overwrite(file, options.force, {options.asked.file}, ".fmu");
  run::write_file(file, made.bytes);
  if (options.json)
    print_json(made, file);
  else
    print_text(made, file);
  return ok;
}

}  // namespace

void add_fmu(CLI::App& app, Action& action) {
  auto options = std::make_shared<FmuOptions>();
  fmu::Asked& asked = options->asked;
  CLI::App& fmu = subcommand(app, "fmu", "FMUs for co-simulation in other programs",
                             "sinew fmu export robots/leg/robot.toml --muscle hip_flexor");
  fmu.require_subcommand();
  CLI::App& sub =
      subcommand(fmu, "export",
                 "an actuator, a muscle with valves, joints with muscles, or a machine with "
                 "its controllers, as "
                 "an FMU",
                 "sinew fmu export experiments/walk-test-1.toml --input control.stiffness.knee "
                 "--output /joint/knee/angle --output /trolley/position -o leg.fmu");
  sub.add_option(
         "FILE", asked.file,
         "actuator: a tube; rig: its muscle; robot: its joints; experiment: the machine with "
         "its controllers")
      ->required();
  sub.add_option("-o,--out", options->out, "the FMU; NAME.fmu here");
  sub.add_flag("--force", options->force, "replace a file that is there");
  sub.add_option("--muscle", asked.muscle, "this muscle alone, with its valves");
  sub.add_flag("--without-valves", asked.without_valves, "a muscle whose pressure is an input");
  sub.add_option("--joint", asked.joints, "this joint with its muscles; may be repeated")
      ->allow_extra_args(false);
  sub.add_option("--actuator", asked.actuator, "which actuator, where the file has several");
  sub.add_option("--input", asked.inputs,
                 "a setting of the plan as an input: control.stiffness.JOINT …; may be repeated")
      ->allow_extra_args(false);
  sub.add_option("--output", asked.outputs,
                 "a channel of the run; may be repeated; all, if none is named")
      ->allow_extra_args(false);
  sub.add_option("--parameter", asked.parameters,
                 "a value of the experiment that an importer may set; may be repeated")
      ->allow_extra_args(false);
  sub.add_option("--fmi", asked.version, "version of the interface")
      ->transform(between(2, 3))
      ->capture_default_str();
  sub.add_option("--name", asked.name, "of the model; from the file, the muscle or the joints");
  add_sets(sub, asked.sets);
  sub.add_flag("--json", options->json, "what was written, as JSON");
  sub.callback([=, &action] { action = [=] { return export_fmu(*options); }; });
}

}  // namespace sinew::cli
