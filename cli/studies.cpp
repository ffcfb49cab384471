// cli/studies.cpp - commands with many runs: sweep, tune, sensitivity and merge.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/host/side_by_side.h"
#include "sinew/run/folder/files.h"
#include "sinew/tune/mpi/work.h"
#include "sinew/tune/optimizer/optimize.h"
#include "sinew/tune/optimizer/tuned_text.h"
#include "sinew/tune/results/results.h"
#include "sinew/tune/sensitivity.h"
#include "sinew/tune/study.h"
#include "sinew/tune/table.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

// --- runs of a sweep ---

// Options of all these commands besides the study.
struct RunsOptions {
  int threads = 0;  // 0: as many as the machine has
  std::string device = "auto";
  std::string results;  // a study's file
  std::string shard;    // "2/3"; empty: all points
};

struct SweepRuns {
  const RunsOptions& options;
  const Messages& messages;
  bool bar = true;                 // a progress bar, on a terminal
  tune::Master* master = nullptr;  // distributes the runs to other processes
  tune::TableFile* csv = nullptr;  // takes the rows, as they come where no other file keeps them
};

// Returns the device of this many runs, and prints which card it is. Where other processes run
// them, each of these chooses its own.
run::Device device_of(const RunsOptions& options, std::size_t runs, const tune::Master* master,
                      const Messages& messages) {
  const run::Device given = run::parse_device(options.device);
  if (master != nullptr && !master->is_alone()) return given;
  run::Device device = run::chosen(given);
  const bool is_named = device.kind == run::Device::Kind::gpu;
  if (device.card && runs > 0 && (is_named || runs >= run::fewest_on_card))
    messages.note("runs on " + run::name_of(device) +
                  "; runs that do not suit it use the processor");
  return device;
}

// Runs what other processes of mpirun hand out, unless this process is the first one or alone: then
// it returns false. `sweep` returns the sweep of this command line. A signal is for the first
// process, which then ends this one.
bool is_worker_of(const tune::Ranks& ranks, const RunsOptions& options,
                  const std::function<tune::Sweep()>& sweep) {
  if (!ranks.is_worker()) return false;
  const Interrupt interrupt;
  tune::work(ranks, sweep, std::max(1, options.threads), run::parse_device(options.device));
  return true;
}

// Returns the rows of the share: those that existed and those that were run. Prints messages about
// them, and puts the table in its place. Throws std::runtime_error where points are missing,
// config::Error where a figure has no row; both name what holds the rows.
std::vector<tune::Row> run_rows(const tune::Sweep& s, const SweepRuns& how) {
  const std::string& file = how.options.results;
  tune::Options options{
      .threads = host::threads_of(how.options.threads),
      .device = device_of(how.options, s.largest ? 0 : tune::points(s), how.master, how.messages),
      .notice = [&](const std::string& text) { how.messages.note(text); }};
  if (!how.options.shard.empty()) options.share = tune::parse_share(how.options.shard);
  std::optional<tune::Results> results;
  tune::open_results(s, file, options, results, how.messages.notices());
  // Rows that a study's file keeps are not needed in half a table.
  const bool late = results && how.csv && !how.csv->part().empty();

  const std::size_t points = options.share.size(tune::points(s));
  std::atomic<std::int64_t> progress{0};
  const ProgressBar bar(progress, static_cast<std::int64_t>(points),
                        {.each = 1, .unit = "points", .decimals = 0}, !how.bar);
  Interrupt interrupt;
  options.stop = &interrupt.requested();
  options.progress = &progress;
  if (how.master) options.dispatch = how.master->dispatcher(s, options.stop);
  options.row = [&](const tune::Row& row) {
    if (how.csv && !late && !how.csv->add(row.cells)) interrupt.request();
  };
  options.done = [&](const tune::Row& row) {
    if (results && !results->add(row)) interrupt.request();
  };
  std::vector<tune::Row> rows = tune::sweep(s, options);
  if (results) results->throw_failure();
  if (how.csv) how.csv->throw_failure();
  tune::check_rows(rows, s, points, results || !how.csv ? file : how.csv->part(), !file.empty(),
                   how.messages.notices());
  if (!how.csv) return rows;
  if (late)
    for (const tune::Row& row : rows) how.csv->add(row.cells);
  how.csv->throw_failure();
  how.csv->take_place();
  return rows;
}

