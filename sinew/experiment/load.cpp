#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

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
#include "sinew/experiment/numbers.h"
#include "sinew/robot/legs.h"
#include "sinew/signals/tick.h"
#include "sinew/units/hash.h"
#include "sinew/units/quantity.h"
#include "sinew/units/ranges.h"
#include "sinew/units/shell.h"

namespace sinew::experiment {

using config::Problem;

namespace {

Problem not_an_experiment(const config::Node& root, const std::string& path) {
  const std::string_view kind = config::format_kind(root);
  Problem p;
  p.where.file = path;
  p.key = "format";
  p.found = config::in_quotes(kind);
  p.expected = config::in_quotes(config::newest_format("experiment"));
  const char* command = kind == "plan" ? "sweep" : kind == "tuning" ? "tune" : "check";
  p.try_this = fmt::format("sinew {} {}", command, units::shell_word(path));
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

// Gives the plan the time before its first phase.
void copy_settle(Experiment& e) { e.plan.settle = e.start.settle; }

// Returns whether a file is in robots/<name>/, where numbers must have a source.
bool in_robots(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return folder.filename() == "robots" || folder.parent_path().filename() == "robots";
}

// Warns of given numbers that the fit of a bladder excludes (actuator::loosen).
void warn_of_loose_bladders(Experiment& e) {
  const auto warn = [&e](const std::string& key, const std::string& of) {
    const config::Origin* origin = config::find_origin(e.origins, key);
    const config::Origin* fit = config::find_origin(e.origins, of + ".bladder.fit");
    if (!origin || origin->is_default || !fit) return;
    if (units::parse_quantity(origin->text, origin->unit, e.air.atmosphere).si == 0) return;
    e.warnings.push_back({origin->where, key,
                          config::in_quotes(origin->text) + ", which has no effect",
                          "0 with " + of + ".bladder.fit = " + config::in_quotes(fit->text),
                          "to remove it, or \"stretched\""});
  };
  for (const actuator::Actuator& a : e.actuators) {
    if (a.bladder.fit == actuator::Bladder::Fit::stretched) continue;
    const std::string of = "actuator." + a.name;
    for (const char* key : {".bladder.stiffness", ".bladder.quadratic", ".bladder.cubic",
                            ".bladder.saturating_tension", ".effectiveness.threshold"})
      warn(of + key, of);
    if (a.bladder.fit == actuator::Bladder::Fit::liner) warn(of + ".wall.thickness", of);
    for (const robot::Muscle& m : e.robot.muscles)
      if (m.actuator == a.name) warn("muscle." + m.name + ".bladder_stiffness", of);
  }
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
  warn_of_loose_bladders(e);
  e.unsourced = reader.unsourced();
  copy_settle(e);
  if ((runs && !e.stand) || kind == "robot") read_timing(e);
  refuse_contradictions(kind, e);
  return e;
}

// Visits the values in the order in which they are read best.
void visit(units::EachField& visitor, std::string_view kind, Experiment& e) {
  if (kind == "experiment") run_fields(visitor, e);
  machine_fields(visitor, kind, e);
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
  visit(writer, file.kind, file.experiment);
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
  visit(writer, file.kind, e);
  return writer.text();
}

std::string resolved(const Experiment& experiment, const std::string& version) {
  return resolved(MachineFile{"experiment", experiment}, version);
}

// Numbers that are set.

namespace {

// Returns the keys of gains that the plan takes from the robot, each with the robot's key.
std::map<std::string, std::string> inherited_gains(const Experiment& e) {
  std::map<std::string, std::string> out;
  if (e.stand) return out;
  const std::vector<int> joints = robot::legs_of(e.robot).front().joints;
  for (std::size_t j = 0; j < joints.size() && j < e.plan.joints.size(); ++j)
    for (const std::string gain : {"angle", "stiffness", "velocity"}) {
      const std::string key = "control.gains." + e.plan.joints[j].name + "." + gain;
      const config::Origin* given = config::find_origin(e.origins, key);
      const std::string& name = e.robot.joints[static_cast<std::size_t>(joints[j])].name;
      if (!given || given->is_default) out[key] = "joint." + name + "." + gain + "_gain";
    }
  return out;
}

}  // namespace

Numbers::Numbers(const Experiment& like, const std::vector<std::string>& keys)
    : has_(keys.size()), units_(keys.size()), values_(keys.size()) {
  const std::map<std::string, std::string> inherited = inherited_gains(like);
  const auto find = [&](std::string_view key) {
    return static_cast<std::size_t>(std::ranges::find(keys, key) - keys.begin());
  };
  units::EachField visitor([&](const units::VisitedField& f) {
    hash_ = units::hash(f.path, hash_);
    std::size_t& key = key_of_.emplace_back(absent);
    // A key of a table within a list cannot be set.
    if (f.path.find('[') != f.path.npos) return;
    if (f.numbers) find_elements(f, keys);
    if (!f.number && !f.whole) return;
    if (const std::size_t own = find(f.path); own < keys.size()) {
      key = own;
      has_[own] = true;
      values_[own] = f.number ? *f.number : *f.whole;
      if (f.number) units_[own] = f.field.unit;
    } else if (const auto from = inherited.find(std::string(f.path)); from != inherited.end()) {
      if (const std::size_t robots = find(from->second); robots < keys.size()) key = robots;
    }
  });
  Experiment e = like;  // visitors take values by reference
  visit(visitor, "experiment", e);
}

// Finds the keys of elements of this list, "polynomial[1]".
void Numbers::find_elements(const units::VisitedField& list, const std::vector<std::string>& keys) {
  for (std::size_t i = 0; i < list.numbers->size(); ++i) {
    const auto key = std::ranges::find(keys, fmt::format("{}[{}]", list.path, i));
    if (key == keys.end()) continue;
    const auto own = static_cast<std::size_t>(key - keys.begin());
    has_[own] = has_elements_ = true;
    values_[own] = (*list.numbers)[i];
    units_[own] = list.per.empty()
                      ? std::string(list.field.unit)
                      : units::coefficient_unit(list.field.unit, list.per, static_cast<int>(i));
  }
}

bool Numbers::set(Experiment& e, std::span<const double> values) const {
  return put(e, values, true);
}

bool Numbers::set_unbounded(Experiment& e, std::span<const double> values) const {
  return put(e, values, false);
}

bool Numbers::put(Experiment& e, std::span<const double> values, bool bounded) const {
  std::uint64_t hash = 0;
  std::size_t number = 0;
  bool good = !has_elements_ && std::ranges::find(has_, false) == has_.end();
  units::EachField visitor([&](units::VisitedField& f) {
    hash = units::hash(f.path, hash);
    const std::size_t key = number < key_of_.size() ? key_of_[number] : absent;
    ++number;
    if (key == absent) return;
    const double value = values[key];
    good = good && (!bounded || units::is_within(f.field, value)) &&
           (f.number || (f.whole && value == std::floor(value) &&
                         std::abs(value) <= std::numeric_limits<int>::max()));
    if (!good) return;
    if (f.number) *f.number = value;
    if (f.whole) *f.whole = static_cast<int>(value);
  });
  if (bounded) visitor.on_conflict([&](const auto&...) { good = false; });
  visit(visitor, "experiment", e);
  if (!good || hash != hash_) return false;
  copy_settle(e);
  // Numbers of a file's or a list's pulses are not set here, and stay.
  if (!e.stand && e.pulses.closing.empty() && e.robot.low_level.valve_timing.empty())
    read_timing(e);
  return true;
}

bool same_values(const Experiment& a, const Experiment& b) {
  const auto text = [](const Experiment& e) {
    return config::to_toml(values_in_si({"experiment", e}));
  };
  return a.timing.closing == b.timing.closing && a.timing.opening == b.timing.opening &&
         a.plan.settle == b.plan.settle && text(a) == text(b);
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
