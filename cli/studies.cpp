// cli/studies.cpp - commands with many runs: sweep, tune, sensitivity and merge.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
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
#include "sinew/units/shell.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

// --- files that are written, besides those of rows ---

constexpr run::FileKind candidates_kind{"table of candidates", "such a table",
                                        "candidate,generation,feasible,", run::FileKind::At::start};
constexpr run::FileKind sensitivities_kind{"table of sensitivities", "such a table",
                                           "figure,range,", run::FileKind::At::start};
constexpr run::FileKind experiment_kind{"experiment", "an experiment",
                                        "format=\"sinew.experiment/"};

// --- runs of a sweep ---

// Options of all these commands besides the study.
struct RunsOptions {
  int threads = 0;  // 0: as many as the machine has
  std::string device = "auto";
  std::string results;  // a study's file
  std::string shard;    // "2/3"; empty: all points
};

// Returns the device of this many runs, and prints which card it is. Where other processes run
// them, each of these chooses its own.
run::Device device_of(const RunsOptions& options, std::size_t runs, const tune::Master& master,
                      const Messages& messages) {
  const run::Device given = run::parse_device(options.device);
  if (!master.is_alone()) return given;
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

// Returns the rows of the share: those that existed and those that were run. `csv` takes them, too,
// null: none.
std::vector<tune::Row> run_rows(const tune::Sweep& s, const RunsOptions& options,
                                tune::Master& master, tune::TableFile* csv,
                                const Messages& messages, bool shows_bar) {
  std::atomic<std::int64_t> progress{0};
  Interrupt interrupt;
  tune::StoredSweepOptions kept{
      .sweep = {.threads = host::threads_of(options.threads),
                .device = device_of(options, s.largest ? 0 : tune::points(s), master, messages),
                .notice = [&](const std::string& text) { messages.note(text); },
                .stop = &interrupt.requested(),
                .progress = &progress},
      .table = csv,
      .ask_to_stop = [&] { interrupt.request(); },
      .notices = messages.notices()};
  if (!options.shard.empty()) kept.sweep.share = tune::parse_share(options.shard);
  kept.sweep.dispatch = master.dispatcher(s, &interrupt.requested());
  const ProgressBar bar(progress, static_cast<std::int64_t>(kept.sweep.share.size(tune::points(s))),
                        {.unit = "points"}, !shows_bar);
  return tune::sweep_and_store(s, options.results, kept);
}

// --threads, --device and --results.
void add_keeping(CLI::App& sub, RunsOptions& options) {
  const auto no_device = [](const std::string& text) { return run::parse_device(text), ""; };
  sub.add_option("--threads", options.threads, "runs at a time; default: one per processor")
      ->transform(between(1, 1024));
  sub.add_option(
         "--device", options.device,
         "DEVICE: what makes the runs: cpu, gpu, gpu:N (a graphics card) or auto; the table is the "
         "same")
      ->transform(passes(no_device))
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

// --- sweep ---

struct SweepOptions : Flags {
  std::string file, out;
  tune::StudyOptions study_options;  // in addition to the plan
  RunsOptions runs;
};

ExitCode sweep_all(const SweepOptions& given) {
  SweepOptions options = given;
  if (options.json) options.study_options.study.units.clear();
  const auto read_sweep = [&] {
    return tune::sweep_of(tune::load_study(options.file, options.study_options));
  };
  const tune::Ranks ranks;
  if (is_worker_of(ranks, options.runs, read_sweep)) return ok;
  tune::Master master(ranks);
  const Messages messages(options.quiet);
  const tune::Sweep s = read_sweep();
  tune::check(s);

  run::refuse_same_files({{"--results", options.runs.results}, {"--output", options.out}});
  const std::vector<std::string> headings = tune::headings(s);
  std::optional<tune::TableFile> csv;
  if (!options.out.empty())
    csv.emplace(options.out, headings, options.force, std::vector<fs::path>{options.file});
  else if (!options.json)
    csv.emplace(headings,
                [](std::string_view line) { std::fwrite(line.data(), 1, line.size(), stdout); });
  const std::vector<tune::Row> rows =
      run_rows(s, options.runs, master, csv ? &*csv : nullptr, messages,
               !options.quiet && !options.out.empty());  // it would run through a table
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

// Refuses a file that cannot be written, before the runs begin.
void require_place(const std::string& file, bool force, const run::FileKind& kind,
                   const std::vector<fs::path>& inputs) {
  if (file.empty()) return;
  run::refuse_to_overwrite(file, force, kind, inputs);
  run::require_folder_of(file);
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
                            device_of(options.runs, tuning.method.population, master, messages)}},
      .ask_to_stop = [&] { interrupt.request(); },
      .notices = messages.notices()};
  kept.tune.runs.stop = &interrupt.requested();
  kept.tune.runs.progress = &progress;
  kept.tune.dispatch = [&](const tune::Sweep& s) {
    return master.dispatcher(s, &interrupt.requested());
  };
  const ProgressBar bar(progress, all, {.unit = "runs"}, options.quiet);
  return tune::optimize_and_store(tuning, options.runs.results, kept);
}