// Adds an option that takes one word each time that it is given.
void add_words(CLI::App& sub, const char* name, std::vector<std::string>& words,
               const char* description) {
  sub.add_option(name, words, description)->allow_extra_args(false);
}

// Returns what is wrong with the name of a device, "" for nothing.
std::string mistake_of_device(const std::string& text) {
  try {
    run::parse_device(text);
  } catch (const config::Error& e) {
    const config::Problem& p = e.problems().front();
    return units::to_text({p.found, p.expected, p.try_this});
  }
  return "";
}

// --threads, --device and --results.
void add_keeping(CLI::App& sub, RunsOptions& options) {
  sub.add_option("--threads", options.threads, "runs at a time; default: one per processor")
      ->transform(between(1, 1024));
  sub.add_option(
         "--device", options.device,
         "DEVICE: what makes the runs: cpu, gpu, gpu:N (a graphics card) or auto; the table is the "
         "same")
      ->transform(passes(mistake_of_device))
      ->capture_default_str();
  sub.add_option("--results", options.results,
                 "FILE: study file that stores each finished row; stored rows are not run again");
}

// --range, --set, --report, --units, --allow-unreachable, --threads, --device and --results.
void add_runs(CLI::App& sub, tune::Study& study, RunsOptions& options) {
  add_words(sub, "--range", study.range,
            "KEY=RANGE: range to sample, \"1:5 lbf\"; behind it, \"log\" spreads the points evenly "
            "in the logarithm, \"whole\" takes whole numbers only");
  add_words(sub, "--report", study.report,
            "KEYS: keys of summary.json, separated by commas, each with or without a unit: "
            "\"duration_s [min]\"; default: those of its [[reported]] entries");
  add_units(sub, study.units, "figures without a unit of their own (default: si); --json is in SI");
  add_sets(sub, study.set);
  sub.add_flag("--allow-unreachable", study.allow_unreachable, "accept unreachable foot paths");
  add_keeping(sub, options);
}

// Writes a CSV file; nothing where it has no name.
void write_table(const std::string& file, const std::vector<std::string>& headings,
                 const std::vector<std::vector<std::string>>& rows, bool force,
                 const std::vector<fs::path>& inputs) {
  if (file.empty()) return;
  tune::TableFile csv(file, headings, force, inputs);
  for (const std::vector<std::string>& row : rows) csv.add(row);
  csv.throw_failure();
  csv.take_place();
}

// --- sweep ---

struct SweepOptions : Flags {
  std::string file, out;
  tune::StudyOptions study_options;  // in addition to the plan
  RunsOptions runs;
};

ExitCode sweep_all(const SweepOptions& options) {
  const auto read_sweep = [&] {
    return tune::sweep_of(tune::load_study(options.file, options.study_options));
  };
  const tune::Ranks ranks;
  if (is_worker_of(ranks, options.runs, read_sweep)) return ok;
  tune::Master master(ranks);
  const Messages messages(options.quiet);
  const tune::Sweep s = read_sweep();
  tune::check(s);

  const std::vector<std::string> headings = tune::headings(s);
  std::optional<tune::TableFile> csv;
  if (!options.out.empty())
    csv.emplace(options.out, headings, options.force, std::vector<fs::path>{options.file});
  else if (!options.json)
    csv.emplace(headings,
                [](std::string_view line) { std::fwrite(line.data(), 1, line.size(), stdout); });
  const std::vector<tune::Row> rows =
      run_rows(s, {.options = options.runs,
                   .messages = messages,
                   .bar = !options.quiet && !options.out.empty(),  // it would run through a table
                   .master = &master,
                   .csv = csv ? &*csv : nullptr});
  if (options.json) fmt::print("{}", tune::json_of(headings, rows));
  if (!options.out.empty()) messages.note(options.out);
  return ok;
}

void add_sample(CLI::App& sub, SweepOptions& options) {
  sub.add_option("--points", options.study_options.study.points,
                 "number of points of the sample; each is one row, or with --seeds several")
      ->transform(between(1, 1000000));
  sub.add_option("--sample", options.study_options.sample,
                 "how the points of the sample are spread; default: sobol")
      ->check(one_of({"sobol", "latin", "random"}));
  sub.add_option("--sample-seed", options.study_options.sample_seed,
                 "seed of the sample; default: 1")
      ->transform(between(0, 2147483647));
}

