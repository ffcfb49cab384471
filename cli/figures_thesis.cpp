#include "cli/figures_thesis.h"

#include <fmt/format.h>

#include "cli/figures_runs.h"
#include "cli/terminal.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/files.h"
#include "thesis/figures/thesis.h"

namespace sinew::cli {
namespace {

using Is = report::Is;

std::string shown(int n) { return n > 0 ? std::to_string(n) : std::string(); }

// A row per figure with the number of statements of each verdict.
void print_figures(const report::Gallery& gallery) {
  using enum report::TextTable::Align;
  std::vector<std::string> titles{"figure", ""};
  for (const Is v : report::all_verdicts) titles.emplace_back(to_text(v));
  report::TextTable table(titles, {left, left, right, right, right, right, right});
  const auto row = [&](const std::string& name, const std::string& title, const report::Tally& t) {
    std::vector<std::string> cells{name, title};
    for (const Is v : report::all_verdicts) cells.push_back(shown(t.of(v)));
    table.add(std::move(cells));
  };
  for (const report::Exhibit& e : gallery.exhibits) {
    report::Tally t;
    count(t, e.claims);
    row(e.figure.name, e.figure.title, t);
  }
  row("", fmt::format("{} figures", gallery.exhibits.size()), tally(gallery));
  fmt::print("{}", table.text());
}

// A row per class.
void print_classes(const report::Gallery& gallery) {
  using enum report::TextTable::Align;
  const report::Tally all = tally(gallery);
  std::vector<std::string> titles{"class"};
  for (const Is v : report::all_verdicts) titles.emplace_back(to_text(v));
  report::TextTable table(titles, {left, right, right, right, right, right});
  for (const report::StatementClass c : report::all_classes) {
    if (all.of(c) == 0) continue;
    std::vector<std::string> cells{
        std::string(c == report::StatementClass::none ? "not compared" : to_text(c))};
    for (const Is v : report::all_verdicts) cells.push_back(shown(all.of(c, v)));
    table.add(std::move(cells));
  }
  fmt::print("\n{}", table.text());
}

void print(const report::Gallery& gallery) {
  print_figures(gallery);
  print_classes(gallery);
}

report::Gallery made(const std::string& root, bool quiet) {
  const thesis::Sources sources = thesis::sources(root);
  std::atomic<std::int64_t> done{0};
  const ProgressBar bar(done, thesis::steps(), {.each = 1, .unit = "steps"}, quiet);
  return thesis::gallery(sources, done);
}

}  // namespace

ExitCode draw_thesis(const ThesisFiguresRequest& request) {
  const Messages messages(request.quiet);
  const run::FigureFiles files = files_of(request.formats, request.force);
  run::refuse_to_overwrite(std::filesystem::path(request.out) / "index.json", request.force);

  const report::Gallery gallery = made(request.root, request.quiet);
  const std::string index = run::write_figures(request.out, gallery, files, messages.notices());
  if (request.json)
    fmt::print("{}", index);
  else
    print(gallery);
  return ok;
}

}  // namespace sinew::cli
