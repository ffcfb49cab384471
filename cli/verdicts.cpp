#include "cli/verdicts.h"

#include <fmt/format.h>

#include "cli/terminal.h"
#include "sinew/config/quantity.h"
#include "sinew/report/text/text_table.h"
#include "sinew/robot/legs.h"

namespace sinew::cli {

namespace {

// Prints the main figures of a run of which nothing is reported, so that no paper gives the units.
void print_main_figures(const analysis::Summary& summary, const analysis::Machine& machine) {
  std::vector<std::pair<std::string, std::string_view>> keys = {
      {"sequence_duration_s", "s"},
      {"trolley.distance_m", "mm"},
      {"trolley.mean_speed_m_per_s", "mm/s"},
  };
  for (std::size_t j = 0; j < machine.robot.joints.size(); ++j) {
    const int leg = robot::leg_of_joint(machine.robot, static_cast<int>(j));
    const bool named = !machine.robot.legs.empty() && leg >= 0;
    const std::string of = named ? machine.robot.legs[static_cast<std::size_t>(leg)].name : "";
    const std::string at = (of.empty() ? "joints." : "legs." + of + ".joints.") +
                           robot::name_in_leg(of, machine.robot.joints[j].name);
    keys.push_back({at + ".excursion_rad", "deg"});
    keys.push_back({at + ".tracking_rms_rad", "deg"});
    keys.push_back({at + ".passiveness", "%"});
  }
  for (const robot::Leg& leg : machine.robot.legs)
    keys.push_back({"legs." + leg.name + ".foot.loaded_share_true", "%"});
  keys.push_back({"air_used_kg", "g"});

  report::TextTable table({"", "Sinew"});
  for (const auto& [key, unit] : keys)
    if (const double* value = summary.find(key))
      table.add({std::string(analysis::without_unit(key)),
                 analysis::show(*value, key, unit, machine.atmosphere)});
  if (!table.empty()) fmt::print("{}", table.text());
}

// Verdicts, colored on a terminal.
std::string shown(analysis::Verdict::Is is) {
  using enum analysis::Verdict::Is;
  const std::string_view word = to_text(is);
  if (is == agrees) return in_green(word);
  return is == differs || is == agrees_after_all ? in_red(word) : std::string(word);
}

// The class of a statement has a column of its own, or stands before the source where the window
// has no room for one.
report::TextTable verdict_table(const std::vector<analysis::Verdict>& verdicts, bool class_column) {
  std::vector<std::string> titles = {"", "reported", "Sinew", "accepted", "class", "", "source"};
  if (!class_column) titles = {"", "reported", "Sinew", "accepted", "", "class; source"};
  report::TextTable table(titles);
  for (const analysis::Verdict& v : verdicts) {
    const std::string statement_class(to_text(v.statement_class));
    std::vector<std::string> row = {std::string(analysis::without_unit(v.key)), v.reported,
                                    v.ours.empty() ? "-" : v.ours, v.accept};
    if (class_column) row.push_back(statement_class);
    row.push_back(shown(v.is));
    row.push_back(class_column || statement_class.empty() ? v.source
                                                          : statement_class + "; " + v.source);
    table.add(std::move(row));
  }
  return table;
}

bool print_reported(const analysis::Summary& summary,
                    const std::vector<analysis::Reported>& reported, double atmosphere) {
  fmt::print("{}", summary.title);
  if (!summary.reproduces.empty()) fmt::print(" ({})", summary.reproduces);
  fmt::print("\n");

  const std::vector<analysis::Verdict> verdicts = compare(summary, reported, atmosphere);
  if (verdicts.empty()) return false;
  const std::size_t width = width_of_output();
  const report::TextTable table = verdict_table(verdicts, true);
  const bool fits = width == 0 || table.width_before_last() <= width;
  fmt::print("{}", (fits ? table : verdict_table(verdicts, false)).text_within(width));
  return true;
}

}  // namespace

void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine) {
  if (!print_reported(summary, machine.reported, machine.atmosphere))
    print_main_figures(summary, machine);
}

void print_verdicts(const analysis::Summary& summary, const analysis::StandFile& stand) {
  if (print_reported(summary, stand.reported, stand.atmosphere)) return;
  report::TextTable table({"", "Sinew"});
  for (const analysis::Entry& e : summary.entries()) {
    const std::string unit = analysis::unit_of_key(e.key);
    table.add({std::string(analysis::without_unit(e.key)),
               analysis::show(e.value, e.key, unit == "m" ? "mm" : unit, stand.atmosphere)});
  }
  if (!table.empty()) fmt::print("{}", table.text());
}

}  // namespace sinew::cli
