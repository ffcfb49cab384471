#include "cli/verdicts.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/terminal.h"
#include "sinew/config/quantity.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/figure_files.h"

namespace sinew::cli {

namespace {

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
                    const std::vector<analysis::Reported>& reported, double atmosphere,
                    const units::ShownUnits* shown) {
  fmt::print("{}", summary.title);
  if (!summary.reproduces.empty()) fmt::print(" ({})", summary.reproduces);
  if (std::ranges::any_of(reported, &analysis::Reported::changed))
    fmt::print(", changed with --set: what is reported is of the experiment without that");
  fmt::print("\n");

  const std::vector<analysis::Verdict> verdicts = compare(summary, reported, atmosphere, shown);
  if (verdicts.empty()) return false;
  const std::size_t width = width_of_output();
  const report::TextTable table = verdict_table(verdicts, true);
  const bool fits = width == 0 || table.width_before_last() <= width;
  fmt::print("{}", (fits ? table : verdict_table(verdicts, false)).text_within(width));
  return true;
}

}  // namespace

void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine,
                    const units::ShownUnits* shown) {
  if (!print_reported(summary, machine.reported, machine.atmosphere, shown))
    fmt::print("{}", run::main_figures(summary, machine, shown));
}

}  // namespace sinew::cli
