#include "sinew/identify/pair/pair_file.h"

#include <cmath>
#include <limits>
#include <vector>

#include "sinew/config/write/writer.h"
#include "sinew/identify/fit/provenance.h"
#include "sinew/identify/fit/refusal.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/json/json.h"

namespace sinew::identify {

namespace {

// What a joint of a robot's file has of it.
struct JointLosses {
  std::string name;
  double damping = std::numeric_limits<double>::quiet_NaN(), dry_friction = damping;
};

}  // namespace

Json describe(const PairResult& found) {
  const bool rotary = found.rotary;
  const std::string per = rotary ? "_Nm_per_rad" : "_N_per_m", effort = rotary ? "_Nm" : "_N";
  Json out;
  out["stiffness" + per] = found.stiffness.value;
  out["stiffness_uncertainty" + per] = found.stiffness.uncertainty;
  out["stiffness_of_air" + per] = finite_or_null(found.stiffness.air);
  for (const PairSensorsOf& s : found.sensors)
    out["recordings"].push_back({{"file", s.file},
                                 {"rig", s.rig},
                                 {"bias" + effort, s.sensors.bias},
                                 {"gain", s.sensors.gain},
                                 {"delay_s", s.sensors.delay}});
  if (!found.air) return out;
  Json air{
      {"change_per_position_Pa_per_" + std::string(rotary ? "rad" : "m"), found.air->per_position}};
  for (std::size_t m = 0; m < found.air->slope.size(); ++m)
    air["muscles"].push_back(
        {{"pressure_Pa_abs", found.air->pressure[m]},
         {rotary ? "relative_change_1_per_rad" : "relative_change_1_per_m", found.air->slope[m]},
         {"falls", static_cast<bool>(found.air->falls[m])}});
  air["report"] = to_json(found.air->report);
  out["air"] = air;
  return out;
}

std::string pair_file(const PairResult& found, const std::string& joint, const std::string& source,
                      config::Node robot) {
  if (!found.rotary)
    throw Refusal("out", "a slide",
                  "torque and angle of a joint: in a robot's file muscles move joints, and these "
                  "alone have dry_friction and damping. Of a slide N/m and N s/m have no place "
                  "there, as long as no lever turns them into N m",
                  "no file: the report and its JSON have all of it");
  Provenance provenance;
  std::vector<JointLosses> joints{{.name = joint}};
  const std::string path = "joint." + joint + ".";
  for (const Estimate& e : found.report.best().parameters) {
    if (e.name == "viscous") joints[0].damping = e.value;
    if (e.name == "friction") joints[0].dry_friction = e.value;
    if (e.name == "viscous") provenance.fitted(path + "damping", e, source);
    if (e.name == "friction")
      provenance.fitted(path + "dry_friction", e, source + ", with that of the muscles");
  }
  config::Writer writer(&provenance.origins());
  writer.each({.name = "joint"}, joints, [](auto& v, JointLosses& j) {
    v.number({.name = "dry_friction", .unit = "N m"}, j.dry_friction);
    v.number({.name = "damping", .unit = "N m s/rad"}, j.damping);
  });
  for (const config::Node& child : writer.root().children) robot.put(child);
  return config::to_toml(robot);
}

}  // namespace sinew::identify
