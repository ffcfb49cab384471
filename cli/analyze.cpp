// cli/analyze.cpp - `sinew analyze`: a run's numbers from its log alone.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "cli/verdicts.h"
#include "sinew/config/compose.h"
#include "sinew/log/reader.h"
#include "sinew/report/page/content.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::cli {

namespace {

struct AnalyzeOptions {
  std::string run, machine, out, units;
  bool json = false, verdicts = false, force = false, quiet = false;
};

// The source reports whole runs, so a part of a run has no verdict.
ExitCode tell(const AnalyzeOptions& options, const Messages& messages, const signals::Table& table,
              analysis::Machine machine, const config::UnitsToShow& units) {
  if (!table.complete) machine.reported.clear();
  const analysis::Analysis a(table, std::move(machine));
  const analysis::Summary& summary = a.summary;
  for (const std::string& text : summary.warnings) messages.warning(text);
  const std::string json = to_json(summary);
  if (!options.out.empty()) {
    run::refuse_to_overwrite(options.out, options.force,
                             {run::recorded_run(options.run).log, options.machine},
                             run::summary_name);
    run::write_file(options.out, json);
  }
  if (options.verdicts) {
    fmt::print("{}\n", report::to_json(a.verdicts));
  } else if (options.json) {
    fmt::print("{}", json);
  } else {
    print_verdicts(summary, a.machine, units.asked ? &units.units : nullptr);
  }
  return ok;
}

ExitCode analyze_run(const AnalyzeOptions& options) {
  const Messages messages(options.quiet);
  const run::RecordedRun run = run::recorded_run(options.run);
  run::require_finished(run.log);
  const config::Node file = config::compose(run::machine_of(run, options.machine).string());
  const signals::Table table = log::read(run.log);
  if (!table.complete)
    messages.warning(
        run.log.string() +
        " was cut off or is damaged; the numbers are of what stands before, without verdicts");

  const config::UnitsToShow units = chosen_units(options.units, units::UnitSet::si, &file);
  return tell(options, messages, table, analysis::read_machine(file), units);
}

}  // namespace

void add_analyze(CLI::App& app, Action& action) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App& sub =
      subcommand(app, "analyze", "a run's numbers from its log, beside what is reported",
                 "sinew analyze runs/walk-test-1/1 --json");
  sub.add_option("DIR", options->run, "a run's folder, or a log file")->required();
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  sub.add_option("-o,--output", options->out, "also write the summary to this file");
  sub.add_flag("--force", options->force, "replace that file");
  CLI::Option* json = sub.add_flag("--json", options->json, "print the summary as JSON");
  sub.add_flag("--verdicts", options->verdicts, "print what is reported, with verdicts, as JSON")
      ->excludes(json);
  add_units(sub, options->units, "of what is printed, else the source's own; --json is in SI");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return analyze_run(*options); }; });
}

}  // namespace sinew::cli
