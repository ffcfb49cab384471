#include "sinew/run/muscle/muscle_setup.h"

#include <cstring>
#include <filesystem>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/node.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/run/setup/machine_setup.h"
#include "sinew/run/setup/saved_state.h"
#include "sinew/units/hash.h"

namespace sinew::run {

namespace {

using State = air::DrivenMuscle::State;

constexpr SavedKind saved_kind{"sinew.muscle/1", "save() of a driven muscle", "muscle"};

std::uint64_t model_of(const MuscleSetup& setup) {
  const std::uint64_t parts[] = {setup.model, sizeof(State)};
  return units::hash(std::as_bytes(std::span(parts)), units::hash(SINEW_VERSION));
}

}  // namespace

std::vector<std::byte> save(const air::DrivenMuscle& muscle, const MuscleSetup& setup) {
  return sealed(saved_kind, model_of(setup), std::as_bytes(std::span(&muscle.state(), 1)));
}

void restore(air::DrivenMuscle& muscle, const MuscleSetup& setup,
             std::span<const std::byte> saved) {
  State state;
  const std::span<const std::byte> bytes =
      unsealed(saved_kind, model_of(setup), sizeof state, saved);
  std::memcpy(&state, bytes.data(), sizeof state);
  muscle.restore(state);
}

namespace {

// Returns the length of the element at the start; 0 if it follows from the stand itself [m].
double start_length(const plant::StandSetup& s) {
  return s.load.mode == robot::Stand::Load::Mode::driven ? s.load.length.at(0) : s.start.length;
}

// Hashes the values alone, since comments and sources of a file do not affect the muscle.
std::uint64_t model_of(const config::Node& values, const std::string& name) {
  return units::hash(name, units::hash(config::to_toml(values)));
}

MuscleSetup of_stand(const experiment::MachineFile& file, const std::string& path,
                     const std::string& name) {
  const plant::StandSetup s = stand_setup(file.experiment);
  if (s.cylinder)
    config::fail({path, 0, 0}, "element.cylinder", "an air cylinder in the muscle's place",
                 "a braided muscle");
  const std::vector<air::Muscle> only{s.muscle};
  return {config::named(only, name, path, "muscle"),
          s.air,
          s.supply,
          start_length(s),
          s.start.pressure,
          experiment::resolved(file, SINEW_VERSION),
          model_of(experiment::values_in_si(file), s.muscle.name)};
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
  if (kind != "robot" && kind != "experiment")
    config::fail({path, 0, 0}, "format", config::in_quotes(kind),
                 "a rig, robot or experiment file");
  const experiment::MachineFile file = experiment::load_machine_file(root, path);
  return file.experiment.stand ? of_stand(file, path, name) : of_machine(file, path, name);
}

}  // namespace

MuscleSetup muscle_setup(const std::string& path, const std::string& name,
                         const std::vector<std::string>& sets) {
  return of_tree(config::compose(path, sets), path, name);
}

// Uses the last name of the path only, since the text does not depend on a folder.
MuscleSetup muscle_setup_of(const std::string& text, const std::string& path,
                            const std::string& name) {
  const std::string file = std::filesystem::path(path).filename().string();
  return of_tree(config::parse_text(text, file), file, name);
}

}  // namespace sinew::run
