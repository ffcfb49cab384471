// Verdicts of all figures as two tables: for each figure, and for each class of statements.
#include <fmt/format.h>

#include "sinew/report/text/text_table.h"
#include "thesis/figures/thesis.h"

namespace sinew::thesis {

namespace {

using Agreement = report::Agreement;

std::string shown(int n) { return n > 0 ? std::to_string(n) : std::string(); }

// A row per figure with the number of statements of each verdict.
std::string text_of_figures(const report::Gallery& gallery) {
  using enum report::TextTable::Align;
  std::vector<std::string> titles{"figure", ""};
  for (const Agreement v : report::all_verdicts) titles.emplace_back(to_text(v));
  report::TextTable table(titles, {left, left, right, right, right, right, right});
  const auto row = [&](const std::string& name, const std::string& title, const report::Tally& t) {
    std::vector<std::string> cells{name, title};
    for (const Agreement v : report::all_verdicts) cells.push_back(shown(t.of(v)));
    table.add(std::move(cells));
  };
  for (const report::Exhibit& e : gallery.exhibits) {
    report::Tally t;
    count(t, e.claims);
    row(e.figure.name, e.figure.title, t);
  }
  row("", fmt::format("{} figures", gallery.exhibits.size()), tally(gallery));
  return table.text();
}

// A row per class.
std::string text_of_classes(const report::Gallery& gallery) {
  using enum report::TextTable::Align;
  const report::Tally all = tally(gallery);
  std::vector<std::string> titles{"class"};
  for (const Agreement v : report::all_verdicts) titles.emplace_back(to_text(v));
  report::TextTable table(titles, {left, right, right, right, right, right});
  for (const report::StatementClass c : report::all_classes) {
    if (all.of(c) == 0) continue;
    std::vector<std::string> cells{
        std::string(c == report::StatementClass::none ? "not compared" : to_text(c))};
    for (const Agreement v : report::all_verdicts) cells.push_back(shown(all.of(c, v)));
    table.add(std::move(cells));
  }
  return table.text();
}

}  // namespace

std::string text_of(const report::Gallery& gallery) {
  return text_of_figures(gallery) + "\n" + text_of_classes(gallery);
}

}  // namespace sinew::thesis
