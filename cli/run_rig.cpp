#include "cli/run_rig.h"

#include <fmt/format.h>

#include "cli/page.h"
#include "cli/report.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "cli/runnable.h"
#include "cli/terminal.h"
#include "sinew/analysis/stand.h"
#include "sinew/config/compose.h"
#include "sinew/experiment/rig/measured.h"
#include "sinew/experiment/rig/run.h"

namespace sinew::cli {

namespace {

// The texts and channels that go into the folder of a stand's run, beside the experiment itself.
struct What {
  const std::string& resolved;
  const analysis::StandFile& stand;
  experiment::LoggedTopics logged;
};

void write_log(const rig::Experiment& e, const What& what, const rig::Outcome& outcome,
               const std::string& ended, const OutputFolder& folder) {
  if (!e.log.enabled) return;
  write_into(folder, resolved_name, what.resolved);
  RunLog log(folder.work() / log_name, e.name, e.seed, what.resolved, what.logged);
  log.write(outcome.table);
  log.finish(what.resolved, ended);
}

ExitCode keep(const rig::Experiment& e, const What& what, OutputFolder& folder,
              const RigOptions& options) {
  const Messages messages(options.quiet);
  rig::Outcome outcome = rig::run(e);
  const bool early = outcome.failure || outcome.status != signals::Status::ok;
  const std::string ended = early ? rig::cause_of(e, outcome) : "";
  write_log(e, what, outcome, ended, folder);
  if (early) throw std::runtime_error(fmt::format("{}: the run was ended: {}", e.path, ended));

  const std::string measured = rig::measured_csv(e, outcome.table);
  if (!measured.empty()) write_into(folder, measured_name, measured);
  const analysis::Summary summary = analysis::summarize(outcome.table, what.stand);
  const double factor = outcome.wall > 0 ? outcome.duration / outcome.wall : 0;
  const std::string json =
      to_json(summary, {.numbers = {{"real_time_factor", factor}, {"threads", 1}}});
  write_into(folder, summary_name, json);
  for (const std::string& text : summary.warnings) messages.warning(text);
  bool page = false;
  if (e.log.enabled && options.report)
    page = write_report(folder, experiment::logged_part(std::move(outcome.table), what.logged),
                        what.resolved, e.name, messages);
  commit_run(folder);
  if (options.json) {
    fmt::print("{}", json);
    messages.note(folder.path().string());
  } else {
    print_verdicts(summary, what.stand);
    messages.note(fmt::format("{:.2f} s in {:.3f} s, kept in {}", outcome.duration, outcome.wall,
                              folder.path().string()));
  }
  if (page) note_report(folder, messages);
  return ok;
}

}  // namespace

bool is_rig(const std::string& path) {
  return config::format_kind(config::parse_file(path)) == "rig";
}

ExitCode run_rig(const RigOptions& options) {
  const Messages messages(options.quiet);
  const rig::Experiment e = runnable_on_stand(options.experiment, options.sets);
  for (const config::Problem& warning : e.warnings) messages.warning(config::to_text(warning));
  const std::string resolved = rig::resolved(e, SINEW_VERSION);
  // As `analyze` will read it: so both come to the same bits.
  const analysis::StandFile stand =
      analysis::read_stand(config::parse_text(resolved, std::string(resolved_name)));
  OutputFolder folder = run_folder(options.folder, options.force, e.name);
  try {
    return keep(e, {resolved, stand, rig::logged_topics(e)}, folder, options);
  } catch (const std::exception& problem) {
    throw std::runtime_error(problem.what() + where_left(folder));
  }
}

}  // namespace sinew::cli
