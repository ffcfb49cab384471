#include <filesystem>

#include "sinew/config/compose.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/imported.fields.h"
#include "sinew/experiment/rig/check.h"
#include "sinew/experiment/rig/rig.fields.h"

namespace sinew::rig {
namespace {

plant::Schedule schedule(double constant, const std::vector<plant::Point>& points) {
  return points.empty() ? plant::Schedule(constant) : plant::Schedule(points);
}

air::Cylinder cylinder_of(const Element::Cylinder& c, const gas::Valve* in, const gas::Valve* out) {
  air::Cylinder cylinder{.mode = air::Cylinder::Mode::single_acting,
                         .bore = c.bore,
                         .rod_diameter = c.rod_diameter,
                         .stroke = c.stroke,
                         .dead_volume = {c.dead_volume, 0}};
  if (in) cylinder.inlet[air::up] = *in;
  if (out) cylinder.exhaust[air::up] = *out;
  return cylinder;
}

}  // namespace

const gas::Valve* find_valve(const Experiment& experiment, const std::string& name) {
  for (const gas::Valve& v : experiment.valves)
    if (v.name == name) return &v;
  return nullptr;
}

std::vector<plant::Point> steps_of(const std::vector<plant::Point>& points) {
  std::vector<plant::Point> out;
  for (const plant::Point& p : points) {
    if (!out.empty()) out.push_back({p.at, out.back().value});
    out.push_back(p);
  }
  return out;
}

plant::StandSetup setup_of(const Experiment& e) {
  plant::StandSetup s{.air = e.air, .supply = e.supply};
  const gas::Valve* inlet = find_valve(e, e.element.inlet);
  const gas::Valve* exhaust = find_valve(e, e.element.exhaust);
  if (e.element.cylinder.bore > 0) {
    s.cylinder = cylinder_of(e.element.cylinder, inlet, exhaust);
  } else {
    s.muscle = {.name = e.element.name,
                .count = e.element.count,
                .external_volume = e.element.external_volume,
                .hose = e.element.hose,
                .leak = e.element.leak};
    for (const actuator::Actuator& a : e.actuators)
      if (a.name == e.element.actuator) s.muscle.actuator = a;
    if (inlet) s.muscle.inlet = *inlet;
    if (exhaust) s.muscle.exhaust = *exhaust;
  }
  s.load.mode = e.load.mode;
  if (e.load.mode == plant::Load::Mode::hanging) {
    s.load.mass = schedule(e.load.mass, steps_of(e.load.weights));
    s.load.force = schedule(e.load.force, e.load.forces);
    s.load.gravity = e.load.gravity;
  } else {
    s.load.length = schedule(e.load.length, e.load.lengths);
  }
  s.charge.mode = e.charge.mode;
  if (e.charge.mode == plant::Charge::Mode::regulated)
    s.charge.pressure = schedule(e.charge.pressure, e.charge.pressures);
  s.start = {.pressure = e.start_pressure > 0 ? e.start_pressure : e.air.atmosphere,
             .length = e.start_length,
             .displacement = e.displacement};
  s.transducers = e.sensors;
  s.step = e.step;
  s.accuracy = e.accuracy;
  s.seed = static_cast<std::uint64_t>(e.seed);
  return s;
}

Experiment load(const std::string& path, const std::vector<std::string>& sets) {
  return load(config::compose(path, sets), path);
}

Experiment load(const config::Node& root, const std::string& path) {
  const std::string kind(config::format_kind(root));
  if (kind != "rig")
    config::fail({path, 0, 0}, "format", config::in_quotes(kind), "\"sinew.rig/1\"",
                 "sinew check " + path);
  Experiment e;
  e.path = path;
  e.name = std::filesystem::path(path).stem().string();

  config::Reader reader(root, {.atmosphere = config::atmosphere_of(root),
                               .needs_source = [](const std::string&) { return false; }});
  std::string format, written_by;
  std::vector<experiment::ImportedFile> imported;
  reader.text({.name = "format", .doc = "kind and version"}, format);
  reader.text({.name = "sinew_version", .optional = true, .doc = "that ran"}, written_by);
  experiment::fields(reader, imported);
  machine_fields(reader, e);
  fields(reader, e);
  reader.finish();
  e.origins = reader.origins();
  e.warnings = reader.warnings();
  e.unsourced = reader.unsourced();
  refuse_contradictions(e);
  return e;
}

config::Node values_in_si(Experiment e) {
  config::Writer writer;
  fields(writer, e);
  machine_fields(writer, e);
  return writer.root();
}

std::string resolved(const Experiment& experiment, const std::string& version) {
  Experiment e = experiment;  // visitors take what they print by reference
  config::Writer writer(&e.origins);
  writer.format("rig");
  std::string sinew = version;
  writer.text({.name = "sinew_version", .optional = true, .doc = "that ran"}, sinew);
  fields(writer, e);
  machine_fields(writer, e);
  return writer.text();
}

}  // namespace sinew::rig
