#include "sinew/identify/task/methods.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "sinew/config/diagnostics.h"
#include "sinew/config/write/writer.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/provenance.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/identify/data/averaged.h"
#include "sinew/identify/data/quality.h"
#include "sinew/identify/task/settings.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/robot/robot.h"

namespace sinew::identify {

namespace {

using robot::Joint;
using robot::Muscle;

// Returns the tables of the joint and its muscles in a robot's file. `source` describes their
// origin.
config::Node tables_of(const JointResult& found, const JointSetup& setup, const JointNames& names,
                       const std::string& source) {
  Provenance provenance;
  const Fit& best = found.report.best();
  const std::string given = "given to " + source;
  std::vector<Joint> joints(1);
  joints[0].name = names.joint;
  joints[0].rest_angle = setup.rest_angle;
  joints[0].moment_arm = found.moment_arm;
  const std::string path = "joint." + names.joint + ".";
  provenance.given(path + "rest_angle", given);
  provenance.fitted(path + "moment_arm", best.estimate("moment_arm"), source, given);
  double friction = std::nan(""), damping = friction;  // for a joint at rest: unknown
  if (const Estimate* e = best.estimate("friction")) {
    friction = e->value;
    provenance.fitted(path + "dry_friction", *e, source);
  }
  if (const Estimate* e = best.estimate("damping")) {
    damping = e->value;
    provenance.fitted(path + "damping", *e, source);
  }

  std::vector<Muscle> muscles;
  const auto add = [&](const std::string& name, const char* what, double length,
                       const std::vector<double>& radii) {
    if (!std::isfinite(length)) return;
    Muscle m{.name = name, .mount_length = length};
    m.cam.angle = found.cam_angle;
    m.cam.radii = radii;
    muscles.push_back(std::move(m));
    provenance.fitted("muscle." + name + ".mount_length", best.estimate(what), source, given);
    for (const char* key : {"angle", "radius"})
      provenance.given("muscle." + name + ".cam." + key, source + ", between two points");
  };
  add(names.flexor, "flexor_length", found.flexor_length, found.cam_flexor);
  add(names.extensor, "extensor_length", found.extensor_length, found.cam_extensor);

  config::Writer writer(&provenance.origins());
  writer.each({.name = "joint"}, joints, [&](auto& v, Joint& j) {
    v.number({.name = "rest_angle", .unit = "rad"}, j.rest_angle);
    std::string flexion = names.flexion;
    v.text({.name = "flexion"}, flexion);
    v.number({.name = "moment_arm", .unit = "m"}, j.moment_arm);
    v.number({.name = "dry_friction", .unit = "N m"}, friction);
    v.number({.name = "damping", .unit = "N m s/rad"}, damping);
  });
  writer.each({.name = "muscle"}, muscles, [](auto& v, Muscle& m) {
    v.number({.name = "mount_length", .unit = "m"}, m.mount_length);
    if (m.cam.angle.empty()) return;
    v.group({.name = "cam"}, [&](auto& g) {
      g.numbers({.name = "angle", .unit = "rad"}, m.cam.angle);
      g.numbers({.name = "radius", .unit = "m"}, m.cam.radii);
    });
  });
  return writer.root();
}

// Returns the text of the actuator's file with the identified effectiveness, unless `keep_force`.
// `start` are the origins of the actuator's values in `start_file`.
std::string effectiveness_file(const config::Origins& start, const std::string& start_file,
                               actuator::Actuator a, const JointResult& found, bool keep_force,
                               const std::string& source) {
  Provenance provenance(start, start_file);
  const std::string path = "actuator." + a.name + ".effectiveness.";
  if (!keep_force) {
    std::string text = source;
    for (const char* name : {"c0", "c1"})
      if (const Estimate* e = found.report.best().estimate(name))
        text += fmt::format(", {} +- {:.2g}{}", name, 0.5 * (e->high - e->low),
                            e->unit == "1" ? "" : " " + e->unit);
    provenance.fitted(path + "polynomial", "1", std::nan(""), text);
    provenance.given(path + "argument", source);
    provenance.given(path + "scale", source + ": in the polynomial");
    provenance.given(path + "valid", source + ": the highest pressure");
    a.effectiveness = found.effectiveness;
  }
  return actuator_file(a, provenance);
}

// --- settings and tables ---

JointSetup setup_of(const JointSettings& settings, const actuator::Actuator& a, double atmosphere) {
  const SettingValues values(settings, atmosphere);
  const auto value = [&](const std::string& member) {
    return values.given(member).value_or(to_be_found);
  };
  JointSetup s{.actuator = a, .count = settings.count, .atmosphere = atmosphere};
  s.gravity = units::standard_gravity;
  s.flexion_raises = settings.names.flexion == "raises angle";
  s.rest_angle = value(settings.rest_angle);
  s.load = value(settings.load);
  s.lever = value(settings.lever);
  s.down = value(settings.down);
  s.limb = value(settings.limb);
  s.limb_lever = value(settings.limb_lever);
  s.moment_arm = value(settings.moment_arm);
  s.flexor_length = value(settings.flexor_length);
  s.extensor_length = value(settings.extensor_length);
  s.keep_force = settings.keep_force;
  s.torque_bias = settings.torque_bias;
  s.torque_gain = settings.torque_gain;
  s.moving = settings.moving;
  return s;
}

JointNames names_of(const JointSettings& settings) {
  JointNames names = settings.names;
  if (names.flexor.empty()) names.flexor = names.joint + "_flexor";
  if (names.extensor.empty()) names.extensor = names.joint + "_extensor";
  return names;
}

// Averages a long table: poses by their settings, a motion over time.
Measured poses_averaged(Measured all) {
  const std::string_view response = all.has("torque") ? "torque" : "load";
  return times_averaged(settings_averaged(std::move(all), response), 8000, "angle");
}

// Joins all tables; a column `recording` is the index of each row's table. A single table is
// unchanged.
Measured joined(const std::vector<Source>& sources, bool moving) {
  Measured out = poses_averaged(each_row_once(read_measured(sources[0], joint_columns(moving))));
  if (sources.size() == 1) return out;
  std::vector<double> recording(out.rows(), 0.0);
  for (std::size_t k = 1; k < sources.size(); ++k) {
    const Measured more =
        poses_averaged(each_row_once(read_measured(sources[k], joint_columns(moving))));
    for (Column& c : out.columns) {
      if (!more.has(c.name))
        throw Refusal(more.file, "no column " + c.name, "the columns of " + sources[0].path, "");
      c.values.insert(c.values.end(), more[c.name].begin(), more[c.name].end());
    }
    if (!out.weights.empty() || !more.weights.empty()) {
      out.weights.resize(out.lines.size(), 1);
      out.weights.insert(out.weights.end(), more.weights.begin(), more.weights.end());
      out.variances.resize(out.lines.size());
      out.variances.insert(out.variances.end(), more.variances.begin(), more.variances.end());
    }
    out.lines.insert(out.lines.end(), more.lines.begin(), more.lines.end());
    out.notes.insert(out.notes.end(), more.notes.begin(), more.notes.end());
    out.file += ", " + more.file;
    recording.resize(out.rows(), static_cast<double>(k));
  }
  if (!out.weights.empty()) {
    out.weights.resize(out.lines.size(), 1);
    out.variances.resize(out.lines.size());
  }
  out.columns.push_back({.name = "recording", .unit = "1", .values = recording});
  return out;
}

void put_combinations(const JointFound& found, const TextOptions&, std::string& out) {
  report::TextTable table({"what the data determine, best first", "95 %"},
                          {report::TextTable::Align::left, report::TextTable::Align::right});
  for (const Combination& c : found.result.combinations)
    table.add({c.text, std::isfinite(c.relative_error)
                           ? fmt::format("+- {:.2g} %", 100 * c.relative_error)
                           : "undetermined"});
  put(out, "\n{}", table.text());
}

void add_json(const JointResult& result, Json& out) {
  out["moment_arm_m"] = result.moment_arm;
  if (std::isfinite(result.flexor_length)) out["flexor_length_m"] = result.flexor_length;
  if (std::isfinite(result.extensor_length)) out["extensor_length_m"] = result.extensor_length;
  out["combinations"] = Json::array();
  for (const Combination& c : result.combinations)
    out["combinations"].push_back(
        {{"combination", c.text}, {"relative_error", finite_or_null(c.relative_error)}});
}

}  // namespace

JointFound find(const SourceList& sources, const JointSettings& settings) {
  if (sources.empty()) (void)only_of(sources);
  (void)SettingValues(settings, sources[0].atmosphere);
  if (settings.keep_force && settings.model.ends_with("pressure"))
    config::fail({"model", 0, 0}, "", settings.model + " with keep_force=true",
                 "round or hinge with it");
  const JointNames names = names_of(settings);
  const experiment::MachineFile start = experiment::load_machine_file(settings.actuator);
  const actuator::Actuator& a = config::named(start.experiment.actuators, settings.name, "name",
                                              "actuator", settings.actuator);
  JointSetup setup = setup_of(settings, a, sources[0].atmosphere);
  for (const Source& source : sources)
    if (sources.size() > 1) setup.recordings.push_back(source.path);
  const Measured data = joined(sources, settings.moving);
  std::optional<Measured> held_out;
  for (const Source& other : held_out_tables(settings.hold_out, sources))
    held_out = poses_averaged(read_measured(other, joint_columns(settings.moving)));
  JointFound out(identify_joint(data, held_out, setup, settings.model,
                                Constraints(settings.constraints), settings.tried));
  const std::string source = source_words("joint", sources, out.result.report.best().model);
  out.files = {part_of_robot(tables_of(out.result, setup, names, source), settings.base),
               file_with(effectiveness_file(start.experiment.origins, settings.actuator, a,
                                            out.result, settings.keep_force, source))};
  add_json(out.result, out.json);
  prints(out, put_combinations);
  return out;
}

}  // namespace sinew::identify
