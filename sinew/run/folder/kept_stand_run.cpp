#include "sinew/run/folder/kept_stand_run.h"

#include <fmt/format.h>

#include "sinew/config/node.h"
#include "sinew/experiment/faults.h"
#include "sinew/experiment/rig/measured.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/runnable.h"
#include "sinew/run/stand/run.h"

namespace sinew::run {

namespace {

// The texts and channels that go into the folder of a stand's run, beside the experiment itself.
struct What {
  const std::string& resolved;
  const config::Node& values;  // what it says
  const analysis::StandFile& stand;
  run::LoggedTopics logged;
};

void write_log(const rig::Experiment& e, const What& what, const rig::Outcome& outcome,
               const std::string& ended, const OutputFolder& folder) {
  if (!e.log.enabled) return;
  write_into(folder, resolved_name, what.resolved);
  RunLog log(folder.work() / log_name, e.name, e.seed, what.resolved, what.logged);
  log.write(outcome.table);
  log.finish(what.resolved, ended);
}

Kept<analysis::StandFile> keep(const rig::Experiment& e, const What& what, OutputFolder& folder,
                               const RunRequest& request, const Notices& notices) {
  rig::Outcome outcome = rig::run(e);
  const bool early = outcome.failure || outcome.status != signals::Status::ok;
  const std::string ended = early ? rig::cause_of(e, outcome) : "";
  write_log(e, what, outcome, ended, folder);
  if (early) throw std::runtime_error(fmt::format("{}: the run was ended: {}", e.path, ended));

  const std::string measured = rig::measured_csv(e, outcome.table);
  if (!measured.empty()) write_into(folder, measured_name, measured);
  Kept<analysis::StandFile> kept{.folder = folder.path(),
                                 .summary = analysis::summarize(outcome.table, what.stand),
                                 .machine = what.stand,
                                 .duration = outcome.duration,
                                 .wall = outcome.wall};
  const double factor = outcome.wall > 0 ? outcome.duration / outcome.wall : 0;
  std::vector<std::string> idle;  // what did not break
  for (std::size_t i = 0; i < e.faults.size(); ++i)
    if (const std::string why = why_idle(e.faults[i], rig::last_tick(e)); !why.empty())
      idle.push_back(fmt::format("fault[{}] never acted: {}", i, why));
  kept.json = to_json(
      kept.summary, {.numbers = {{"real_time_factor", factor}, {"threads", 1}}, .warnings = idle});
  write_into(folder, summary_name, kept.json);
  for (const std::string& text : kept.summary.warnings) notices.warning(text);
  for (const std::string& text : idle) notices.warning(text);
  if (e.log.enabled && request.report)
    kept.page = write_report(folder, run::logged_part(std::move(outcome.table), what.logged),
                             what.values, e.name, notices, request.units);
  commit_run(folder);
  return kept;
}

}  // namespace

Kept<analysis::StandFile> run_on_stand(const RunRequest& request, const Notices& notices) {
  const rig::Experiment e = runnable_on_stand(request.experiment, request.sets);
  for (const config::Problem& warning : e.warnings) notices.warning(config::to_text(warning));
  const std::string resolved = rig::resolved(e, SINEW_VERSION);
  // As `analyze` will read it: so both come to the same bits.
  const config::Node values = config::parse_text(resolved, std::string(resolved_name));
  const analysis::StandFile stand = analysis::read_stand(values);
  OutputFolder folder = run_folder(request.folder, request.force, e.name);
  try {
    return keep(e, {resolved, values, stand, rig::logged_topics(e)}, folder, request, notices);
  } catch (const std::exception& problem) {
    throw std::runtime_error(problem.what() + where_left(folder));
  }
}

}  // namespace sinew::run
