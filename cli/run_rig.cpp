#include "cli/run_rig.h"

#include <fmt/format.h>

#include "cli/page.h"
#include "cli/report.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "cli/terminal.h"
#include "sinew/analysis/stand.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/compose.h"
#include "sinew/experiment/rig/measured.h"
#include "sinew/experiment/rig/run.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

// A length that no muscle can have is no result.
void warn_beyond_the_muscle(const analysis::Summary& summary, const Messages& messages) {
  const double* least = summary.find("stand.least_length_m");
  if (least && *least <= 0)
    messages.warning(fmt::format(
        "the load was thrown to {:.3g} m: below the shortest length [31] has no force; try an "
        "actuator whose short_end.law is not \"zero\"",
        *least));
}

}  // namespace

bool is_rig(const std::string& path) {
  return config::format_kind(config::parse_file(path)) == "rig";
}

ExitCode run_rig(const RigOptions& options) {
  const Messages messages(options.quiet);
  const rig::Experiment e = rig::load(options.experiment, options.sets);
  for (const config::Problem& warning : e.warnings) messages.warning(config::to_text(warning));
  const std::string resolved = rig::resolved(e, SINEW_VERSION);
  // As `analyze` will read it: so both come to the same bits.
  const analysis::StandFile stand =
      analysis::read_stand(config::parse_text(resolved, std::string(resolved_name)));
  const experiment::LoggedTopics logged = rig::logged_topics(e);
  const fs::path folder = options.folder.empty() ? next_run_folder(e.name)
                                                 : chosen_run_folder(options.folder, options.force);
  rig::Outcome outcome = rig::run(e);
  if (e.log.enabled) {
    write_file(folder / resolved_name, resolved);
    RunLog log(folder / log_name, e.name, e.seed, resolved, logged);
    log.write(outcome.table);
    log.finish();
  }
  if (outcome.status != signals::Status::ok)
    throw std::runtime_error(fmt::format(
        "{}: the run was ended by a state that is no number; try a smaller step", e.path));

  const std::string measured = rig::measured_csv(e, outcome.table);
  if (!measured.empty()) write_file(folder / measured_name, measured);
  const analysis::Summary summary = analysis::summarize(outcome.table, stand);
  const double factor = outcome.wall > 0 ? outcome.duration / outcome.wall : 0;
  const std::string json = to_json(summary, {{"real_time_factor", factor}, {"threads", 1}});
  write_file(folder / summary_name, json);
  warn_beyond_the_muscle(summary, messages);
  for (const analysis::Warning& w : analysis::clipped_transducers(outcome.table))
    messages.warning(w.text);
  if (e.log.enabled && options.report)
    write_report(folder, experiment::logged_part(std::move(outcome.table), logged), resolved,
                 e.name, messages);
  if (options.json) {
    fmt::print("{}", json);
    messages.note(folder.string());
    return ok;
  }
  print_verdicts(summary, stand);
  messages.note(fmt::format("{:.2f} s in {:.3f} s, kept in {}", outcome.duration, outcome.wall,
                            folder.string()));
  return ok;
}

}  // namespace sinew::cli
