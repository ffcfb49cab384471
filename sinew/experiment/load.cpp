
#include <cmath>
#include <filesystem>

#include "sinew/config/changes.h"
#include "sinew/config/compose.h"
#include "sinew/config/valve_timing.h"
#include "sinew/config/write/writer.h"
#include "sinew/control/gait/legs.h"
#include "sinew/experiment/check.h"
#include "sinew/experiment/experiment.fields.h"
#include "sinew/experiment/experiment.h"
#include "sinew/experiment/imported.fields.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

using config::Problem;

namespace {

Problem not_an_experiment(const config::Node& root, const std::string& path) {
  Problem p;
  p.where.file = path;
  p.key = "format";
  p.found = config::in_quotes(config::format_kind(root));
  p.expected = config::in_quotes(config::newest_format("experiment"));
  p.try_this = "sinew check " + path;
  return p;
}

// Reads the valves' pulses: from numbers in the file, from predict.dat, or else the identity.
void read_timing(Experiment& e) {
  constexpr std::size_t rows = config::ValveTiming::rows;
  if (e.pulses.closing.size() == rows && e.pulses.opening.size() == rows) {
    for (std::size_t duty = 0; duty < rows; ++duty) {
      e.timing.closing[duty] = static_cast<std::uint16_t>(e.pulses.closing[duty]);
      e.timing.opening[duty] = static_cast<std::uint16_t>(e.pulses.opening[duty]);
    }
  } else if (!e.robot.low_level.valve_timing.empty()) {
    const config::ValveTiming read = config::read_valve_timing(e.robot.low_level.valve_timing);
    e.timing = {.closing = read.closing, .opening = read.opening};
  } else {
    e.timing = signals::identity_timing(static_cast<std::uint16_t>(e.robot.low_level.pwm_ticks));
  }
}

// Returns whether a file is in robots/<name>/, where numbers must have a source.
bool in_robots(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return folder.filename() == "robots" || folder.parent_path().filename() == "robots";
}

// Reads a file of that kind; the rest of the experiment keeps its defaults.
Experiment read(const config::Node& root, std::string_view kind, const std::string& path) {
  const bool runs = kind == "experiment";
  Experiment e;
  e.path = path;
  e.name = std::filesystem::path(path).stem().string();
  if (runs && config::is_on_stand(root)) {
    e.stand.emplace();
    e.log.period = 1e-3;
  }

  config::Reader reader(root,
                        {.atmosphere = config::atmosphere_of(root), .needs_source = in_robots});
  std::string format, written_by;
  std::vector<ImportedFile> imported;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  if (runs) {  // present in a resolved.toml
    reader.text({.name = "sinew_version", .optional = true, .doc = "that ran"}, written_by);
    fields(reader, imported);
  }
  machine_fields(reader, kind, e);
  if (runs) {
    e.plan = gait::plan_for(e.robot);
    run_fields(reader, e);
  }
  reader.finish();

  e.origins = reader.origins();
  e.warnings = reader.warnings();
  e.unsourced = reader.unsourced();
  e.plan.settle = e.start.settle;
  if ((runs && !e.stand) || kind == "robot") read_timing(e);
  refuse_contradictions(kind, e);
  return e;
}

// Writes the values in the order in which they are read best.
void write(config::Writer& writer, std::string_view kind, Experiment& e) {
  if (kind == "experiment") run_fields(writer, e);
  machine_fields(writer, kind, e);
}

}  // namespace

Experiment load(const std::string& path, const std::vector<std::string>& sets) {
  return load(config::compose(path, sets), path);
}

Experiment load(const config::Node& root, const std::string& path) {
  const std::string_view kind = config::format_kind(root);
  if (kind != "experiment") throw config::Error(not_an_experiment(root, path));
  return read(root, kind, path);
}

const gas::Valve* find_valve(const Experiment& e, std::string_view name) {
  for (const gas::Valve& v : e.valves)
    if (v.name == name) return &v;
  return nullptr;
}

MachineFile load_machine_file(const std::string& path, const std::vector<std::string>& sets) {
  return load_machine_file(config::compose(path, sets), path);
}

MachineFile load_machine_file(const config::Node& root, const std::string& path) {
  const std::string kind(config::format_kind(root));
  if (kind != "experiment" && kind != "robot" && kind != "actuator" && kind != "valves" &&
      kind != "wiring")
    config::fail({path, 0, 0}, "format", config::in_quotes(kind),
                 "an experiment, robot, actuator, valves or wiring file");
  return {kind, read(root, kind, path)};
}

config::Node values_in_si(MachineFile file) {
  config::Writer writer;
  write(writer, file.kind, file.experiment);
  return writer.root();
}

Experiment without_files(Experiment e) {
  if (e.stand) return e;
  e.pulses.closing.assign(e.timing.closing.begin(), e.timing.closing.end());
  e.pulses.opening.assign(e.timing.opening.begin(), e.timing.opening.end());
  e.robot.low_level.valve_timing.clear();
  return e;
}

std::string resolved(const MachineFile& file, const std::string& version) {
  Experiment e = without_files(file.experiment);  // visitors take what they print by reference
  config::Writer writer(&e.origins);
  writer.format(file.kind);
  std::string sinew = version;
  if (file.kind == "experiment")
    writer.text({.name = "sinew_version", .optional = true, .doc = "that ran"}, sinew);
  write(writer, file.kind, e);
  return writer.text();
}

std::string resolved(const Experiment& experiment, const std::string& version) {
  return resolved(MachineFile{"experiment", experiment}, version);
}

using signals::Tick;

Tick last_tick(const Experiment& e) {
  // One tick is added to the run of a stand, so that its last instant is sampled too.
  if (e.stand) return std::llround(e.stand->duration / signals::tick_seconds) + 1;
  const double vent = e.plan.finish == gait::Plan::Finish::vent ? e.robot.low_level.vent_time : 0.0;
  const auto gait_period_ticks = std::llround(e.plan.high_level_period / signals::tick_seconds);
  const Tick plan = gait::periods(e.robot, e.plan) * gait_period_ticks;
  // One period is added for the last valves to shut and for a sample at the plan's end.
  const Tick last = e.robot.low_level.pwm_ticks;
  return plan + std::llround(vent / signals::tick_seconds) + last;
}

}  // namespace sinew::experiment
