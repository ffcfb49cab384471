// cli/compare.cpp - `sinew compare`: runs beside each other, as tables and as one page.
#include "cli/compare.h"

#include <fmt/format.h>

#include <set>

#include "cli/command.h"
#include "cli/run_folder.h"
#include "cli/run_log.h"
#include "cli/terminal.h"
#include "sinew/experiment/globs.h"
#include "sinew/log/reader.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

constexpr int most_runs = 8;  // colors that can be told apart

struct Options {
  std::vector<std::string> runs, channels;
  std::string out, align = "start", units = "thesis";
  bool json = false, all = false, force = false, quiet = false;
};

// The last `parts` of a run's path; the log's usual name says nothing.
std::string tail_of(const fs::path& run, std::size_t parts) {
  std::vector<std::string> names;
  for (const fs::path& part : run.lexically_normal())
    if (!part.empty() && part != "." && part != log_name) names.push_back(part.string());
  std::string tail;
  for (std::size_t i = names.size() > parts ? names.size() - parts : 0; i < names.size(); ++i)
    tail += (tail.empty() || tail == "/" ? "" : "/") + names[i];
  return tail.empty() ? "." : tail;
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

// The shortest ends of the paths that tell the runs apart. A number alone says too little.
std::vector<std::string> labels_of(const std::vector<std::string>& runs) {
  const std::set<fs::path> all(runs.begin(), runs.end());
  for (std::size_t parts = 1;; ++parts) {
    std::vector<std::string> labels;
    bool numbers = false;
    for (const std::string& run : runs) {
      labels.push_back(tail_of(run, parts));
      numbers = numbers || is_number(labels.back());
    }
    const std::set<std::string> different(labels.begin(), labels.end());
    if ((different.size() == all.size() && (!numbers || parts > 1)) || parts > 8) return labels;
  }
}

// What was run, as the folder or the log itself says.
config::Node resolved_of(const RecordedRun& run) {
  if (fs::exists(run.resolved)) return config::parse_file(run.resolved.string());
  for (const auto& [key, value] : log::read_metadata(run.log))
    if (key == "resolved") return config::parse_text(value, run.log.string() + ": resolved");
  config::fail({run.log.string(), 0, 0}, "", "a log that does not say what was run",
               "resolved.toml beside it, or its text in the log", "sinew import");
}

report::RecordedRun recorded(const std::string& named, std::string label,
                             const Messages& messages) {
  const RecordedRun run = recorded_run(named);
  require_finished(run.log);
  report::RecordedRun out{std::move(label), log::read(run.log), resolved_of(run)};
  if (!out.logged.complete)
    messages.warning(run.log.string() + " was cut off or is damaged; compared as far as it goes");
  return out;
}

void keep_chosen(report::Comparison& comparison, const std::vector<std::string>& patterns) {
  if (patterns.empty()) return;
  std::vector<std::string_view> names;
  for (const report::ChannelRow& row : comparison.channels) names.push_back(row.channel.topic);
  const std::vector<bool> chosen = experiment::select(patterns, names, {"--channels", 0, 0});
  std::set<std::string> topics;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (chosen[i]) topics.emplace(names[i]);
  keep(comparison, topics);
}

ExitCode compare_runs(const Options& options) {
  const Messages messages(options.quiet);
  if (!options.out.empty()) {
    report::require_page(options.out);
    std::vector<fs::path> inputs;
    for (const std::string& named : options.runs) {
      const RecordedRun run = recorded_run(named);
      inputs.insert(inputs.end(), {run.log, run.resolved});
    }
    refuse_to_overwrite(options.out, options.force, inputs);
  }
  const std::vector<std::string> labels = labels_of(options.runs);
  std::vector<report::RecordedRun> runs;
  for (std::size_t i = 0; i < options.runs.size(); ++i)
    runs.push_back(recorded(options.runs[i], labels[i], messages));
  report::Comparison comparison = compare(
      std::move(runs), options.align == "start" ? report::Align::start : report::Align::sequence);
  keep_chosen(comparison, options.channels);

  if (options.json)
    fmt::print("{}", to_json(comparison));
  else
    print_comparison(comparison, options.units == "si" ? ShownUnits::si : ShownUnits::thesis,
                     options.all);
  if (options.out.empty()) return ok;
  const std::string page = report::page(comparison);
  write_file(options.out, page);
  messages.note(fmt::format("{}, {:.1f} MB", options.out, 1e-6 * static_cast<double>(page.size())));
  return ok;
}

}  // namespace

std::string letter_of(std::size_t run) { return {static_cast<char>('A' + run)}; }

void add_compare(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub =
      subcommand(app, "compare", "runs beside each other: figures, parameters, channels",
                 "sinew compare runs/walk-test-1/1 runs/walk-test-2/1 -o compare.html");
  sub.add_option("RUN", options->runs, "folders of runs, or log files; the first is compared with")
      ->required()
      ->expected(2, most_runs)
      ->option_text("2 to 8, REQUIRED");
  sub.add_option("-o,--output", options->out, "also write a page with overlaid plots");
  sub.add_option("--align", options->align,
                 "where times are counted from: start, or sequence: its first phase")
      ->check(CLI::IsMember({"start", "sequence"}));
  sub.add_option("--channels", options->channels, "only these: '/joint/*/angle'")
      ->expected(1, CLI::detail::expected_max_vector_size);
  sub.add_option("--units", options->units, "of the tables: thesis or si; --json is in SI")
      ->check(CLI::IsMember({"thesis", "si"}));
  sub.add_flag("--all", options->all, "every figure and channel, equal ones too");
  sub.add_flag("--json", options->json, "all of it as JSON");
  sub.add_flag("--force", options->force, "replace the page");
  sub.add_flag("--quiet", options->quiet, "only errors on stderr");
  sub.callback([=, &action] { action = [=] { return compare_runs(*options); }; });
}

}  // namespace sinew::cli
