#include "sinew/identify/joint/joint_file.h"

#include <fmt/format.h>

#include <cmath>

#include "sinew/config/write/writer.h"
#include "sinew/identify/fit/provenance.h"
#include "sinew/identify/fit/report_json.h"
#include "sinew/json/json.h"
#include "sinew/robot/robot.h"

namespace sinew::identify {

namespace {

using robot::Joint;
using robot::Muscle;

const Estimate* parameter(const JointResult& found, std::string_view name) {
  for (const Estimate& e : found.report.best().parameters)
    if (e.name == name) return &e;
  return nullptr;
}

void note_origin(const JointResult& found, std::string_view parameter_name, const std::string& path,
                 const std::string& source, Provenance& provenance) {
  if (const Estimate* e = parameter(found, parameter_name))
    provenance.fitted(path, *e, source);
  else
    provenance.given(path, "given to " + source);
}

}  // namespace

std::string joint_file(const JointResult& found, const JointSetup& setup, const JointNames& names,
                       const std::string& source, config::Node robot) {
  Provenance provenance;
  std::vector<Joint> joints(1);
  joints[0].name = names.joint;
  joints[0].rest_angle = setup.rest_angle;
  joints[0].moment_arm = found.moment_arm;
  const std::string path = "joint." + names.joint + ".";
  provenance.given(path + "rest_angle", "given to " + source);
  note_origin(found, "moment_arm", path + "moment_arm", source, provenance);

  double friction = std::nan(""), damping = friction;  // of a joint that was at rest: not told
  if (const Estimate* e = parameter(found, "friction")) {
    friction = e->value;
    provenance.fitted(path + "dry_friction", *e, source);
  }
  if (const Estimate* e = parameter(found, "damping")) {
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
    note_origin(found, what, "muscle." + name + ".mount_length", source, provenance);
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
  for (const config::Node& child : writer.root().children) robot.put(child);
  return config::to_toml(robot);
}

std::string effectiveness_file(const config::Origins& start, const std::string& start_file,
                               actuator::Actuator a, const JointResult& found, bool keep_force,
                               const std::string& source) {
  Provenance provenance(start, start_file);
  const std::string path = "actuator." + a.name + ".effectiveness.";
  if (!keep_force) {
    std::string text = source;
    for (const char* name : {"c0", "c1"})
      if (const Estimate* e = parameter(found, name))
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

Json describe(const JointResult& found) {
  Json out{{"moment_arm_m", found.moment_arm}};
  if (std::isfinite(found.flexor_length)) out["flexor_length_m"] = found.flexor_length;
  if (std::isfinite(found.extensor_length)) out["extensor_length_m"] = found.extensor_length;
  out["combinations"] = Json::array();
  for (const Combination& c : found.combinations)
    out["combinations"].push_back(
        {{"combination", c.text}, {"relative_error", finite_or_null(c.relative_error)}});
  return out;
}

}  // namespace sinew::identify
