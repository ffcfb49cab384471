#include "cli/sweep_runs.h"

#include <fmt/format.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "cli/command.h"
#include "cli/interrupt.h"

namespace sinew::cli {

namespace {

// Opens the study's file, and takes the rows that are there.
void open_results(const tune::Sweep& s, const SweepRuns& how, tune::Options& options,
                  std::optional<tune::Results>& results) {
  const std::string& file = how.options.results;
  if (file.empty()) return;
  results.emplace(file, tune::asked_of(s));
  options.known = results->rows();
  std::erase_if(options.known, [&](const tune::Row& row) { return !options.share.has(row.point); });
  if (!options.known.empty())
    how.messages.note(fmt::format("{}: {} of {} points are there", file, options.known.size(),
                                  options.share.size(tune::points(s))));
}

// Warns, and refuses what is no whole table. `kept`: the file with the rows, if any.
void judge(const std::vector<tune::Row>& rows, const tune::Sweep& s, std::size_t points,
           const std::string& kept, const SweepRuns& how) {
  for (const std::string& text : tune::warnings(rows)) how.messages.warning(text);
  if (rows.size() < points)
    throw std::runtime_error(fmt::format(
        "interrupted: {} of {} points are done{}{}", rows.size(), points,
        kept.empty() ? "" : " and kept in " + kept,
        how.options.results.empty() ? "" : "; the same command goes on with the others"));
  try {
    tune::refuse_empty_columns(rows, s);
  } catch (const std::exception& e) {
    if (kept.empty()) throw;
    throw std::runtime_error(fmt::format("{}\n{}: holds the rows", e.what(), kept));
  }
}

}  // namespace

std::vector<tune::Row> run_rows(const tune::Sweep& s, const SweepRuns& how) {
  const int all = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  tune::Options options{.threads = how.options.threads > 0 ? how.options.threads : all};
  if (!how.options.shard.empty()) options.share = tune::parse_share(how.options.shard);
  std::optional<tune::Results> results;
  open_results(s, how, options, results);
  // What a study's file keeps need not stand in half a table too.
  const bool late = results && how.csv && !how.csv->part().empty();

  const std::size_t points = options.share.size(tune::points(s));
  std::atomic<std::int64_t> progress{0};
  const ProgressBar bar(progress, static_cast<std::int64_t>(points),
                        {.each = 1, .unit = "points", .decimals = 0}, !how.bar);
  Interrupt interrupt;
  options.stop = &interrupt.asked();
  options.progress = &progress;
  options.row = [&](const tune::Row& row) {
    if (how.csv && !late && !how.csv->add(row.cells)) interrupt.ask();
  };
  options.done = [&](const tune::Row& row) {
    if (results && !results->add(row)) interrupt.ask();
  };
  std::vector<tune::Row> rows = tune::sweep(s, options);
  if (results) results->throw_failure();
  if (how.csv) how.csv->throw_failure();
  judge(rows, s, points, results || !how.csv ? how.options.results : how.csv->part(), how);
  if (!how.csv) return rows;
  if (late)
    for (const tune::Row& row : rows) how.csv->add(row.cells);
  how.csv->throw_failure();
  how.csv->take_place();
  return rows;
}

void add_words(Command sub, const char* name, std::vector<std::string>& words,
               const char* description) {
  sub.add_option(name, words, description).takes_one();
}

void add_runs(Command sub, tune::Study& study, RunOptions& options) {
  add_words(sub, "--range", study.range,
            "KEY=from:to unit, sampled; with \"log\" or \"whole\" behind it; repeated");
  add_words(sub, "--report", study.report,
            "keys of summary.json, with commas: key, or key [unit]; else what is reported of it");
  add_sets(sub, study.set);
  sub.add_flag("--allow-unreachable", study.allow_unreachable, "as in sinew run");
  sub.add_option("--threads", options.threads, "at a time; as many as the machine has")
      .is_between(1, 1024);
  sub.add_option("--results", options.results,
                 "a study's file: each row as soon as its run is done; what is there is not run "
                 "again");
}

}  // namespace sinew::cli
