// cli/compare.cpp - `sinew compare`: runs beside each other, as tables and as one page.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/report/compare/comparison_text.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/compared.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

constexpr int most_runs = 8;  // colors that can be told apart

struct Options {
  std::vector<std::string> runs, channels;
  std::string out, align = "start", units = "thesis";
  bool json = false, all = false, force = false, quiet = false;
};

report::ComparisonText shown_as(const Options& options) {
  using Units = report::ComparisonText::Units;
  return {.units = options.units == "si" ? Units::si : Units::thesis,
          .all = options.all,
          .width = width_of_output(),
          .see_all = "--all",
          .color = output_has_color()};
}

ExitCode compare_runs(const Options& options) {
  const Messages messages(options.quiet);
  if (!options.out.empty()) {
    report::require_page(options.out);
    std::vector<fs::path> inputs;
    for (const std::string& named : options.runs) {
      const run::RecordedRun run = run::recorded_run(named);
      inputs.insert(inputs.end(), {run.log, run.resolved});
    }
    run::refuse_to_overwrite(options.out, options.force, inputs);
  }
  const report::Comparison comparison = run::compare_runs(
      options.runs, options.align == "start" ? report::Align::start : report::Align::sequence,
      options.channels, messages.notices());

  if (options.json)
    fmt::print("{}", to_json(comparison));
  else
    fmt::print("{}", text_of(comparison, shown_as(options)));
  if (options.out.empty()) return ok;
  const std::string page = report::page(comparison);
  run::write_file(options.out, page);
  messages.note(fmt::format("{}, {:.1f} MB", options.out, 1e-6 * static_cast<double>(page.size())));
  return ok;
}

}  // namespace

void add_compare(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub =
      app.subcommand("compare", "runs beside each other: figures, parameters, channels",
                     "sinew compare runs/walk-test-1/1 runs/walk-test-2/1 -o compare.html");
  sub.add_option("RUN", options->runs, "folders of runs, or log files; the first is compared with")
      .required()
      .takes(2, most_runs, "2 to 8, REQUIRED");
  sub.add_option("-o,--output", options->out, "also write a page with overlaid plots");
  sub.add_option("--align", options->align,
                 "where times are counted from: start, or sequence: its first phase")
      .is_one_of({"start", "sequence"});
  sub.add_option("--channels", options->channels, "only these: '/joint/*/angle'").takes_all();
  sub.add_option("--units", options->units, "of the tables: thesis or si; --json is in SI")
      .is_one_of({"thesis", "si"});
  sub.add_flag("--all", options->all, "every figure and channel, equal ones too");
  sub.add_flag("--json", options->json, "all of it as JSON");
  sub.add_flag("--force", options->force, "replace the page");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return compare_runs(*options); }; });
}

}  // namespace sinew::cli
