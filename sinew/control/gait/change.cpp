#include "sinew/control/gait/change.h"

#include "sinew/control/gait/gait_controller.h"
#include "sinew/control/gait/plan.h"

namespace sinew::gait {
namespace {

using What = Setting::What;

struct Kind {
  What what;
  std::string_view head, tail, unit;
};
constexpr Kind kinds[] = {
    {What::angle, "control.angle.", "", "rad"},
    {What::stiffness, "control.stiffness.", "", "N m/rad"},
    {What::angle_gain, "control.gains.", ".angle", "1/count"},
    {What::stiffness_gain, "control.gains.", ".stiffness", "1/(N m/rad)"},
    {What::velocity_gain, "control.gains.", ".velocity", "s/count"},
};

bool is_of(const Kind& kind, std::string_view key) {
  return key.size() > kind.head.size() + kind.tail.size() && key.starts_with(kind.head) &&
         key.ends_with(kind.tail);
}

template <class Joint>
auto& value_in(Joint& joint, What what) noexcept {
  switch (what) {
    case What::angle_gain:
      return joint.gains.angle;
    case What::stiffness_gain:
      return joint.gains.stiffness;
    case What::velocity_gain:
      return joint.gains.velocity;
    case What::angle:
      return joint.angle;
    case What::stiffness:
      break;
  }
  return joint.stiffness;
}

}  // namespace

std::vector<Setting> settings(const Plan& plan) {
  std::vector<Setting> out;
  for (std::size_t j = 0; j < plan.joints.size(); ++j) {
    if (!plan.joints[j].driven) continue;
    for (const Kind& kind : kinds)
      out.push_back({std::string(kind.head) + plan.joints[j].name + std::string(kind.tail),
                     kind.unit, j, kind.what});
  }
  return out;
}

std::string_view unit_of_setting(std::string_view key) {
  for (const Kind& kind : kinds)
    if (is_of(kind, key)) return kind.unit;
  return "";
}

int find_setting(const std::vector<Setting>& settings, std::string_view key) {
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (settings[i].key == key) return static_cast<int>(i);
  return -1;
}

double& value_of(const Setting& setting, Desired& desired) noexcept {
  return value_in(desired.joint[setting.joint], setting.what);
}

double value_of(const Setting& setting, const Desired& desired) noexcept {
  return value_in(desired.joint[setting.joint], setting.what);
}

Overrides::Overrides(const Plan& plan) : settings_(gait::settings(plan)) {}

void Overrides::apply(Desired& desired) const noexcept {
  for (std::size_t i = 0; i < settings_.size(); ++i)
    if (overrides_[i].given) value_of(settings_[i], desired) = overrides_[i].value;
}

}  // namespace sinew::gait
