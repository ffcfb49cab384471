#include "cli/machine_file.h"

#include <algorithm>

#include "sinew/config/compose.h"
#include "sinew/config/writer.h"
#include "sinew/experiment/experiment.fields.h"

namespace sinew::cli {

namespace {

using config::Severity;

// How bad a value without a source is outside robots/, where it is an error.
enum class Sources { ignored, asked };

// Gauge pressures need the atmosphere of the same file.
double atmosphere_of(const config::Node& root) {
  config::Reader reader(root);
  gas::Air air;
  reader.group({.name = "air", .optional = true}, [&](auto& g) { gas::fields(g, air); });
  return air.atmosphere;
}

// The tables of a kind of file, in an experiment's namespace.
template <class Visitor>
void part_fields(Visitor& v, std::string_view kind, experiment::Experiment& e) {
  if (kind == "robot" || kind == "experiment") experiment::machine_fields(v, e);
  if (kind == "actuator")
    v.each({.name = "actuator", .doc = "by name"}, e.actuators,
           [](auto& g, actuator::Actuator& a) { actuator::fields(g, a); });
  if (kind == "valves") gas::fields(v, e.valves);
}

// A contradiction's place: its key's, or that of the first key in the table it names.
config::Problem located(const robot::Contradiction& c, const config::Origins& origins,
                        const std::string& path) {
  const config::Origin* nearest = config::find_origin(origins, c.key);
  for (const config::Origin& o : origins)
    if (!nearest && o.path.starts_with(c.key + ".") && o.where.line > 0) nearest = &o;
  config::Location where{path, 0, 0};
  if (nearest && !nearest->where.file.empty()) where = nearest->where;
  return {where, c.key, c.found, c.expected, c.try_this};
}

template <class Named>
void need(const std::vector<Named>& list, const std::string& name, const std::string& key,
          std::vector<robot::Contradiction>& out) {
  std::vector<std::string_view> names;
  for (const Named& item : list) names.push_back(item.name);
  for (const std::string_view known : names)
    if (known == name) return;
  const std::string_view near = config::closest(name, names);
  out.push_back({key, config::in_quotes(name), config::either(names),
                 near.empty() ? "" : config::in_quotes(near)});
}

// What an experiment's load() asks of a robot, for a robot alone.
void check_robot(const MachineFile& file, const std::string& path) {
  const experiment::Experiment& e = file.experiment;
  std::vector<robot::Contradiction> wrong;
  for (const robot::Muscle& m : e.robot.muscles) {
    need(e.actuators, m.actuator, "muscle." + m.name + ".actuator", wrong);
    need(e.valves, m.inlet, "muscle." + m.name + ".inlet.valve", wrong);
    if (!m.exhaust.empty()) need(e.valves, m.exhaust, "muscle." + m.name + ".exhaust.valve", wrong);
  }
  for (robot::Contradiction& c : robot::contradictions(e.robot)) wrong.push_back(std::move(c));
  if (wrong.empty()) return;
  std::vector<config::Problem> problems;
  for (const robot::Contradiction& c : wrong) problems.push_back(located(c, file.origins, path));
  throw config::Error(std::move(problems));
}

// The tables of the file's kind. Keys that nobody reads are left to others for an experiment: its
// load() has complained of them.
void read_part(const config::Node& root, Sources sources, MachineFile& file) {
  config::ReaderOptions options{.atmosphere = atmosphere_of(root)};
  options.missing_source = [=](const std::string& name) {
    if (name.find("robots/") != std::string::npos) return Severity::error;
    return sources == Sources::asked ? Severity::warning : Severity::ignore;
  };
  config::Reader reader(root, options);
  std::string format;
  reader.text({.name = "format"}, format);
  part_fields(reader, file.kind, file.experiment);
  if (file.kind == "experiment") {
    file.experiment.plan = gait::plan_for(file.experiment.robot);
    experiment::run_fields(reader, file.experiment);
    reader.finish_part();
  } else {
    reader.finish();
  }
  file.origins = reader.origins();
  file.warnings = reader.warnings();
}

}  // namespace

MachineFile read_machine_file(const std::string& path, const std::vector<std::string>& sets) {
  const config::Node root = config::compose(path, sets);
  MachineFile file;
  file.kind = config::format_kind(root);
  if (file.kind == "experiment") {
    file.experiment = experiment::load(root, path);
    file.origins = file.experiment.origins;
    file.warnings = file.experiment.warnings;
    return file;
  }
  if (file.kind != "robot" && file.kind != "actuator" && file.kind != "valves") {
    config::fail({path, 0, 0}, "format", config::in_quotes(file.kind),
                 "an experiment, robot, actuator or valves file");
  }
  read_part(root, Sources::ignored, file);
  if (file.kind == "robot") check_robot(file, path);
  return file;
}

// Whatever is told of only when sources are asked for.
std::vector<config::Problem> without_source(const std::string& path) {
  const config::Node root = config::compose(path);
  MachineFile ignored, asked;
  ignored.kind = asked.kind = config::format_kind(root);
  read_part(root, Sources::ignored, ignored);
  read_part(root, Sources::asked, asked);

  std::vector<std::string> known;
  for (const config::Problem& p : ignored.warnings) known.push_back(config::to_text(p));
  std::erase_if(asked.warnings, [&](const config::Problem& p) {
    return std::ranges::find(known, config::to_text(p)) != known.end();
  });
  return asked.warnings;
}

std::vector<config::Problem> unreachable(const experiment::Experiment& e) {
  std::vector<config::Problem> problems;
  for (const robot::Contradiction& c : gait::unreachable(e.robot, e.plan))
    problems.push_back(located(c, e.origins, e.path));
  return problems;
}

config::Node values_in_si(MachineFile& file) {
  config::Writer writer;
  if (file.kind == "experiment") experiment::run_fields(writer, file.experiment);
  part_fields(writer, file.kind, file.experiment);
  return writer.root();
}

}  // namespace sinew::cli
