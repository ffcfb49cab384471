// cli/import.cpp - `sinew import`: the thesis's own log, out.dat, as the folder of a run.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/page.h"
#include "cli/report.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "cli/terminal.h"
#include "sinew/config/text_file.h"
#include "sinew/experiment/out_dat.h"

namespace sinew::cli {

namespace {

struct Options {
  std::string file, experiment, folder;
  std::vector<std::string> sets;
  bool force = false, json = false, quiet = false;
};

ExitCode import_log(const Options& options) {
  const Messages messages(options.quiet);
  const experiment::Experiment e = experiment::load(options.experiment, options.sets);
  const signals::Table table = experiment::parse_out_dat(
      config::read_text_file(options.file, "a log out.dat"), options.file, e);

  const std::string resolved = experiment::resolved(e, SINEW_VERSION);
  const analysis::Machine machine =
      analysis::read_machine(config::parse_text(resolved, std::string(resolved_name)));
  const analysis::Summary summary = analysis::summarize(table, machine);
  const std::string json = to_json(summary);

  OutputFolder folder = run_folder(options.folder, options.force, e.name);
  write_into(folder, resolved_name, resolved);
  RunLog log(folder.work() / log_name, e.name, e.seed, resolved, experiment::logged_topics(table));
  log.write(table);
  log.finish(resolved, "");
  write_into(folder, summary_name, json);
  const bool page = write_report(folder, table, resolved, e.name, messages);
  commit_run(folder);
  for (const std::string& text : summary.warnings) messages.warning(text);

  if (options.json) {
    fmt::print("{}", json);
  } else {
    print_verdicts(summary, machine);
  }
  messages.note(folder.path().string());
  if (page) note_report(folder, messages);
  return ok;
}

}  // namespace

void add_import(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub = subcommand(app, "import", "the thesis's log, out.dat, as the folder of a run",
                             "sinew import out.dat --experiment experiments/walk-test-1.toml");
  sub.add_option("FILE", options->file, "out.dat, as B.1 or sinew export writes it")->required();
  sub.add_option("--experiment", options->experiment, "what was run: its robot, phases, scales")
      ->required();
  sub.add_option("-o,--output", options->folder, "folder; else runs/<experiment>/<n>, counting up");
  sub.add_flag("--force", options->force, "replace the run that is in the folder");
  add_sets(sub, options->sets);
  sub.add_flag("--json", options->json, "print summary.json");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return import_log(*options); }; });
}

}  // namespace sinew::cli
