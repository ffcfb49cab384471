#include "sinew/run/folder/verdict_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/report/text/text_table.h"
#include "sinew/robot/legs.h"

namespace sinew::run {

namespace {

using Keys = std::vector<std::pair<std::string, std::string_view>>;  // keys with their units

// Adds the keys of a joint, under its leg if the robot has several.
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

// Returns all figures of a stand, which are few.
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

// Returns the main figures of a run whose experiment has no reported values, as lines of text; of a
// stand, all figures. Without `shown` in SI, with millimetres and degrees.
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

// Returns the verdict, green if it agrees as expected, else red.
std::string colored(analysis::Verdict::Agreement agreement, bool color) {
  using enum analysis::Verdict::Agreement;
  const std::string_view word = to_text(agreement);
  if (color && agreement == agrees) return fmt::format("\033[32m{}\033[0m", word);
  if (color && (agreement == differs || agreement == agrees_unexpectedly))
    return fmt::format("\033[31m{}\033[0m", word);
  return std::string(word);
}

// The class of a statement has a column of its own, or is before the source if there is no
// room for one.
report::TextTable table_of(const std::vector<analysis::Verdict>& verdicts, bool class_column,
                           bool color) {
  std::vector<std::string> titles = {"", "reported", "Sinew", "accepted", "class", "", "source"};
  if (!class_column) titles = {"", "reported", "Sinew", "accepted", "", "class; source"};
  report::TextTable table(titles);
  for (const analysis::Verdict& v : verdicts) {
    const std::string statement_class(to_text(v.statement_class));
    std::vector<std::string> row = {std::string(analysis::without_unit(v.key)), v.reported,
                                    v.computed.empty() ? "-" : v.computed, v.accept};
    if (class_column) row.push_back(statement_class);
    row.push_back(colored(v.agreement, color));
    row.push_back(class_column || statement_class.empty() ? v.source
                                                          : statement_class + "; " + v.source);
    table.add(std::move(row));
  }
  return table;
}

}  // namespace

std::string verdicts_text(const analysis::Summary& summary, const analysis::Machine& machine,
                          const units::ShownUnits* shown, const VerdictLayout& layout) {
  std::string out = summary.title;
  if (!summary.reproduces.empty()) out += fmt::format(" ({})", summary.reproduces);
  if (std::ranges::any_of(machine.reported, &analysis::Reported::changed))
    out += ", changed: the reported values are of the unchanged experiment";
  out += "\n";

  const std::vector<analysis::Verdict> verdicts =
      compare(summary, machine.reported, machine.atmosphere, shown);
  if (verdicts.empty()) return out + main_figures(summary, machine, shown);
  const report::TextTable table = table_of(verdicts, true, layout.color);
  const bool fits = layout.width == 0 || table.width_before_last() <= layout.width;
  return out + (fits ? table : table_of(verdicts, false, layout.color)).text_within(layout.width);
}

}  // namespace sinew::run
