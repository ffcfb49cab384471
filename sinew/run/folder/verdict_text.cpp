#include "sinew/run/folder/verdict_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/figure_files.h"

namespace sinew::run {

namespace {

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
    out += ", changed: what is reported is of the experiment without that";
  out += "\n";

  const std::vector<analysis::Verdict> verdicts =
      compare(summary, machine.reported, machine.atmosphere, shown);
  if (verdicts.empty()) return out + main_figures(summary, machine, shown);
  const report::TextTable table = table_of(verdicts, true, layout.color);
  const bool fits = layout.width == 0 || table.width_before_last() <= layout.width;
  return out + (fits ? table : table_of(verdicts, false, layout.color)).text_within(layout.width);
}

}  // namespace sinew::run
