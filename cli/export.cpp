// cli/export.cpp - `sinew export`: a run's log for everything that reads columns.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/globs.h"
#include "cli/run_folder.h"
#include "cli/terminal.h"
#include "sinew/analysis/derived.h"
#include "sinew/analysis/machine.h"
#include "sinew/config/compose.h"
#include "sinew/log/csv.h"
#include "sinew/log/reader.h"

namespace sinew::cli {

namespace {

struct Options {
  std::string run, out, machine;
  std::vector<std::string> channels;
  bool csv = false, derived = false, force = false, quiet = false;
};

std::vector<std::string> chosen_topics(const Options& options, const signals::Table& table) {
  if (options.channels.empty()) return {};
  const std::vector<std::string_view> names = names_of(table);
  const std::vector<bool> chosen = select(options.channels, names, {"--channels", 0, 0});
  std::vector<std::string> topics;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (chosen[i]) topics.emplace_back(names[i]);
  return topics;
}

ExitCode export_run(const Options& options) {
  const Messages messages(options.quiet);
  const RecordedRun run = recorded_run(options.run);
  if (!options.out.empty()) refuse_to_overwrite(options.out, options.force);

  signals::Table table = log::read(run.log);
  if (!table.complete)
    messages.warning(
        fmt::format("{} was cut off; what stands before is exported", run.log.string()));
  if (options.derived) {
    const config::Node root = config::compose(machine_of(run, options.machine).string());
    signals::Table derived = analysis::derive(table, analysis::read_machine(root));
    for (signals::Series& s : derived.series) table.series.push_back(std::move(s));
  }
  const std::vector<std::string> topics = chosen_topics(options, table);
  if (options.out.empty()) {
    log::write_csv(table, std::cout, topics);
    std::cout.flush();
  } else {
    log::write_csv(table, std::filesystem::path(options.out), topics);
    messages.note(options.out);
  }
  return ok;
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub = subcommand(app, "export", "a run's log as CSV",
                             "sinew export runs/walk-test-1/1 --csv -o walk.csv");
  sub.add_option("DIR", options->run, "a run's folder, or a log file")->required();
  sub.add_flag("--csv", options->csv, "as CSV: time [s], then a column per channel")->required();
  sub.add_option("-o,--output", options->out, "the file to write; else stdout");
  sub.add_option("--channels", options->channels, "topics only; * stands for anything");
  sub.add_flag("--derived", options->derived, "also what the analysis derives");
  sub.add_option("--machine", options->machine, "what was run, in place of the folder's");
  sub.add_flag("--force", options->force, "replace the file");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return export_run(*options); }; });
}

}  // namespace sinew::cli
