#include <cmath>
#include <filesystem>

#include "sinew/config/compose.h"
#include "sinew/config/valve_timing.h"
#include "sinew/config/writer.h"
#include "sinew/experiment/experiment.fields.h"
#include "sinew/experiment/experiment.h"
#include "sinew/signals/tick.h"

namespace sinew::experiment {

using config::Problem;

namespace {

// The air first: what is gauge in the rest of the file depends on its atmosphere.
double atmosphere_of(const config::Node& root) {
  config::Reader reader(root);
  gas::Air air;
  const units::Field field{.name = "air", .optional = true, .doc = "atmosphere"};
  reader.group(field, [&](auto& g) { gas::fields(g, air); });
  return air.atmosphere;
}

// A contradiction between values, at the key's place if the file has it.
Problem problem_of(const robot::Contradiction& c, const Experiment& e) {
  Problem p;
  p.where.file = e.path;
  p.key = c.key;
  p.found = c.found;
  p.expected = c.expected;
  p.try_this = c.try_this;
  // The key itself, or the first key of the table it names.
  const config::Origin* nearest = config::find_origin(e.origins, c.key);
  for (const config::Origin& o : e.origins)
    if (!nearest && o.path.rfind(c.key + ".", 0) == 0) nearest = &o;
  if (nearest && !nearest->where.file.empty()) p.where = nearest->where;
  return p;
}

Problem not_an_experiment(const config::Node& root, const std::string& path) {
  Problem p;
  p.where.file = path;
  p.key = "format";
  p.found = config::in_quotes(config::format_kind(root));
  p.expected = "\"sinew.experiment/1\"";
  p.try_this = "sinew check " + path;
  return p;
}

// Names that lead from one table to another.
void check_names(const Experiment& e, std::vector<robot::Contradiction>& out) {
  const auto known = [](const auto& list) {
    std::vector<std::string_view> names;
    for (const auto& item : list) names.push_back(item.name);
    return names;
  };
  const auto need = [&](const std::string& key, const std::string& name, const auto& list) {
    for (const auto& item : list)
      if (item.name == name) return;
    const std::vector<std::string_view> names = known(list);
    const std::string like(config::closest(name, names));
    out.push_back({key, config::in_quotes(name), config::either(names),
                   like.empty() ? "" : config::in_quotes(like)});
  };
  for (const robot::Muscle& m : e.robot.muscles) {
    need("muscle." + m.name + ".actuator", m.actuator, e.actuators);
    need("muscle." + m.name + ".inlet.valve", m.inlet, e.valves);
    if (!m.exhaust.empty()) need("muscle." + m.name + ".exhaust.valve", m.exhaust, e.valves);
  }
  for (const std::string& name : e.start.blocked) need("start.blocked", name, e.robot.joints);
  for (const auto& [name, angle] : e.start.joint_angles)
    need("start.joint_angles." + name, name, e.robot.joints);
  for (const robot::Joint& j : e.robot.joints)
    if (!e.start.joint_angles.count(j.name))
      out.push_back({"start.joint_angles", "no " + j.name, "an angle for every joint", ""});
}

void check_numbers(const Experiment& e, std::vector<robot::Contradiction>& out) {
  for (const auto* column : {&e.pulses.closing, &e.pulses.opening})
    if (!column->empty() && column->size() != config::ValveTiming::rows)
      out.push_back({"pulses", std::to_string(column->size()) + " numbers", "101, by duty", ""});
  const auto whole = [&](const std::string& key, double value, double unit, const char* what) {
    const double n = value / unit;
    if (std::abs(n - std::round(n)) > 1e-9 * std::max(1.0, n))
      out.push_back({key, std::to_string(value) + " s", std::string("a multiple of ") + what, ""});
  };
  whole("log.period", e.log.period, signals::tick_seconds, "0.1 ms");
  const double period = e.robot.low_level.pwm_ticks * signals::tick_seconds;
  whole("control.brain_period", e.plan.brain_period, period, "the low level's period");
  if (e.plant != "planar") out.push_back({"plant", config::in_quotes(e.plant), "planar", ""});
  if (e.robot.joints.empty() || e.robot.joints.size() > 2)
    out.push_back({"joint", std::to_string(e.robot.joints.size()) + " joints",
                   "one or two: what the planar plant holds", ""});
}

// The valves' pulses: as numbers in the file, from predict.dat, or the identity.
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
  }
}

}  // namespace

Experiment load(const std::string& path, const std::vector<std::string>& sets) {
  return load(config::compose(path, sets), path);
}

Experiment load(config::Node root, const std::string& path) {
  if (config::format_kind(root) != "experiment") throw config::Error(not_an_experiment(root, path));
  Experiment e;
  e.path = path;
  e.name = std::filesystem::path(path).stem().string();

  // Numbers in robots/ must say where they come from.
  config::ReaderOptions options{.atmosphere = atmosphere_of(root)};
  options.missing_source = [](const std::string& file) {
    return file.find("robots/") != std::string::npos ? config::Severity::error
                                                     : config::Severity::ignore;
  };
  config::Reader reader(root, options);
  std::string format;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  std::string written_by;  // a resolved.toml says it
  reader.text({.name = "sinew_version", .optional = true, .doc = "that ran"}, written_by);
  machine_fields(reader, e);
  e.plan = gait::plan_for(e.robot);
  run_fields(reader, e);
  reader.finish();
  e.origins = reader.origins();
  e.warnings = reader.warnings();
  e.plan.settle = e.start.settle;
  read_timing(e);

  // What each value allows, but not all together.
  std::vector<robot::Contradiction> wrong;
  check_names(e, wrong);
  check_numbers(e, wrong);
  for (robot::Contradiction& c : robot::contradictions(e.robot)) wrong.push_back(std::move(c));
  if (wrong.empty()) wrong = gait::contradictions(e.robot, e.plan);
  std::vector<Problem> problems;
  for (const robot::Contradiction& c : wrong) problems.push_back(problem_of(c, e));
  if (!problems.empty()) throw config::Error(std::move(problems));
  return e;
}

std::string resolved(const Experiment& experiment, const std::string& version) {
  Experiment e = experiment;  // visitors take what they print by reference
  e.pulses.closing.assign(e.timing.closing.begin(), e.timing.closing.end());
  e.pulses.opening.assign(e.timing.opening.begin(), e.timing.opening.end());
  e.robot.low_level.valve_timing.clear();
  config::Writer writer(&e.origins);
  writer.format("experiment");
  std::string sinew = version;
  writer.text({.name = "sinew_version", .optional = true, .doc = "that ran"}, sinew);
  run_fields(writer, e);
  machine_fields(writer, e);
  return writer.text();
}

}  // namespace sinew::experiment
