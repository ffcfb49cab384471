// cli/page.cpp - `sinew report`: a recorded run as one page that opens anywhere.
#include "cli/page.h"

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "sinew/config/compose.h"
#include "sinew/log/reader.h"
#include "sinew/report/page.h"

namespace sinew::cli {

namespace {

struct Options {
  std::string run, machine, out;
  bool force = false, quiet = false;
};

ExitCode report_run(const Options& options) {
  const Messages messages(options.quiet);
  const RecordedRun run = recorded_run(options.run);
  const std::filesystem::path out = options.out.empty() ? run.log.parent_path() / report_name
                                                        : std::filesystem::path(options.out);
  refuse_to_overwrite(out, options.force, {run.log, run.resolved, options.machine});
  bool cut = false;
  const std::string page = page_of(run, options.machine, &cut);
  if (const std::string ended = ended_in(run.log); !ended.empty())
    messages.warning(fmt::format("{}: the run was ended: {}; the page shows it until then",
                                 run.log.string(), ended));
  if (cut)
    messages.warning(run.log.string() +
                     " was cut off or is damaged; the page shows what stands "
                     "before");
  write_file(out, page);
  messages.note(
      fmt::format("{}, {:.1f} MB", out.string(), 1e-6 * static_cast<double>(page.size())));
  return ok;
}

}  // namespace

std::string page_of(const RecordedRun& run, const std::string& machine, bool* cut) {
  const config::Node resolved = config::compose(machine_of(run, machine).string());
  const signals::Table table = log::read(run.log);
  if (cut) *cut = !table.complete;
  return report::page({.table = table,
                       .resolved = resolved,
                       .name = experiment_in(run.log),
                       .ended = ended_in(run.log)});
}

bool write_report(const OutputFolder& folder, const signals::Table& logged,
                  const std::string& resolved, const std::string& name, const Messages& messages) {
  if (!report::has_page()) {
    messages.note("no report.html: this sinew was built without npm; docs/dependencies.md");
    return false;
  }
  const config::Node values = config::parse_text(resolved, std::string(resolved_name));
  write_into(folder, report_name,
             report::page({.table = logged, .resolved = values, .name = name}));
  return true;
}

void note_report(const OutputFolder& folder, const Messages& messages) {
  messages.note(fmt::format("to look at it, open {}", (folder.path() / report_name).string()));
}

void add_report(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub =
      subcommand(app, "report", "a run as one page, which opens in any browser, offline",
                 "sinew report runs/walk-test-1/1 -o walk.html");
  sub.add_option("DIR", options->run, "a run's folder, or a log file")->required();
  sub.add_option("-o,--output", options->out, "the file to write; else report.html beside the log");
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return report_run(*options); }; });
}

}  // namespace sinew::cli
