// cli/import.cpp - `sinew import`: the thesis's own log, out.dat, as the folder of a run.
#include <fmt/format.h>

#include "cli/run.h"
#include "sinew/config/text_file.h"
#include "thesis/out_dat/out_dat.h"

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
  const signals::Table table =
      thesis::parse_out_dat(config::read_text_file(options.file, "a log out.dat"), options.file, e);

  const run::Kept<analysis::Machine> kept = run::keep_table(
      table, e, {.folder = options.folder, .force = options.force}, messages.notices());
  for (const std::string& text : kept.summary.warnings) messages.warning(text);
  if (options.json)
    fmt::print("{}", kept.json);
  else
    print_verdicts(kept.summary, kept.machine);
  messages.note(kept.folder.string());
  if (kept.page) note_page(kept.folder, messages);
  return ok;
}

}  // namespace

void add_import(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = app.subcommand("import", "the thesis's log, out.dat, as the folder of a run",
                               "sinew import out.dat --experiment experiments/walk-test-1.toml");
  sub.add_option("FILE", options->file, "out.dat, as B.1 or sinew export writes it").required();
  sub.add_option("--experiment", options->experiment, "what was run: its robot, phases, scales")
      .required();
  sub.add_option("-o,--output", options->folder, "folder; else runs/<experiment>/<n>, counting up");
  sub.add_flag("--force", options->force, "replace the run that is in the folder");
  add_sets(sub, options->sets);
  sub.add_flag("--json", options->json, "print summary.json");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return import_log(*options); }; });
}

}  // namespace sinew::cli