// --- tune ---

struct TuneOptions : Flags {
  std::string file, out, best, units;
  std::vector<std::string> sets;
  RunsOptions runs;
  int generations = 0, candidate = -1;
};

tune::Tuned run_tuning(const tune::Tuning& tuning, const TuneOptions& options, tune::Master& master,
                       const Messages& messages) {
  const auto all = static_cast<std::int64_t>(tune::points(tuning.runs));
  std::atomic<std::int64_t> progress{0};
  Interrupt interrupt;
  tune::StoredTuningOptions kept{
      .tune = {.runs = {.threads = host::threads_of(options.runs.threads),
                        .device =
                            device_of(options.runs, tuning.method.population, &master, messages)}},
      .ask_to_stop = [&] { interrupt.request(); },
      .notices = messages.notices()};
  kept.tune.runs.stop = &interrupt.requested();
  kept.tune.runs.progress = &progress;
  kept.tune.dispatch = [&](const tune::Sweep& s) {
    return master.dispatcher(s, &interrupt.requested());
  };
  const ProgressBar bar(progress, all, {.each = 1, .unit = "runs", .decimals = 0}, options.quiet);
  return tune::optimize_and_store(tuning, options.runs.results, kept);
}

// Returns the command that runs the candidate.
std::string command_of(const tune::Tuning& tuning, const tune::Candidate& candidate) {
  std::vector<std::string> sets = tuning.runs.sets;
  for (std::size_t i = 0; i < tuning.tuned; ++i)
    sets.push_back(tuning.runs.sample->ranges[i].axis.set(candidate.values[i]));
  std::string out = "sinew run " + tuning.runs.experiment;
  for (const std::string& set : sets)
    out += fmt::format(" --set {0}{1}{0}", set.find('"') == set.npos ? '"' : '\'', set);
  return out + (tuning.runs.allow_unreachable ? " --allow-unreachable" : "");
}

// Prints the table. Units of the command or the session take precedence over those of the file, and
// these over the user's settings.
void print_text(const tune::Tuning& tuning, const tune::Tuned& tuned, const TuneOptions& options) {
  const config::UnitsToShow chosen = chosen_units(options.units, units::UnitSet::si);
  const char* session = std::getenv(config::units_variable);
  const tune::TableUnits shown{chosen.units, !options.units.empty() || (session && *session)};
  fmt::print("{}", tune::text_of(tuning, tuned, chosen.is_requested ? &shown : nullptr));
  if (tuned.best.size() == 1)
    fmt::print("{}\n", command_of(tuning, tuned.candidates[tuned.best.front()]));
}

// Returns the candidate of --candidate, or the only best one.
const tune::Candidate& chosen(const tune::Tuned& tuned, const TuneOptions& options) {
  const std::size_t all = tuned.candidates.size();
  const auto wanted = static_cast<std::size_t>(options.candidate);
  if (options.candidate < 0 && tuned.best.size() == 1) return tuned.candidates[tuned.best.front()];
  if (options.candidate >= 0 && wanted < all) return tuned.candidates[wanted];
  config::fail({"candidate", 0, 0}, "",
               options.candidate < 0 ? fmt::format("{} best candidates", tuned.best.size())
                                     : std::to_string(wanted),
               fmt::format("the number of one, 0 to {}", all - 1), "one of the table's");
}

ExitCode tune_all(const TuneOptions& given) {
  TuneOptions options = given;
  const auto read_tuning = [&] {
    return tune::load_tuning(options.file, options.sets, options.generations);
  };
  if (options.runs.results.empty())
    options.runs.results = fs::path(options.file).stem().string() + ".db";
  const tune::Ranks ranks;
  if (is_worker_of(ranks, options.runs, [&] { return read_tuning().runs; })) return ok;
  tune::Master master(ranks);
  const Messages messages(options.quiet);
  const tune::Tuning tuning = read_tuning();
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
                    "{}; the same command continues with the others",
                    tuned.candidates.size() / tuning.method.population, tuning.generations,
                    options.runs.results));
  }
  // Files come before what is printed: a reader that ends early ends the program.
  std::vector<std::vector<std::string>> rows;
  for (const tune::Candidate& c : tuned.candidates) rows.push_back(tune::candidate_cells(c));
  write_table(options.out, tune::candidate_headings(tuning), rows, options.force, {options.file});
  if (!options.best.empty())
    run::write_file(options.best,
                    tune::experiment_of(tuning, chosen(tuned, options), options.best));
  print();
  return tuned.best.empty() ? failed : ok;
}

