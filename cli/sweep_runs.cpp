#include "cli/sweep_runs.h"

#include <atomic>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/option_groups.h"
#include "sinew/host/side_by_side.h"
#include "sinew/tune/results/results.h"

namespace sinew::cli {

int threads_of(const RunsOptions& options) { return host::threads_of(options.threads); }

// A signal is for the first process, which then lets this one go.
bool is_worker_of(const tune::Ranks& ranks, const RunsOptions& options,
                  const std::function<tune::Sweep()>& sweep) {
  if (!ranks.is_worker()) return false;
  const Interrupt interrupt;
  tune::work(ranks, sweep, std::max(1, options.threads));
  return true;
}

std::vector<tune::Row> run_rows(const tune::Sweep& s, const SweepRuns& how) {
  const std::string& file = how.options.results;
  tune::Options options{.threads = threads_of(how.options)};
  if (!how.options.shard.empty()) options.share = tune::parse_share(how.options.shard);
  std::optional<tune::Results> results;
  tune::open_results(s, file, options, results, how.messages.notices());
  // What a study's file keeps need not stand in half a table too.
  const bool late = results && how.csv && !how.csv->part().empty();

  const std::size_t points = options.share.size(tune::points(s));
  std::atomic<std::int64_t> progress{0};
  const ProgressBar bar(progress, static_cast<std::int64_t>(points),
                        {.each = 1, .unit = "points", .decimals = 0}, !how.bar);
  Interrupt interrupt;
  options.stop = &interrupt.asked();
  options.progress = &progress;
  if (how.master) options.elsewhere = how.master->elsewhere(s, options.stop);
  options.row = [&](const tune::Row& row) {
    if (how.csv && !late && !how.csv->add(row.cells)) interrupt.ask();
  };
  options.done = [&](const tune::Row& row) {
    if (results && !results->add(row)) interrupt.ask();
  };
  std::vector<tune::Row> rows = tune::sweep(s, options);
  if (results) results->throw_failure();
  if (how.csv) how.csv->throw_failure();
  tune::judge(rows, s, points, results || !how.csv ? file : how.csv->part(), !file.empty(),
              how.messages.notices());
  if (!how.csv) return rows;
  if (late)
    for (const tune::Row& row : rows) how.csv->add(row.cells);
  how.csv->throw_failure();
  how.csv->take_place();
  return rows;
}

void add_words(CLI::App& sub, const char* name, std::vector<std::string>& words,
               const char* description) {
  sub.add_option(name, words, description)->allow_extra_args(false);
}

void add_runs(CLI::App& sub, tune::Study& study, RunsOptions& options) {
  add_words(sub, "--range", study.range,
            "KEY=from:to unit, sampled; with \"log\" or \"whole\" behind it; repeated");
  add_words(sub, "--report", study.report,
            "keys of summary.json, with commas: key, or key [unit]; else what is reported of it");
  add_units(sub, study.units, "of figures that name none, else SI; --json is in SI");
  add_sets(sub, study.set);
  sub.add_flag("--allow-unreachable", study.allow_unreachable, "as in sinew run");
  add_keeping(sub, options);
}

void add_keeping(CLI::App& sub, RunsOptions& options) {
  sub.add_option("--threads", options.threads, "at a time; as many as the machine has")
      ->transform(between(1, 1024));
  sub.add_option("--results", options.results,
                 "a study's file: each row as soon as its run is done; what is there is not run "
                 "again");
}

}  // namespace sinew::cli
