// cli/sensitivity.cpp - `sinew sensitivity`: which ranges a figure follows, and how strongly.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/command.h"
#include "cli/sweep_runs.h"
#include "sinew/run/folder/files.h"
#include "sinew/tune/sensitivity.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;
using tune::Method;

struct SensitivityOptions {
  tune::Study study;
  RunsOptions run;
  std::string method = "sobol", out, runs;
  int points = 0, seed = 1;
  bool force = false, json = false, quiet = false;
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

void write_table(const SensitivityOptions& options, const tune::Design& design,
                 const tune::Sweep& runs, const std::vector<tune::FigureSensitivity>& all,
                 const Messages& messages) {
  tune::TableFile csv(options.out, tune::sensitivity_headings(design.method), options.force,
                      {options.study.experiment});
  for (const std::vector<std::string>& row : tune::sensitivity_rows(design, runs, all))
    csv.add(row);
  csv.throw_failure();
  csv.take_place();
  messages.note(options.out);
}

ExitCode tell_sensitivity(const SensitivityOptions& options) {
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
  // A reader that ends early ends the program.
  if (!options.out.empty()) write_table(options, design, runs, all, messages);
  if (options.json)
    fmt::print("{}", tune::sensitivity_json(design, runs, all));
  else
    for (const tune::FigureSensitivity& f : all) fmt::print("{}\n", tune::text_of(design, runs, f));
  return std::ranges::any_of(all, [](const auto& f) { return f.found.has_value(); }) ? ok : failed;
}

}  // namespace

void add_sensitivity(CLI::App& app, Action& action) {
  auto options = std::make_shared<SensitivityOptions>();
  CLI::App& sub = subcommand(
      app, "sensitivity", "which ranges a figure follows, and how strongly",
      "sinew sensitivity experiments/walk-test-1.toml --range \"joint.hip.angle_gain=0.02:0.08 "
      "%/count\" --range \"air.supply.pressure=70:90 psi gauge\" --report \"trolley.distance_m "
      "[in]\"");
  sub.add_option("FILE", options->study.experiment, "the experiment")->required();
  add_runs(sub, options->study, options->run);
  sub.add_option(
         "--method", options->method,
         "sobol: shares of the variance; morris: effects along paths; ends: to both ends of "
         "one range at a time")
      ->check(one_of({"sobol", "morris", "ends"}));
  sub.add_option("--points", options->points,
                 "sobol: rows, each as many runs as ranges and 2, a power of two; 256. morris: "
                 "paths, each as many runs as ranges and 1; 20")
      ->transform(between(2, 1000000));
  sub.add_option("--sample-seed", options->seed, "other points of the same kind; 1")
      ->transform(between(0, 2147483647));
  sub.add_option("-o,--output", options->out, "also write the table to this CSV file");
  sub.add_option("--runs", options->runs, "also write every run to this CSV file");
  sub.add_flag("--force", options->force, "replace those files");
  sub.add_flag("--json", options->json, "print it as JSON");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] {
    if (options->json) options->study.units.clear();
    action = [=] { return tell_sensitivity(*options); };
  });
}

}  // namespace sinew::cli
