// cli/report.cpp - `sinew report`: a recorded run, or a study, as one page that opens anywhere.
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/page.h"
#include "sinew/tune/page/study_view.h"

namespace sinew::cli {

namespace {

struct ReportOptions {
  std::vector<std::string> runs;
  std::string machine, out, units;
  bool force = false, quiet = false;
};

ExitCode write(const std::filesystem::path& out, const std::string& page,
               const Messages& messages) {
  run::write_file(out, page);
  messages.note(
      fmt::format("{}, {:.1f} MB", out.string(), 1e-6 * static_cast<double>(page.size())));
  return ok;
}

ExitCode report_study(const ReportOptions& options) {
  std::filesystem::path out = options.out;
  if (out.empty()) out = std::filesystem::path(options.runs[0]).replace_extension(".html");
  const std::vector<std::filesystem::path> files(options.runs.begin(), options.runs.end());
  run::refuse_to_overwrite(out, options.force, files);
  return write(out, tune::study_page_of(files), Messages(options.quiet));
}

ExitCode report_run(const ReportOptions& options) {
  const Messages messages(options.quiet);
  const run::RecordedRun recorded = run::recorded_run(options.runs[0]);
  const std::filesystem::path out = options.out.empty()
                                        ? recorded.log.parent_path() / run::report_name
                                        : std::filesystem::path(options.out);
  run::refuse_to_overwrite(out, options.force, {recorded.log, recorded.resolved, options.machine});
  return write(out, run::page_of(recorded, options.machine, messages.notices(), options.units),
               messages);
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App& sub =
      subcommand(app, "report", "a run or a study as one page, which opens in any browser",
                 "sinew report runs/walk-test-1/1 -o walk.html");
  sub.add_option("DIR", options->runs, "a run's folder, a log file, or one or two studies' files")
      ->required()
      ->expected(1, 2);
  sub.add_option("-o,--output", options->out,
                 "the file to write; else report.html beside the log, STUDY.html beside STUDY.db");
  sub.add_option("--machine", options->machine,
                 "what was run, in place of the folder's resolved.toml");
  add_units(sub, options->units, "in which the page of a run begins, else as set");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] {
    const bool study = tune::is_study(options->runs.front());
    if (!study && options->runs.size() > 1)
      refuse("DIR", "two runs", "one run, or studies; sinew compare shows runs beside each other");
    if (study && !options->machine.empty())
      refuse("--machine", "a study beside it", "a run: a study has no machine of its own");
    action = [=] { return study ? report_study(*options) : report_run(*options); };
  });
}

}  // namespace sinew::cli
