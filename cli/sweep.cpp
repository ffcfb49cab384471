// cli/sweep.cpp - `sinew sweep`: many runs of one experiment as one table.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/sweep_runs.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

struct SweepOptions {
  std::string file, out;
  tune::Said said;  // besides the plan
  RunsOptions runs;
  bool force = false, json = false, quiet = false;
};

ExitCode sweep_all(const SweepOptions& options) {
  const auto asked = [&] { return tune::sweep_of(tune::load_study(options.file, options.said)); };
  const tune::Ranks ranks;
  if (is_worker_of(ranks, options.runs, asked)) return ok;
  tune::Master master(ranks);
  const Messages messages(options.quiet);
  const tune::Sweep s = asked();
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
  sub.add_option("--points", options.said.study.points, "of the sample, each a row or more")
      ->transform(between(1, 1000000));
  sub.add_option("--sample", options.said.sample, "how the points lie: sobol, latin, random; sobol")
      ->check(one_of({"sobol", "latin", "random"}));
  sub.add_option("--sample-seed", options.said.sample_seed, "other points of the same kind; 1")
      ->transform(between(0, 2147483647));
}

}  // namespace

void add_sweep(CLI::App& app, Action& action) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App& sub = subcommand(
      app, "sweep", "many runs of one experiment as one table",
      "sinew sweep experiments/leg-in-air.toml --vary \"joint.hip.angle_gain=0.02:0.1:5 %/count\" "
      "--report \"joints.hip.tracking_rms_rad [deg]\" -o gain.csv");
  sub.add_option("FILE", options->file, "the experiment, or a plan: the same options as a file")
      ->required();
  add_words(sub, "--vary", options->said.study.vary,
            "KEY=a,b,c unit or KEY=from:to:how many unit; repeated: all combinations");
  add_runs(sub, options->said.study, options->runs);
  sub.add_option("--shard", options->runs.shard,
                 "i/n: of all points every n-th from the i-th on; sinew merge joins the files")
      ->needs(sub.get_option("--results"));
  add_sample(sub, *options);
  sub.add_option("--seeds", options->said.study.seeds, "each point with the noise of seeds 1 … N")
      ->transform(between(1, 10000));
  sub.add_option("--largest", options->said.study.largest,
                 "the largest value of one more key for which --where holds; written like --vary");
  add_words(sub, "--where", options->said.study.where,
            "\"key < value\" of summary.json, also <=, >, >=; repeated: all must hold");
  sub.add_option("--halvings", options->said.halvings, "of the interval that --largest finds; 6")
      ->transform(between(0, 50));
  sub.add_option("-o,--output", options->out, "the CSV file to write; else stdout");
  sub.add_flag("--force", options->force, "replace that file");
  sub.add_flag("--json", options->json, "print the table as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] {
    if (options->json) options->said.study.units.clear();
    action = [=] { return sweep_all(*options); };
  });
}

}  // namespace sinew::cli
