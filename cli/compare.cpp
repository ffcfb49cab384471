// cli/compare.cpp - `sinew compare`: runs beside each other, as tables and as one page.
#include <fmt/format.h>

#include "cli/alignment.h"
#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/report/compare/comparison_text.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/compared.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::vector<std::string> runs, channels;
  Alignment alignment;
  std::string out, residuals, units;
  bool json = false, all = false, force = false, quiet = false;
};

report::ComparisonText shown_as(const CompareOptions& options) {
  const fs::path first = run::recorded_run(options.runs.front()).resolved;
  return {.units = chosen_units(options.units, units::UnitSet::thesis, first).units,
          .all = options.all,
          .width = width_of_output(),
          .see_all = "--all",
          .fit_clock = "--clock fit",
          .color = output_has_color()};
}

// Nothing that was there is written over unasked, nor a run that is read.
void refuse_outputs(const CompareOptions& options) {
  if (!options.out.empty()) report::require_page(options.out);
  std::vector<fs::path> inputs;
  for (const std::string& named : options.runs) {
    const run::RecordedRun run = run::recorded_run(named);
    inputs.insert(inputs.end(), {run.log, run.resolved});
  }
  for (const std::string& out : {options.out, options.residuals})
    if (!out.empty()) run::refuse_to_overwrite(out, options.force, inputs);
}

ExitCode compare_runs(const CompareOptions& options) {
  const Messages messages(options.quiet);
  refuse_outputs(options);
  const report::Comparison comparison = run::compare_runs(options.runs, options.alignment.wish(),
                                                          options.channels, messages.notices());

  // Files come before what is printed: a reader that ends early, such as head, ends the
  // program.
  if (!options.residuals.empty()) {
    run::write_file(options.residuals, report::residuals_csv(comparison));
    messages.note(options.residuals);
  }
  if (!options.out.empty()) {
    const fs::path first = run::recorded_run(options.runs.front()).resolved;
    const std::string page =
        report::page(comparison, chosen_units(options.units, units::UnitSet::si, first).units);
    run::write_file(options.out, page);
    messages.note(
        fmt::format("{}, {:.1f} MB", options.out, 1e-6 * static_cast<double>(page.size())));
  }
  if (options.json)
    fmt::print("{}", to_json(comparison));
  else
    fmt::print("{}", text_of(comparison, shown_as(options)));
  return ok;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App& sub =
      subcommand(app, "compare", "runs beside each other: numbers, parameters, channels",
                 "sinew compare runs/walk-test-1/1 runs/walk-test-2/1 -o compare.html");
  sub.add_option("RUN", options->runs, "folders of runs, or log files; the first is compared with")
      ->required()
      ->expected(2, most_runs);
  sub.add_option("-o,--output", options->out, "also write a page with overlaid plots");
  sub.add_option("--residuals", options->residuals,
                 "also write what each run differs by, a column per channel, as CSV");
  add_alignment(sub, options->alignment);
  sub.add_option("--channels", options->channels, "only these: '/joint/*/angle'")
      ->expected(1, CLI::detail::expected_max_vector_size);
  add_units(sub, options->units, "of the tables, else thesis, and of the page; --json is in SI");
  sub.add_flag("--all", options->all, "every figure and channel, equal ones too");
  sub.add_flag("--json", options->json, "all of it as JSON");
  sub.add_flag("--force", options->force, "replace the page");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return compare_runs(*options); }; });
}

}  // namespace sinew::cli
