#include "sinew/run/folder/main_figures.h"

#include <utility>
#include <vector>

#include "sinew/analysis/verdict/compare.h"
#include "sinew/report/text/text_table.h"
#include "sinew/robot/legs.h"

namespace sinew::run {
namespace {

using Keys = std::vector<std::pair<std::string, std::string_view>>;  // with their units

// Adds those of a joint, under its leg where the robot has several.
void add_joint(const robot::Robot& robot, std::size_t joint, Keys& keys) {
  const int leg = robot::leg_of_joint(robot, static_cast<int>(joint));
  const bool named = !robot.legs.empty() && leg >= 0;
  const std::string of = named ? robot.legs[static_cast<std::size_t>(leg)].name : "";
  const std::string at = (of.empty() ? "joints." : "legs." + of + ".joints.") +
                         robot::name_in_leg(of, robot.joints[joint].name);
  keys.push_back({at + ".excursion_rad", "deg"});
  keys.push_back({at + ".tracking_rms_rad", "deg"});
  keys.push_back({at + ".passiveness", "%"});
}

// Returns all figures of a stand: they are few.
std::string figures_of_stand(const analysis::Summary& summary, double atmosphere,
                             const units::ShownUnits* shown) {
  report::TextTable table({"", "Sinew"});
  for (const analysis::Entry& e : summary.entries()) {
    std::string unit = analysis::unit_of_key(e.key);
    if (unit == "m") unit = "mm";
    if (shown) unit = analysis::shown_unit(e.key, *shown, e.value);
    table.add({std::string(analysis::without_unit(e.key)),
               analysis::show(e.value, e.key, unit, atmosphere)});
  }
  return table.empty() ? "" : table.text();
}

}  // namespace

std::string main_figures(const analysis::Summary& summary, const analysis::Machine& machine,
                         const units::ShownUnits* shown) {
  if (machine.stand) return figures_of_stand(summary, machine.atmosphere, shown);
  Keys keys = {{"sequence_duration_s", "s"},
               {"trolley.distance_m", "mm"},
               {"trolley.mean_speed_m_per_s", "mm/s"}};
  for (std::size_t j = 0; j < machine.robot.joints.size(); ++j) add_joint(machine.robot, j, keys);
  for (const robot::Leg& leg : machine.robot.legs)
    keys.push_back({"legs." + leg.name + ".foot.loaded_share_true", "%"});
  keys.push_back({"air_used_kg", "g"});

  report::TextTable table({"", "Sinew"});
  for (const auto& [key, unit] : keys)
    if (const double* value = summary.find(key))
      table.add(
          {std::string(analysis::without_unit(key)),
           analysis::show(*value, key,
                          shown ? analysis::shown_unit(key, *shown, *value) : std::string(unit),
                          machine.atmosphere)});
  std::string text = table.empty() ? "" : table.text();
  if (text.find("passiveness") != text.npos)
    text +=
        "passiveness: share of the time with both valves of a muscle shut, of the least passive "
        "muscle\n";
  return text;
}

}  // namespace sinew::run
