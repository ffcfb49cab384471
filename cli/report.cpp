// cli/report.cpp - `sinew report`: a recorded run as one page that opens anywhere.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::cli {

namespace {

struct Options {
  std::string run, machine, out;
  bool force = false, quiet = false;
};

ExitCode report_run(const Options& options) {
  const Messages messages(options.quiet);
  const run::RecordedRun recorded = run::recorded_run(options.run);
  const std::filesystem::path out = options.out.empty()
                                        ? recorded.log.parent_path() / run::report_name
                                        : std::filesystem::path(options.out);
  run::refuse_to_overwrite(out, options.force, {recorded.log, recorded.resolved, options.machine});
  bool cut = false;
  const std::string page = run::page_of(recorded, options.machine, &cut);
  if (const std::string ended = run::ended_in(recorded.log); !ended.empty())
    messages.warning(fmt::format("{}: the run was ended: {}; the page shows it until then",
                                 recorded.log.string(), ended));
  if (cut)
    messages.warning(recorded.log.string() +
                     " was cut off or is damaged; the page shows what stands "
                     "before");
  run::write_file(out, page);
  messages.note(
      fmt::format("{}, {:.1f} MB", out.string(), 1e-6 * static_cast<double>(page.size())));
  return ok;
}

}  // namespace

void add_report(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = app.subcommand("report", "a run as one page, which opens in any browser, offline",
                               "sinew report runs/walk-test-1/1 -o walk.html");
  sub.add_option("DIR", options->run, "a run's folder, or a log file").required();
  sub.add_option("-o,--output", options->out, "the file to write; else report.html beside the log");
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return report_run(*options); }; });
}

}  // namespace sinew::cli