// Returns the command that runs the candidate.
std::string command_of(const tune::Tuning& tuning, const tune::Candidate& candidate) {
  std::vector<std::string> sets = tuning.runs.sets;
  for (std::size_t i = 0; i < tuning.tuned; ++i)
    sets.push_back(tuning.runs.sample->ranges[i].axis.set(candidate.values[i]));
  std::string out = "sinew run " + units::shell_word(tuning.runs.experiment);
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
  run::refuse_same_files(
      {{"--results", options.runs.results}, {"--output", options.out}, {"--best", options.best}});
  require_place(options.out, options.force, candidates_kind, inputs);
  require_place(options.best, options.force, experiment_kind, inputs);
  if (!options.best.empty()) tune::require_candidate(tuning, options.candidate);

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
  tune::write_table(options.out, tune::candidate_headings(tuning), rows, options.force,
                    {options.file}, candidates_kind);
  if (!options.best.empty())
    run::write_file(
        options.best,
        tune::experiment_of(tuning, tune::candidate_of(tuned, options.candidate), options.best));
  print();
  return tuned.best.empty() ? failed : ok;
}

// --- sensitivity ---

struct SensitivityOptions : Flags {
  tune::Study study;
  RunsOptions run;
  std::string method = "sobol", out, runs;
  int points = 0, seed = 1;
};

tune::Sweep runs_of(const SensitivityOptions& options, const tune::Design& design) {
  tune::Study study = options.study;
  if (options.json) study.units.clear();
  if (!study.range.empty()) study.points = 1;  // the design has its own
  return tune::sweep_of(design, tune::sweep_of(study));
}

ExitCode print_sensitivity(const SensitivityOptions& options) {
  const tune::Design design =
      tune::design_of(options.method, options.study.range.size(), options.points, options.seed);
  const tune::Ranks ranks;
  if (is_worker_of(ranks, options.run, [&] { return runs_of(options, design); })) return ok;
  tune::Master master(ranks);
  const Messages messages(options.quiet);
  const tune::Sweep runs = runs_of(options, design);
  tune::check(runs);
  const std::vector<fs::path> inputs{options.study.experiment};
  run::refuse_same_files(
      {{"--results", options.run.results}, {"--output", options.out}, {"--runs", options.runs}});
  require_place(options.out, options.force, sensitivities_kind, inputs);
  std::optional<tune::TableFile> csv;
  if (!options.runs.empty()) csv.emplace(options.runs, tune::headings(runs), options.force, inputs);

  const std::vector<tune::Row> rows =
      run_rows(runs, options.run, master, csv ? &*csv : nullptr, messages, !options.quiet);
  if (csv) messages.note(options.runs);

  const auto all = tune::sensitivities(design, runs, rows);
  // Files come before what is printed: a reader that ends early ends the program.
  tune::write_table(options.out, tune::sensitivity_headings(design.method),
                    tune::sensitivity_rows(design, runs, all), options.force, inputs,
                    sensitivities_kind);
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
  CLI::App& sub = subcommand(
      app, "sweep", "Run an experiment with many values and collect one table",
      "sinew sweep experiments/leg-in-air.toml --vary \"joint.hip.angle_gain=0.02:0.1:5 %/count\" "
      "--report \"joints.hip.tracking_rms_rad [deg]\" -o gain.csv");
  SweepOptions& options = runs(sub, action, sweep_all);
  sub.add_option("FILE", options.file, "experiment file, or plan of a sweep")->required();
  add_words(
      sub, "--vary", options.study_options.study.vary,
      "KEY=VALUES: values of a key, \"1,2,5 lbf\" or from:to:count with a unit; if repeated, all "
      "combinations");
  add_runs(sub, options.study_options.study, options.runs);
  sub.add_option("--shard", options.runs.shard,
                 "I/N: run only every N-th point, from the I-th on; sinew merge joins the files")
      ->needs(sub.get_option("--results"));
  add_sample(sub, options);
  sub.add_option("--seeds", options.study_options.study.seeds,
                 "number of runs per point, with the noise of seeds 1 to N")
      ->transform(between(1, 10000));
  sub.add_option("--largest", options.study_options.study.largest,
                 "KEY=VALUES: find the largest value of one more key, for which --where holds");
  add_words(
      sub, "--where", options.study_options.study.where,
      "CONDITION: \"key < value\" of summary.json, also <=, >, >=; if repeated, all must hold");
  sub.add_option("--halvings", options.study_options.halvings,
                 "number of times that --largest halves its interval; default: 6")
      ->transform(between(0, 50));
  sub.add_option("-o,--output", options.out, "FILE: CSV file to write; default: stdout");
  add_flags(sub, options, "replace an existing file", "print the table as JSON");
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
  CLI::App& sub = subcommand(
      app, "sensitivity", "Rank keys by how strongly each figure depends on their ranges",
      "sinew sensitivity experiments/walk-test-1.toml --range \"joint.hip.angle_gain=0.02:0.08 "
      "%/count\" --range \"air.supply.pressure=70:90 psi gauge\" --report \"trolley.distance_m "
      "[in]\"");
  SensitivityOptions& options = runs(sub, action, print_sensitivity);
  sub.add_option("FILE", options.study.experiment, "experiment file")->required();
  add_runs(sub, options.study, options.run);
  sub.add_option("--method", options.method,
                 "sobol: shares of the variance; morris: effects along paths; ends: effects of "
                 "both ends of one range at a time; default: sobol")
      ->check(one_of({"sobol", "morris", "ends"}));
  sub.add_option(
         "--points", options.points,
         "sobol: a power of two; each point has as many runs as there are ranges, and 2 more "
         "(default: 256); morris: number of paths, each with one run more than there are "
         "ranges (default: 20)")
      ->transform(between(2, 1000000));
  sub.add_option("--sample-seed", options.seed, "seed of the sample; default: 1")
      ->transform(between(0, 2147483647));
  sub.add_option("-o,--output", options.out, "FILE: also write the table to this CSV file");
  sub.add_option("--runs", options.runs, "FILE: also write every run to this CSV file");
  add_flags(sub, options, "replace existing files", "print the result as JSON");
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
