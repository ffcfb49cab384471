#include "cli/sweep_runs.h"

#include <fmt/format.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "cli/command.h"
#include "cli/interrupt.h"

namespace sinew::cli {

std::vector<tune::Row> run_rows(const tune::Sweep& s, const SweepRuns& how) {
  std::atomic<std::int64_t> progress{0};
  const ProgressBar bar(progress, static_cast<std::int64_t>(tune::points(s)),
                        {.each = 1, .unit = "points", .decimals = 0}, !how.bar);
  Interrupt interrupt;
  const int all = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return tune::sweep(s, {.threads = how.threads > 0 ? how.threads : all,
                         .stop = &interrupt.asked(),
                         .progress = &progress,
                         .row = [&](const tune::Row& row) {
                           if (how.csv && !how.csv->add(row.cells)) interrupt.ask();
                         }});
}

void tell_of_rows(const std::vector<tune::Row>& rows, std::size_t points, const std::string& part,
                  const Messages& messages) {
  for (const std::string& text : tune::warnings(rows)) messages.warning(text);
  if (rows.size() < points)
    throw std::runtime_error(fmt::format("interrupted: {} of {} points are done{}", rows.size(),
                                         points, part.empty() ? "" : " and kept in " + part));
}

void add_words(Command sub, const char* name, std::vector<std::string>& words,
               const char* description) {
  sub.add_option(name, words, description).takes_one();
}

void add_runs(Command sub, tune::Study& study, int& threads) {
  add_words(sub, "--range", study.range,
            "KEY=from:to unit, sampled; with \"log\" or \"whole\" behind it; repeated");
  add_words(sub, "--report", study.report,
            "keys of summary.json, with commas: key, or key [unit]; else what is reported of it");
  add_sets(sub, study.set);
  sub.add_flag("--allow-unreachable", study.allow_unreachable, "as in sinew run");
  sub.add_option("--threads", threads, "at a time; as many as the machine has").is_between(1, 1024);
}

}  // namespace sinew::cli
