// cli/sweep.cpp - `sinew sweep`: many runs of one experiment as one table.
#include <fmt/format.h>

#include <optional>
#include <thread>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/terminal.h"
#include "sinew/config/compose.h"
#include "sinew/tune/study.h"
#include "sinew/tune/table.h"

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

int threads_for(const Options& options) {
  if (options.threads > 0) return options.threads;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

// The bar would run through a table on the same terminal.
std::vector<tune::Row> run_all(const Options& options, const tune::Sweep& s, tune::TableFile* csv) {
  std::atomic<std::int64_t> progress{0};
  const ProgressBar bar(progress, static_cast<std::int64_t>(tune::points(s)),
                        {.each = 1, .unit = "points", .decimals = 0},
                        options.quiet || options.out.empty());
  Interrupt interrupt;
  return tune::sweep(s, {.threads = threads_for(options),
                         .stop = &interrupt.asked(),
                         .progress = &progress,
                         .row = [&](const tune::Row& row) {
                           if (csv && !csv->add(row.cells)) interrupt.ask();
                         }});
}

// Before the table takes an older one's place.
void judge(const std::vector<tune::Row>& rows, const tune::Sweep& s, const std::string& part) try {
  tune::refuse_empty_columns(rows, s);
} catch (const std::exception& e) {
  if (part.empty()) throw;
  throw std::runtime_error(std::string(e.what()) + "\n" + part + ": holds the rows");
}

void tell(const std::vector<tune::Row>& rows, std::size_t points, const std::string& part,
          const Messages& messages) {
  for (const std::string& text : tune::warnings(rows)) messages.warning(text);
  if (rows.size() < points)
    throw std::runtime_error(fmt::format("interrupted: {} of {} points are done{}", rows.size(),
                                         points, part.empty() ? "" : " and kept in " + part));
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
  const std::vector<tune::Row> rows = run_all(options, s, csv ? &*csv : nullptr);
  const std::size_t points = tune::points(s);
  if (csv) csv->throw_failure();
  if (options.json) fmt::print("{}", tune::json_of(headings, rows));
  const std::string part = csv ? csv->part() : "";
  tell(rows, points, part, messages);
  judge(rows, s, part);
  if (csv) csv->take_place();
  if (!options.out.empty()) messages.note(options.out);
  return ok;
}

// One each, so that what follows stays what it is.
void add_words(Command sub, const char* name, std::vector<std::string>& words,
               const char* description) {
  sub.add_option(name, words, description).takes_one();
}

void add_sample(Command sub, Options& options) {
  add_words(sub, "--range", options.study.range,
            "KEY=from:to unit, sampled; with \"log\" or \"whole\" behind it; repeated");
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
  add_sample(sub, *options);
  sub.add_option("--seeds", options->study.seeds, "each point with the noise of seeds 1 … N")
      .is_between(1, 10000);
  add_words(sub, "--report", options->study.report,
            "keys of summary.json, with commas: key, or key [unit]; else what is reported of it");
  sub.add_option("--largest", options->study.largest,
                 "the largest value of one more key for which --where holds; written like --vary");
  add_words(sub, "--where", options->study.where,
            "\"key < value\" of summary.json, also <=, >, >=; repeated: all must hold");
  sub.add_option("--halvings", options->halvings, "of the interval that --largest finds; 6")
      .is_between(0, 50);
  add_sets(sub, options->study.set);
  sub.add_flag("--allow-unreachable", options->study.allow_unreachable, "as in sinew run");
  sub.add_option("--threads", options->threads, "at a time; as many as the machine has")
      .is_between(1, 1024);
  sub.add_option("-o,--output", options->out, "the CSV file to write; else stdout");
  sub.add_flag("--force", options->force, "replace that file");
  sub.add_flag("--json", options->json, "print the table as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return sweep_all(*options); }; });
}

}  // namespace sinew::cli
