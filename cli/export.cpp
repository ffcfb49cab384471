// cli/export.cpp - `sinew export`: a run's log for everything that reads columns.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/config/compose.h"
#include "sinew/experiment/globs.h"
#include "sinew/log/csv.h"
#include "sinew/log/reader.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/setup/buildable.h"
#include "thesis/out_dat/out_dat.h"
#include "thesis/out_dat/ports.h"

namespace sinew::cli {

namespace {

struct ExportOptions {
  std::string run, out, machine;
  std::string format = "csv";
  std::vector<std::string> channels;
  bool csv = false, derived = false, force = false, quiet = false;
};

std::vector<std::string> chosen_topics(const ExportOptions& options, const signals::Table& table) {
  if (options.channels.empty()) return {};
  const std::vector<std::string_view> names = experiment::names_of(table);
  const std::vector<bool> chosen =
      experiment::select(options.channels, names, {"--channels", 0, 0});
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (chosen[i]) topics.emplace_back(names[i]);
  return topics;
}

// What is only CSV's.
void refuse_csv_options(const ExportOptions& options) {
  if (options.format == "csv" || (options.channels.empty() && !options.derived)) return;
  config::fail({"--format", 0, 0}, "", config::in_quotes(options.format),
               "csv, for --channels and --derived");
}

experiment::Experiment experiment_of(const run::RecordedRun& run, const ExportOptions& options) {
  const std::string file = run::machine_of(run, options.machine).string();
  return run::buildable_robot(config::compose(file), file);
}

// Line by line, since a long run's text is longer than memory.
void put_csv(const run::RecordedRun& run, const ExportOptions& options, signals::Table table) {
  if (options.derived) {
    const config::Node root = config::compose(run::machine_of(run, options.machine).string());
    signals::Table derived = analysis::derive(table, analysis::read_machine(root));
    for (signals::Series& s : derived.series) table.series.push_back(std::move(s));
  }
  const std::vector<std::string> topics = chosen_topics(options, table);
  if (!options.out.empty()) {
    run::require_folder_of(options.out);
    return log::write_csv(table, options.out, topics);
  }
  log::write_csv(table, std::cout, topics);
  std::cout.flush();
}

void put(const run::RecordedRun& run, const ExportOptions& options, signals::Table table) {
  if (options.format == "csv") return put_csv(run, options, std::move(table));
  const experiment::Experiment e = experiment_of(run, options);
  const std::string text =
      options.format == "ports" ? thesis::write_ports(table, e) : thesis::write_out_dat(table, e);
  if (!options.out.empty()) return run::write_file(options.out, text);
  fmt::print("{}", text);
}

ExitCode export_run(const ExportOptions& options) {
  const Messages messages(options.quiet);
  refuse_csv_options(options);
  const run::RecordedRun run = run::recorded_run(options.run);
  if (!options.out.empty())
    run::refuse_to_overwrite(options.out, options.force, {run.log, run.resolved, options.machine});

  signals::Table table = log::read(run.log);
  if (!table.complete)
    messages.warning(
        fmt::format("{} was cut off; what stands before is exported", run.log.string()));
  put(run, options, std::move(table));
  if (!options.out.empty()) messages.note(options.out);
  return ok;
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App& sub = subcommand(
      app, "export", "a run's log as CSV, as the thesis's out.dat, or as bytes of its ports",
      "sinew export runs/walk-test-1/1 --csv -o walk.csv");
  sub.add_option("DIR", options->run, "a run's folder, or a log file")->required();
  CLI::App& how = alternatives(sub, "format");
  how.add_option("--format", options->format,
                 "csv: time [s], then a column per channel; out.dat: the log of B.1; ports: bytes "
                 "of the valves' "
                 "ports")
      ->check(one_of({"csv", "out.dat", "ports"}));
  how.add_flag("--csv", options->csv, "the same as --format csv");
  sub.add_option("-o,--output", options->out, "the file to write; else stdout");
  sub.add_option("--channels", options->channels, "csv: topics only; * stands for anything");
  sub.add_flag("--derived", options->derived, "csv: also what the analysis derives");
  sub.add_option("--machine", options->machine, "what was run, in place of the folder's");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return export_run(*options); }; });
}

}  // namespace sinew::cli
