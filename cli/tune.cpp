// cli/tune.cpp - `sinew tune`: the best candidates of a tuning's file.
#include <fmt/format.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/option_groups.h"
#include "cli/sweep_runs.h"
#include "sinew/config/diagnostics.h"
#include "sinew/run/folder/files.h"
#include "sinew/tune/optimizer/candidate_file.h"
#include "sinew/tune/optimizer/optimize.h"
#include "sinew/tune/optimizer/tuned_text.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

struct TuneOptions {
  std::string file, out, best, units;
  std::vector<std::string> sets;
  RunsOptions runs;
  int generations = 0, candidate = -1;
  bool force = false, json = false, quiet = false;
};

tune::Tuned run_tuning(const tune::Tuning& tuning, const TuneOptions& options, tune::Master& master,
                       const Messages& messages) {
  const auto all = static_cast<std::int64_t>(tune::points(tuning.runs));
  std::atomic<std::int64_t> progress{0};
  Interrupt interrupt;
  tune::KeptOptions kept{.tune = {.runs = {.threads = threads_of(options.runs)}},
                         .ask_to_stop = [&] { interrupt.ask(); },
                         .notices = messages.notices()};
  kept.tune.runs.stop = &interrupt.asked();
  kept.tune.runs.progress = &progress;
  kept.tune.elsewhere = [&](const tune::Sweep& s) {
    return master.elsewhere(s, &interrupt.asked());
  };
  const ProgressBar bar(progress, all, {.each = 1, .unit = "runs", .decimals = 0}, options.quiet);
  return tune::optimize_kept(tuning, options.runs.results, kept);
}

// What a shell runs the candidate by.
std::string command_of(const tune::Tuning& tuning, const tune::Candidate& candidate) {
  std::vector<std::string> sets = tuning.runs.sets;
  for (std::size_t i = 0; i < tuning.tuned; ++i)
    sets.push_back(tuning.runs.sample->ranges[i].axis.set(candidate.values[i]));
  std::string out = "sinew run " + tuning.runs.experiment;
  for (const std::string& set : sets)
    out += fmt::format(" --set {0}{1}{0}", set.find('"') == set.npos ? '"' : '\'', set);
  return out + (tuning.runs.allow_unreachable ? " --allow-unreachable" : "");
}

void write_table(const tune::Tuning& tuning, const tune::Tuned& tuned, const TuneOptions& options) {
  tune::TableFile csv(options.out, tune::candidate_headings(tuning), options.force, {options.file});
  for (const tune::Candidate& c : tuned.candidates) csv.add(tune::candidate_cells(c));
  csv.throw_failure();
  csv.take_place();
}

// Prints the table. Units that were asked for now are stronger than those that the file names, and
// these are stronger than the units of the person's settings.
void print_text(const tune::Tuning& tuning, const tune::Tuned& tuned, const TuneOptions& options) {
  const config::UnitsToShow asked = chosen_units(options.units, units::UnitSet::si);
  const char* session = std::getenv(config::units_variable);
  const tune::TableUnits shown{asked.units, !options.units.empty() || (session && *session)};
  fmt::print("{}", tune::text_of(tuning, tuned, asked.asked ? &shown : nullptr));
  if (tuned.best.size() == 1)
    fmt::print("{}\n", command_of(tuning, tuned.candidates[tuned.best.front()]));
}

// The one that was asked for, or the only best one.
const tune::Candidate& chosen(const tune::Tuned& tuned, const TuneOptions& options) {
  const std::size_t all = tuned.candidates.size();
  const auto asked = static_cast<std::size_t>(options.candidate);
  if (options.candidate < 0 && tuned.best.size() == 1) return tuned.candidates[tuned.best.front()];
  if (options.candidate >= 0 && asked < all) return tuned.candidates[asked];
  config::fail({"candidate", 0, 0}, "",
               options.candidate < 0 ? fmt::format("{} best candidates", tuned.best.size())
                                     : std::to_string(asked),
               fmt::format("the number of one, 0 to {}", all - 1), "one of the table's");
}

ExitCode tune_all(const TuneOptions& given) {
  TuneOptions options = given;
  const auto asked = [&] {
    return tune::load_tuning(options.file, options.sets, options.generations);
  };
  if (options.runs.results.empty())
    options.runs.results = fs::path(options.file).stem().string() + ".db";
  const tune::Ranks ranks;
  if (is_worker_of(ranks, options.runs, [&] { return asked().runs; })) return ok;
  tune::Master master(ranks);
  const Messages messages(options.quiet);
  const tune::Tuning tuning = asked();
  const std::vector<fs::path> inputs{options.file, tuning.runs.experiment};
  if (!options.out.empty()) run::refuse_to_overwrite(options.out, options.force, inputs);
  if (!options.best.empty()) run::refuse_to_overwrite(options.best, options.force, inputs, ".toml");

  const tune::Tuned tuned = run_tuning(tuning, options, master, messages);
  const auto print = [&] {
    if (options.json)
      fmt::print("{}", tune::json_of(tuning, tuned));
    else
      print_text(tuning, tuned, options);
    messages.note(options.runs.results);
  };
  if (tuned.stopped) {
    print();
    throw std::runtime_error(
        fmt::format("interrupted: {} of {} generations are done and kept in "
                    "{}; the same command goes on with the others",
                    tuned.candidates.size() / tuning.method.population, tuning.generations,
                    options.runs.results));
  }
  // Files come before what is printed: a reader that ends early ends the program.
  if (!options.out.empty()) write_table(tuning, tuned, options);
  if (!options.best.empty())
    run::write_file(options.best,
                    tune::experiment_of(tuning, chosen(tuned, options), options.best));
  print();
  return tuned.best.empty() ? failed : ok;
}

}  // namespace

void add_tune(CLI::App& app, Action& action) {
  auto options = std::make_shared<TuneOptions>();
  CLI::App& sub = subcommand(app, "tune", "the best values of an experiment's keys",
                             "sinew tune studies/faster-walk.toml --best faster-walk.toml");
  sub.add_option("FILE", options->file, "what is tuned, by which goals: docs/how-to/studies.md")
      ->required();
  add_sets(sub, options->sets);
  add_keeping(sub, options->runs);
  sub.add_option("--generations", options->generations, "in place of the file's number")
      ->transform(between(1, 100000));
  sub.add_option("--best", options->best, "also write the best candidate as this experiment");
  sub.add_option("--candidate", options->candidate, "write this one in its place")
      ->transform(between(0, 1000000))
      ->needs(sub.get_option("--best"));
  sub.add_option("-o,--output", options->out, "also write all candidates to this CSV file");
  add_units(sub, options->units, "of the table, else the file's; what is written keeps the file's");
  sub.add_flag("--force", options->force, "replace those files");
  sub.add_flag("--json", options->json, "print the result as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return tune_all(*options); }; });
}

}  // namespace sinew::cli
