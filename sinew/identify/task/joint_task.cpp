#include "sinew/identify/task/joint_task.h"

#include <optional>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/identify/fit/robot_over.h"
#include "sinew/identify/task/tables.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

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

// All tables as one, whose rows know theirs by a column `recording`; one table stays as it is.
Measured joined(const std::vector<Source>& sources, bool moving) {
  Measured out = read_measured(sources[0], joint_columns(moving));
  if (sources.size() == 1) return out;
  std::vector<double> recording(out.rows(), 0.0);
  for (std::size_t k = 1; k < sources.size(); ++k) {
    const Measured more = read_measured(sources[k], joint_columns(moving));
    for (Column& c : out.columns) {
      if (!more.has(c.name))
        throw Refusal(more.file, "no column " + c.name, "the columns of " + sources[0].path, "");
      c.values.insert(c.values.end(), more[c.name].begin(), more[c.name].end());
    }
    out.lines.insert(out.lines.end(), more.lines.begin(), more.lines.end());
    out.notes.insert(out.notes.end(), more.notes.begin(), more.notes.end());
    out.file += ", " + more.file;
    recording.resize(out.rows(), static_cast<double>(k));
  }
  out.columns.push_back({.name = "recording", .unit = "1", .values = recording});
  return out;
}

}  // namespace

JointFound find_joint(const std::vector<Source>& sources, const JointSettings& settings) {
  if (sources.empty()) (void)only_of(sources);
  (void)SettingValues(settings, sources[0].atmosphere);
  if (settings.keep_force && settings.model.ends_with("pressure"))
    config::fail({"model", 0, 0}, "", settings.model + " with keep_force=true",
                 "round or hinge beside it");
  const JointNames names = names_of(settings);
  const experiment::MachineFile start = experiment::load_machine_file(settings.actuator);
  const actuator::Actuator& a =
      config::named(start.experiment.actuators, settings.name, "name", "actuator");
  JointSetup setup = setup_of(settings, a, sources[0].atmosphere);
  for (const Source& source : sources)
    if (sources.size() > 1) setup.recordings.push_back(source.path);
  const Measured data = joined(sources, settings.moving);
  std::optional<Measured> held_out;
  for (const Source& other : held_out_tables(settings.hold_out, sources))
    held_out = read_measured(other, joint_columns(settings.moving));
  JointFound out{.result = identify_joint(data, held_out, setup, settings.model,
                                          Wishes(settings.wishes), settings.tried),
                 .setup = setup,
                 .names = names,
                 .base = settings.base};
  out.source = "sinew identify joint";
  for (const Source& source : sources) out.source += " " + source.path;
  out.source += ": " + out.result.report.best().model;
  out.actuator_file = effectiveness_file(start.experiment.origins, settings.actuator, a, out.result,
                                         settings.keep_force, out.source);
  return out;
}

std::string JointFound::file(const std::string& out) const {
  return joint_file(result, setup, names, source, robot_over(base, out));
}

Json to_json(const JointFound& found) {
  Json out = to_json(found.result.report);
  out.update(describe(found.result));
  return out;
}

}  // namespace sinew::identify
