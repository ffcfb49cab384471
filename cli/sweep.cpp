// cli/sweep.cpp - `sinew sweep`: many runs of one experiment as one table.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/sweep_runs.h"
#include "sinew/config/compose.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file, out;
  tune::Study study;  // what the command line says
  std::string sample;
  std::optional<int> sample_seed;
  int halvings = -1, threads = 0;
  bool force = false, json = false, quiet = false;
};

// A plan's own words, and those of the command line behind them.
tune::Sweep sweep_for(const Options& options) {
  const bool plan = config::format_kind(config::parse_file(options.file)) == "plan";
  tune::Study study = plan ? tune::load_study(options.file) : tune::Study{};
  if (!plan) study.experiment = options.file;

  const tune::Study& said = options.study;
  const auto append = [](std::vector<std::string>& to, const std::vector<std::string>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  append(study.set, said.set);
  append(study.vary, said.vary);
  append(study.range, said.range);
  append(study.where, said.where);
  append(study.report, said.report);
  if (!said.largest.empty()) study.largest = said.largest;
  if (said.seeds > 0) study.seeds = said.seeds;
  if (said.points > 0) study.points = said.points;
  using Kind = tune::Sample::Kind;
  if (options.sample == "sobol") study.sample = Kind::sobol;
  if (options.sample == "latin") study.sample = Kind::latin;
  if (options.sample == "random") study.sample = Kind::random;
  if (options.sample_seed) study.sample_seed = *options.sample_seed;
  if (options.halvings >= 0) study.halvings = options.halvings;
  study.allow_unreachable = study.allow_unreachable || said.allow_unreachable;
  return tune::sweep_of(study);
}

// Before the table takes an older one's place.
void judge(const std::vector<tune::Row>& rows, const tune::Sweep& s, const std::string& part) try {
  tune::refuse_empty_columns(rows, s);
} catch (const std::exception& e) {
  if (part.empty()) throw;
  throw std::runtime_error(std::string(e.what()) + "\n" + part + ": holds the rows");
}

ExitCode sweep_all(const Options& options) {
  const Messages messages(options.quiet);
  const tune::Sweep s = sweep_for(options);
  tune::check(s);

  const std::vector<std::string> headings = tune::headings(s);
  std::optional<tune::TableFile> csv;
  if (!options.out.empty())
    csv.emplace(options.out, headings, options.force, std::vector<fs::path>{options.file});
  else if (!options.json)
    csv.emplace(headings,
                [](std::string_view line) { std::fwrite(line.data(), 1, line.size(), stdout); });
  const std::vector<tune::Row> rows =
      run_rows(s, {.threads = options.threads,
                   .bar = !options.quiet && !options.out.empty(),  // it would run through a table
                   .csv = csv ? &*csv : nullptr});
  const std::size_t points = tune::points(s);
  if (csv) csv->throw_failure();
  if (options.json) fmt::print("{}", tune::json_of(headings, rows));
  const std::string part = csv ? csv->part() : "";
  tell_of_rows(rows, points, part, messages);
  judge(rows, s, part);
  if (csv) csv->take_place();
  if (!options.out.empty()) messages.note(options.out);
  return ok;
}

void add_sample(Command sub, Options& options) {
  sub.add_option("--points", options.study.points, "of the sample, each a row or more")
      .is_between(1, 1000000);
  sub.add_option("--sample", options.sample, "how the points lie: sobol, latin, random; sobol")
      .is_one_of({"sobol", "latin", "random"});
  sub.add_option("--sample-seed", options.sample_seed, "other points of the same kind; 1")
      .is_between(0, 2147483647);
}

}  // namespace

void add_sweep(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = app.subcommand(
      "sweep", "many runs of one experiment as one table",
      "sinew sweep experiments/leg-in-air.toml --vary \"joint.hip.angle_gain=0.02:0.1:5 %/count\" "
      "--report \"joints.hip.tracking_rms_rad [deg]\" -o gain.csv");
  sub.add_option("FILE", options->file, "the experiment, or a plan: the same options as a file")
      .required();
  add_words(sub, "--vary", options->study.vary,
            "KEY=a,b,c unit or KEY=from:to:how many unit; repeated: all combinations");
  add_runs(sub, options->study, options->threads);
  add_sample(sub, *options);
  sub.add_option("--seeds", options->study.seeds, "each point with the noise of seeds 1 … N")
      .is_between(1, 10000);
  sub.add_option("--largest", options->study.largest,
                 "the largest value of one more key for which --where holds; written like --vary");
  add_words(sub, "--where", options->study.where,
            "\"key < value\" of summary.json, also <=, >, >=; repeated: all must hold");
  sub.add_option("--halvings", options->halvings, "of the interval that --largest finds; 6")
      .is_between(0, 50);
  sub.add_option("-o,--output", options->out, "the CSV file to write; else stdout");
  sub.add_flag("--force", options->force, "replace that file");
  sub.add_flag("--json", options->json, "print the table as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return sweep_all(*options); }; });
}

}  // namespace sinew::cli
