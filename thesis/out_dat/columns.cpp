#include "thesis/out_dat/columns.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "sinew/config/diagnostics.h"

namespace sinew::thesis {
namespace {

using Role = robot::Muscle::Role;

constexpr std::array<std::pair<std::string_view, std::string_view>, 2> modes = {
    {{"foot_plant", "plant"}, {"propulsion", "stance"}}};

const robot::Sensor& sensor(const experiment::Experiment& e, int index, const std::string& what) {
  if (index < 0)
    config::fail({e.path, 0, 0}, what, "no sensor", "one: out.dat has a column for it");
  return e.robot.sensors[static_cast<std::size_t>(index)];
}

const robot::Muscle& muscle(const experiment::Experiment& e, int joint, Role role) {
  const int m = robot::muscle_of(e.robot, joint, role);
  if (m < 0)
    config::fail({e.path, 0, 0}, "joint." + e.robot.joints[static_cast<std::size_t>(joint)].name,
                 "a muscle missing", "flexor and extensor: out.dat has columns for both");
  return e.robot.muscles[static_cast<std::size_t>(m)];
}

// Returns the transducer's true scale, which the recorder uses for tensions.
GaugeScale scale(const experiment::Experiment& e, const robot::Sensor& s) {
  return {s.assumed_at_rest, 1.0 / (s.scale * e.robot.converter.counts_per_volt())};
}

OutDatJoint columns_of(const experiment::Experiment& e, int index) {
  const robot::Joint& joint = e.robot.joints[static_cast<std::size_t>(index)];
  const robot::Muscle& flexor = muscle(e, index, Role::flexor);
  const robot::Muscle& extensor = muscle(e, index, Role::extensor);
  const auto tension = [&](const robot::Muscle& m) -> const robot::Sensor& {
    const int at = robot::find_muscle(e.robot, m.name);
    return sensor(e, robot::tension_sensor_of(e.robot, at), "muscle." + m.name);
  };
  const robot::Sensor& angle =
      sensor(e, robot::angle_sensor_of(e.robot, index), "joint." + joint.name);
  return {.name = joint.name,
          .flexor = flexor.name,
          .extensor = extensor.name,
          .angle = angle.name,
          .flexor_tension = tension(flexor).name,
          .extensor_tension = tension(extensor).name,
          .rest = joint.rest_angle,
          .counts_per_rad = angle.assumed_scale,
          .counts_at_rest = angle.assumed_at_rest,
          .flexor_scale = scale(e, tension(flexor)),
          .extensor_scale = scale(e, tension(extensor))};
}

}  // namespace

std::string OutDatColumns::heading() const {
  std::string out = "mode timer pot[0] fi[0] ee[0] fe[0] ei[0]";
  for (std::size_t j = 1; j <= joints.size(); ++j)
    out += fmt::format(
        " thetades[{0}] pot[{0}] gage[{1}] gage[{2}] stiffdes[{0}] stiffness[{0}]"
        " fi[{0}] ee[{0}] fe[{0}] ei[{0}]",
        j, 2 * j - 2, 2 * j - 1);
  return out;
}

OutDatColumns out_dat_columns(const experiment::Experiment& e) {
  OutDatColumns out;
  using Kind = robot::Sensor::Kind;
  for (const robot::Sensor& s : e.robot.sensors)
    if (out.cylinder.empty() && (s.kind == Kind::fixed || s.kind == Kind::cylinder))
      out.cylinder = s.name;
  for (std::size_t j = 0; j < e.robot.joints.size(); ++j)
    if (e.robot.joints[j].kind == robot::Joint::Kind::driven)
      out.joints.push_back(columns_of(e, static_cast<int>(j)));
  for (const std::string& phase : e.plan.sequence)
    if (phase.find_first_of(" \t") != phase.npos)
      config::fail({e.path, 0, 0}, "sequence.phases", config::in_quotes(phase),
                   "names without blanks: they part out.dat's columns");
  return out;
}

std::string mode_of_phase(const std::string& phase) {
  for (const auto& [ours, theirs] : modes)
    if (phase == ours) return std::string(theirs);
  return phase;
}

std::string phase_of_mode(const std::string& mode) {
  for (const auto& [ours, theirs] : modes)
    if (mode == theirs) return std::string(ours);
  return mode;
}

}  // namespace sinew::thesis
