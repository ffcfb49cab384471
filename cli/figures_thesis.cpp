#include "cli/figures_thesis.h"

#include <fmt/format.h>

#include "cli/figure_files.h"
#include "cli/run_folder.h"
#include "cli/text_table.h"
#include "cli/thesis/thesis.h"

namespace sinew::cli {
namespace {

// A row per figure with the number of statements that agree, differ, …
void print(const report::Gallery& gallery) {
  using enum TextTable::Align;
  TextTable table({"figure", "", "agrees", "as put in", "differs", "as known", "not comparable"},
                  {left, left, right, right, right, right, right});
  const auto shown = [](int n) { return n > 0 ? std::to_string(n) : std::string(); };
  const auto row = [&](const std::string& name, const std::string& title, const report::Tally& t) {
    table.add({name, title, shown(t.agree), shown(t.as_put_in), shown(t.differ),
               shown(t.differ_as_known), shown(t.not_comparable)});
  };
  for (const report::Exhibit& e : gallery.exhibits) {
    report::Tally t;
    count(t, e.claims);
    row(e.figure.name, e.figure.title, t);
  }
  row("", fmt::format("{} figures", gallery.exhibits.size()), tally(gallery));
  fmt::print("{}", table.text());
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
  FigureFiles files{.must_draw = !request.formats.empty(), .force = request.force};
  if (files.must_draw) files.pictures = parse_formats(request.formats);
  refuse_to_overwrite(std::filesystem::path(request.out) / "index.json", request.force);

  const report::Gallery gallery = made(request.root, request.quiet);
  const std::string index = write_figures(request.out, gallery, files, messages);
  if (request.json)
    fmt::print("{}", index);
  else
    print(gallery);
  return ok;
}

}  // namespace sinew::cli