// --- sensitivity ---

using tune::Method;

struct SensitivityOptions : Flags {
  tune::Study study;
  RunsOptions run;
  std::string method = "sobol", out, runs;
  int points = 0, seed = 1;
};

tune::Design design_of(const SensitivityOptions& options) {
  tune::Design out{.ranges = options.study.range.size(),
                   .seed = static_cast<std::uint64_t>(options.seed)};
  if (options.method == "morris") out.method = Method::morris;
  if (options.method == "ends") out.method = Method::one_at_a_time;
  const int usual = out.method == Method::morris ? 20 : 256;
  out.count = static_cast<std::size_t>(options.points > 0 ? options.points : usual);
  return out;
}

tune::Sweep runs_of(const SensitivityOptions& options, const tune::Design& design) {
  tune::Study study = options.study;
  if (!study.range.empty()) study.points = 1;  // the design has its own
  return tune::sweep_of(design, tune::sweep_of(study));
}

ExitCode print_sensitivity(const SensitivityOptions& options) {
  const tune::Design design = design_of(options);
  const tune::Ranks ranks;
  if (is_worker_of(ranks, options.run, [&] { return runs_of(options, design); })) return ok;
  tune::Master master(ranks);
  const Messages messages(options.quiet);
  const tune::Sweep runs = runs_of(options, design);
  tune::check(runs);
  const std::vector<fs::path> inputs{options.study.experiment};
  if (!options.out.empty()) run::refuse_to_overwrite(options.out, options.force, inputs);
  std::optional<tune::TableFile> csv;
  if (!options.runs.empty()) csv.emplace(options.runs, tune::headings(runs), options.force, inputs);

  const std::vector<tune::Row> rows = run_rows(runs, {.options = options.run,
                                                      .messages = messages,
                                                      .bar = !options.quiet,
                                                      .master = &master,
                                                      .csv = csv ? &*csv : nullptr});
  if (csv) messages.note(options.runs);

  const auto all = tune::sensitivities(design, runs, rows);
  // Files come before what is printed: a reader that ends early ends the program.
  write_table(options.out, tune::sensitivity_headings(design.method),
              tune::sensitivity_rows(design, runs, all), options.force, inputs);
  if (!options.out.empty()) messages.note(options.out);
  if (options.json)
    fmt::print("{}", tune::sensitivity_json(design, runs, all));
  else
    for (const tune::FigureSensitivity& f : all) fmt::print("{}\n", tune::text_of(design, runs, f));
  return std::ranges::any_of(all, [](const auto& f) { return f.found.has_value(); }) ? ok : failed;
}

// --- merge ---

struct MergeOptions {
  std::vector<std::string> files;
  std::string out;
};

ExitCode merge_all(const MergeOptions& options) {
  const tune::Merged merged =
      tune::merge({options.files.begin(), options.files.end()}, options.out);
  fmt::print("{}: {} of {} points are there, {} of them new\n", options.out, merged.there,
             merged.points, merged.added);
  return ok;
}

}  // namespace

