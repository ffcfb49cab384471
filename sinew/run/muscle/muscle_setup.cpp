#include "sinew/run/muscle/muscle_setup.h"

#include <filesystem>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/named.h"
#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/experiment/rig/rig.h"
#include "sinew/run/setup/planar_setup.h"
#include "sinew/units/hash.h"

namespace sinew::run {

namespace {

// Length of the element at the start; 0 where only the stand would know it  [m].
double start_length(const plant::StandSetup& s) {
  return s.load.mode == plant::Load::Mode::driven ? s.load.length.at(0) : s.start.length;
}

// The values alone: what a file says of them is no part of the muscle.
std::uint64_t model_of(const config::Node& values, const std::string& name) {
  return units::hash(name, units::hash(config::to_toml(values)));
}

MuscleSetup of_rig(const config::Node& root, const std::string& path, const std::string& name) {
  const rig::Experiment e = rig::load(root, path);
  const plant::StandSetup s = rig::setup_of(e);
  if (s.cylinder)
    config::fail({path, 0, 0}, "element.cylinder", "an air cylinder in the muscle's place",
                 "a braided muscle");
  const std::vector<air::Muscle> only{s.muscle};
  return {config::named(only, name, path, "muscle"),
          s.air,
          s.supply,
          start_length(s),
          s.start.pressure,
          rig::resolved(e, SINEW_VERSION),
          model_of(rig::values_in_si(e), s.muscle.name)};
}

MuscleSetup of_machine(const experiment::MachineFile& file, const std::string& path,
                       const std::string& name) {
  const experiment::Experiment& e = file.experiment;
  const std::vector<air::Muscle> muscles = muscles_of(e);
  const air::Muscle& muscle = config::named(muscles, name, path, "muscle");
  const robot::Muscle& mounted = config::named(e.robot.muscles, muscle.name, path, "muscle");
  return {
      muscle,
      e.air,
      e.supply,
      mounted.mount_length,
      e.start.pressure > 0 ? e.start.pressure : e.air.atmosphere,
      experiment::resolved(file, SINEW_VERSION),
      model_of(experiment::values_in_si({file.kind, experiment::without_files(e)}), muscle.name)};
}

MuscleSetup of_tree(const config::Node& root, const std::string& path, const std::string& name) {
  const std::string kind(config::format_kind(root));
  if (kind == "rig") return of_rig(root, path, name);
  if (kind != "robot" && kind != "experiment")
    config::fail({path, 0, 0}, "format", config::in_quotes(kind),
                 "a rig, robot or experiment file");
  return of_machine(experiment::load_machine_file(root, path), path, name);
}

}  // namespace

MuscleSetup muscle_setup(const std::string& path, const std::string& name,
                         const std::vector<std::string>& sets) {
  return of_tree(config::compose(path, sets), path, name);
}

// The name alone: a text stands in no folder whose files need more than others.
MuscleSetup muscle_setup_of(const std::string& text, const std::string& path,
                            const std::string& name) {
  const std::string file = std::filesystem::path(path).filename().string();
  return of_tree(config::parse_text(text, file), file, name);
}

}  // namespace sinew::run