void add_sweep(CLI::App& app, Action& action) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App& sub = subcommand(
      app, "sweep", "Run an experiment with many values and collect one table",
      "sinew sweep experiments/leg-in-air.toml --vary \"joint.hip.angle_gain=0.02:0.1:5 %/count\" "
      "--report \"joints.hip.tracking_rms_rad [deg]\" -o gain.csv");
  sub.add_option("FILE", options->file, "experiment file, or plan of a sweep")->required();
  add_words(
      sub, "--vary", options->study_options.study.vary,
      "KEY=VALUES: values of a key, \"1,2,5 lbf\" or from:to:count with a unit; if repeated, all "
      "combinations");
  add_runs(sub, options->study_options.study, options->runs);
  sub.add_option("--shard", options->runs.shard,
                 "I/N: run only every N-th point, from the I-th on; sinew merge joins the files")
      ->needs(sub.get_option("--results"));
  add_sample(sub, *options);
  sub.add_option("--seeds", options->study_options.study.seeds,
                 "number of runs per point, with the noise of seeds 1 to N")
      ->transform(between(1, 10000));
  sub.add_option("--largest", options->study_options.study.largest,
                 "KEY=VALUES: find the largest value of one more key, for which --where holds");
  add_words(
      sub, "--where", options->study_options.study.where,
      "CONDITION: \"key < value\" of summary.json, also <=, >, >=; if repeated, all must hold");
  sub.add_option("--halvings", options->study_options.halvings,
                 "number of times that --largest halves its interval; default: 6")
      ->transform(between(0, 50));
  sub.add_option("-o,--output", options->out, "FILE: CSV file to write; default: stdout");
  add_flags(sub, *options, "replace an existing file", "print the table as JSON");
  sub.callback([=, &action] {
    if (options->json) options->study_options.study.units.clear();
    action = [=] { return sweep_all(*options); };
  });
}

void add_tune(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "tune", "Search for the best values of an experiment's keys",
                             "sinew tune studies/faster-walk.toml --best faster-walk.toml");
  TuneOptions& options = runs(sub, action, tune_all);
  sub.add_option("FILE", options.file, "tuning file; see docs/how-to/studies.md")->required();
  add_sets(sub, options.sets);
  add_keeping(sub, options.runs);
  sub.add_option("--generations", options.generations,
                 "number of generations, in place of the file's")
      ->transform(between(1, 100000));
  sub.add_option("--best", options.best, "FILE: experiment file to write, with the best candidate");
  sub.add_option("--candidate", options.candidate, "candidate for --best; default: the best one")
      ->transform(between(0, 1000000))
      ->needs(sub.get_option("--best"));
  sub.add_option("-o,--output", options.out, "FILE: also write all candidates to this CSV file");
  add_units(sub, options.units, "the table (default: the file's); written files keep the file's");
  add_flags(sub, options, "replace existing files", "print the result as JSON");
}

void add_sensitivity(CLI::App& app, Action& action) {
  auto options = std::make_shared<SensitivityOptions>();
  CLI::App& sub = subcommand(
      app, "sensitivity", "Rank keys by how strongly each figure depends on their ranges",
      "sinew sensitivity experiments/walk-test-1.toml --range \"joint.hip.angle_gain=0.02:0.08 "
      "%/count\" --range \"air.supply.pressure=70:90 psi gauge\" --report \"trolley.distance_m "
      "[in]\"");
  sub.add_option("FILE", options->study.experiment, "experiment file")->required();
  add_runs(sub, options->study, options->run);
  sub.add_option("--method", options->method,
                 "sobol: shares of the variance; morris: effects along paths; ends: effects of "
                 "both ends of one range at a time; default: sobol")
      ->check(one_of({"sobol", "morris", "ends"}));
  sub.add_option(
         "--points", options->points,
         "sobol: a power of two; each point has as many runs as there are ranges, and 2 more "
         "(default: 256); morris: number of paths, each with one run more than there are "
         "ranges (default: 20)")
      ->transform(between(2, 1000000));
  sub.add_option("--sample-seed", options->seed, "seed of the sample; default: 1")
      ->transform(between(0, 2147483647));
  sub.add_option("-o,--output", options->out, "FILE: also write the table to this CSV file");
  sub.add_option("--runs", options->runs, "FILE: also write every run to this CSV file");
  add_flags(sub, *options, "replace existing files", "print the result as JSON");
  sub.callback([=, &action] {
    if (options->json) options->study.units.clear();
    action = [=] { return print_sensitivity(*options); };
  });
}

void add_merge(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "merge", "Merge the files of one study into one file",
                             "sinew merge a.db b.db c.db -o all.db");
  MergeOptions& options = runs(sub, action, merge_all);
  sub.add_option("FILE", options.files, "files of sinew sweep --results, each of another --shard")
      ->required();
  sub.add_option("-o,--output", options.out,
                 "FILE: study file for all rows; it is created, or extended")
      ->required();
}

}  // namespace sinew::cli
