// cli/runs.cpp - commands that make a run or evaluate one: run, view, replay, import and analyze.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/config/text_file.h"
#include "sinew/live/live_run.h"
#include "sinew/live/served.h"
#include "sinew/log/reader.h"
#include "sinew/recording/number.h"
#include "sinew/report/page/content.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/imported_run.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/replayed.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_log.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/run/folder/verdict_text.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/units/shown.h"
#include "thesis/out_dat/out_dat.h"

namespace sinew::cli {

namespace {

// Prints the title, and what the source reports with the results: in the source's own units, or in
// those of `shown`; without reports the main results.
void print_verdicts(const analysis::Summary& summary, const analysis::Machine& machine,
                    const units::ShownUnits* shown = nullptr) {
  fmt::print("{}",
             run::verdicts_text(summary, machine, shown, {width_of_output(), output_has_color()}));
}

// --- run ---

struct RunCommandOptions : Flags {
  run::RunRequest run;
  double pace = 0;  // simulated seconds per second of wall time; 0: no limit
};

// Prints verdicts or summary.json to stdout, and the place of the run, after `done`, to stderr.
void print_stored(const run::StoredRun& kept, bool json, const units::ShownUnits* shown,
                  const std::string& done, const Messages& messages) {
  if (json)
    fmt::print("{}", kept.json);
  else
    print_verdicts(kept.summary, kept.machine, shown);
  messages.note((json ? "" : done) + kept.folder.string());
  if (kept.page)
    messages.note(fmt::format("to see it, open {}", (kept.folder / run::report_name).string()));
}

void report_run(const run::StoredRun& kept, const RunCommandOptions& options,
                const Messages& messages) {
  const config::UnitsToShow units =
      chosen_units(options.run.units, units::UnitSet::si, kept.folder / run::resolved_name);
  print_stored(kept, options.json, units.requested(),
               fmt::format("{:.2f} s in {:.3f} s, kept in ", kept.duration, kept.wall), messages);
}

// Runs the experiment, with its log where there is one.
run::Outcome run_logged(const RunCommandOptions& options, run::RunStorage& kept,
                        Interrupt& interrupt) {
  std::atomic<std::int64_t> tick{0};
  run::RunOptions run_options{.pace = options.pace, .progress = &tick};
  kept.apply(run_options);
  std::optional<SpaceBar> space_bar;
  if (run::is_outside_simulation(options.run.port)) space_bar.emplace([&] { interrupt.request(); });
  if (space_bar && space_bar->listens() && !options.quiet)
    fmt::print(stderr, "the space bar stops the machine\n");
  const ProgressBar bar(tick, experiment::last_tick(kept.experiment()),
                        Steps{signals::tick_seconds, "s", 1}, options.quiet);
  return run::run(kept.experiment(), run_options);
}

ExitCode run_experiment(const RunCommandOptions& options) {
  const Messages messages(options.quiet);
  if (options.pace > 0 && run::has_own_clock(options.run.port))
    config::fail({options.run.experiment, 0, 0}, "--pace", fmt::format("{}", options.pace),
                 "no pace: the machine keeps its own time");
  // It begins before a board is opened and ends when the machine rests.
  Interrupt interrupt(run::is_outside_simulation(options.run.port) ? Interrupt::Of::machine
                                                                   : Interrupt::Of::work);
  run::RunRequest request = options.run;
  request.stop = &interrupt.requested();
  run::RunStorage kept(request, messages.notices());
  report_run(kept.store(run_logged(options, kept, interrupt)), options, messages);
  return ok;
}

// Returns what is wrong with a pace, "" for nothing. No clock can wait for a slower one.
std::string a_pace(const std::string& text) {
  constexpr double slowest = 1e-3;
  const double value = recording::number_in(text).value_or(-1);
  if (value == 0 || (value >= slowest && std::isfinite(value))) return "";
  return fmt::format("found \"{}\"; expected 0, or a number from {} on", text, slowest);
}

// Adds --output, --force and --set of a command that makes a run of an experiment.
template <class Request>
void add_folder(CLI::App& sub, Request& request) {
  sub.add_option("-o,--output", request.folder, "DIR: folder; default: next runs/<experiment>/<n>");
  sub.add_flag("--force", request.force, "replace an existing run");
  add_sets(sub, request.sets);
}

void add_run_options(CLI::App& sub, const std::string& port, RunCommandOptions& options) {
  run::RunRequest& request = options.run;
  sub.add_option(port, request.port,
                 "PLACE: what to run on: simulated, serial:DEVICE[@RATE], emulated:FILE, "
                 "lock-step:FILE or comedi:DEVICE; default: simulated")
      ->transform(passes(run::problem_of_place));
  sub.add_flag("--clear-fault", request.clear_fault,
               "clear the board's watchdog or memory fault; find the cause first");
  add_folder(sub, request);
  sub.add_flag("--allow-unreachable", request.allow_unreachable,
               "aim at the nearest reachable point where the foot path is out of reach");
  sub.add_flag("!--no-report", request.report, "write no report.html");
  add_units(sub, request.units, "printed numbers and of the page; --json is in SI");
  add_flags(sub, options, "", "print summary.json in place of the results");
}

// --- view ---

struct ViewOptions {
  std::vector<std::string> what;  // recorded: a run, a study or two
  std::string machine;
  RunCommandOptions live;   // .run.experiment empty: a recorded one
  std::optional<int> port;  // 0: a free one
  bool open = true, once = false, paused = false;
};

// Returns the requested port, or else that of the current folder: there a browser finds the page as
// the reader arranged it the last time.
live::Port port_of(const ViewOptions& o) {
  if (o.port) return {.number = static_cast<std::uint16_t>(*o.port)};
  return live::folder_port(std::filesystem::current_path());
}

ExitCode view_recorded(const ViewOptions& o) {
  const Messages messages(o.live.quiet);
  const live::Served served = live::served(o.what, o.machine, messages.notices());
  live::Server server(port_of(o), {.get = served.get});
  fmt::print("{}\n", server.url());
  std::fflush(stdout);
  messages.note(served.description(server.url()));
  const live::Browser browser(o.open ? server.url() : "");
  server.run();
  return ok;
}

// A run while it goes. Ends with it, or stays with its page until Ctrl-C.
ExitCode view_live(const ViewOptions& o) {
  const Messages messages(o.live.quiet);
  live::LiveRun run(o.live.run,
                    {.port = port_of(o),
                     .pace = o.live.pace,
                     .paused = o.paused,
                     .once = o.once,
                     .kept =
                         [&](const auto& kept) {
                           report_run(kept, o.live, messages);
                           std::fflush(stdout);
                         }},
                    messages.notices());
  if (o.live.json)
    messages.note(run.url());
  else
    fmt::print("{}\n", run.url());
  std::fflush(stdout);
  const live::Browser browser(o.open ? run.url() : "");
  std::optional<SpaceBar> space_bar;
  if (run.machine()) space_bar.emplace([&] { run.stop(); });
  if (space_bar && space_bar->listens()) messages.note("the space bar stops the machine");
  run.go();
  return ok;
}

ExitCode view(const ViewOptions& o) {
  return o.live.run.experiment.empty() ? view_recorded(o) : view_live(o);
}

// --- replay ---

struct ReplayOptions : Flags {
  run::ReplayRequest request;
  std::string of = "controller", folder, units;
  double band = 5;  // [%]
};

ExitCode replay_run(const ReplayOptions& given) {
  ReplayOptions options = given;
  const Messages messages(options.quiet);
  options.request.of = options.of == "plant" ? run::ReplayOf::plant : run::ReplayOf::controller;
  options.request.band = 0.01 * options.band;
  if (!options.folder.empty()) options.request.folder = options.folder;
  const run::Replayed replayed = run::replay_run(options.request, messages.notices());
  if (options.json)
    fmt::print("{}", to_json(replayed));
  else
    fmt::print("{}", text_of(replayed, chosen_units(options.units, units::UnitSet::thesis).units,
                             width_of_output()));
  if (replayed.folder) messages.note(replayed.folder->string());
  // A plant that parts from a measurement is a result; a controller that does is a change.
  const bool bad =
      replayed.of == run::ReplayOf::controller ? !replayed.agrees() : !replayed.cause.empty();
  return bad ? failed : ok;
}

// --- import ---

struct ImportOptions : Flags {
  run::ImportRequest request;
  TableOptions table;
  std::vector<std::string> scales, shifts;  // "name=value"
  std::string join = "side";
};

void take_pairs(ImportOptions& options) {
  recording::Mapping& mapping = options.request.mapping;
  mapping.table.columns = config::at_commas(options.table.columns);
  mapping.clock.rate = options.table.rate;
  options.request.values = options.table.values;
  const TableOptions& table = options.table;
  for (const auto& [name, value] :
       pairs_of("--map", table.maps, Equals::first, "CHANNEL=COLUMN, /joint/elbow/angle=Winkel"))
    map_channel(mapping, name, value);
  for (const auto& [name, value] :
       pairs_of("--unit", table.units, Equals::last, "COLUMN=UNIT, Winkel=deg"))
    map_unit(mapping, name, value);
  for (const auto& [name, value] :
       pairs_of("--scale", options.scales, Equals::last, "COLUMN=NUMBER, Winkel=-1")) {
    const auto number = recording::number_in(value);
    if (!number) config::fail({"--scale", 0, 0}, "", config::in_quotes(value), "a number");
    map_scale(mapping, name, *number);
  }
  for (const auto& [name, value] :
       pairs_of("--offset", table.offsets, Equals::last, "COLUMN=VALUE, \"Winkel=90 deg\""))
    map_offset(mapping, name, value);
  for (const auto& [name, value] :
       pairs_of("--where", table.where, Equals::first, "COLUMN=VALUE, test=3"))
    map_where(mapping, name, value);
  for (const auto& [name, value] :
       pairs_of("--shift", options.shifts, Equals::last, "FILE=TIME, \"force.csv=0.12 s\""))
    options.request.shifts[name] = value;
}

// Imports the thesis's own log, whose columns are fixed.
run::StoredRun import_out_dat(const ImportOptions& options, const Messages& messages) {
  const run::ImportRequest& request = options.request;
  const std::string& path = request.files.front();
  if (request.files.size() > 1)
    config::fail({path, 0, 0}, "", "out.dat together with other files", "out.dat alone",
                 "an import of each");
  const experiment::Experiment e =
      run::buildable_robot(config::compose(request.experiment, request.sets), request.experiment);
  const signals::Table table =
      thesis::parse_out_dat(config::read_text_file(path, "a log out.dat"), path, e);
  experiment::ImportedFile file = run::imported_file(path, "out.dat");
  for (const signals::Series& s : table.series) {
    file.rows = std::max(file.rows, static_cast<int>(s.time_ns.size()));
    file.values += static_cast<int>(s.time_ns.size());
  }
  return run::store_imported(table, e, {std::move(file)}, "",
                             {.folder = request.folder, .force = request.force},
                             messages.notices());
}

ExitCode report_import(const run::StoredRun& kept, const ImportOptions& options,
                       const Messages& messages) {
  for (const std::string& text : kept.summary.warnings) messages.warning(text);
  print_stored(kept, options.json, nullptr, "", messages);
  return ok;
}

// Returns the size of one recording; 0 for several.
std::int64_t bytes_of(const std::vector<std::string>& files) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(files.front(), none);
  return files.size() > 1 || none ? 0 : static_cast<std::int64_t>(size);
}

ExitCode import_recording(const ImportOptions& given) {
  ImportOptions options = given;
  const Messages messages(options.quiet);
  take_pairs(options);
  options.request.join_at_end = options.join == "end";
  if (thesis::is_out_dat(options.request.files.front()))
    return report_import(import_out_dat(options, messages), options, messages);
  std::atomic<std::int64_t> read{0};
  options.request.read = &read;
  const ProgressBar bar(read, bytes_of(options.request.files),
                        {.each = 1e-6, .unit = "MB", .decimals = 0}, options.quiet);
  return report_import(run::import_run(options.request, messages.notices()), options, messages);
}

void add_mapping_options(CLI::App& sub, ImportOptions& options) {
  run::ImportRequest& request = options.request;
  add_table_options(sub, options.table, request.mapping.table);
  add_words(sub, "--scale", options.scales,
            "COLUMN=NUMBER: factor of a column, applied before --offset; -1 turns the sign");
  sub.add_option("--mapping", request.mapping_file,
                 "FILE: file with options for columns, clock and tables, sinew.mapping/1");
  sub.add_option("--save-mapping", request.save_mapping, "FILE: write the options to such a file");
  sub.add_flag("--all", request.mapping.keep_others, "keep other columns, too, as /recorded/NAME");
}

void add_clock_options(CLI::App& sub, ImportOptions& options) {
  recording::ClockMapping& clock = options.request.mapping.clock;
  sub.add_option("--time", clock.column, "COLUMN: column of the times; default: time, t or such");
  sub.add_option("--time-unit", clock.unit, "UNIT: unit of the times, such as ms");
  sub.add_option("--clock-scale", clock.scale, "true seconds per recorded second; default: 1");
  sub.add_option("--start", clock.start,
                 "TIME: recorded time that becomes 0, \"12.5 s\"; default: the first sample");
  sub.add_option("--join", options.join,
                 "how several files are joined, side by side in time or end to end; default: side")
      ->check(one_of({"side", "end"}));
  add_words(sub, "--shift", options.shifts, "FILE=TIME: time to add to the times of a file");
}

// --- analyze ---

struct AnalyzeOptions : Flags {
  std::string run, machine, out, units;
  bool verdicts = false;
};

ExitCode analyze_run(const AnalyzeOptions& options) {
  const Messages messages(options.quiet);
  const run::RunFiles run = run::run_files(options.run);
  run::require_finished(run.log);
  const config::Node file = config::compose(run::machine_of(run, options.machine).string());
  const signals::Table table = log::read(run.log);
  if (!table.complete)
    messages.warning(
        run.log.string() +
        " was cut off or is damaged; the numbers are of what stands before, without verdicts");

  const config::UnitsToShow units = chosen_units(options.units, units::UnitSet::si, &file);
  analysis::Machine machine = analysis::read_machine(file);
  // The source reports whole runs, so a part of a run has no verdict.
  if (!table.complete) machine.reported.clear();
  const analysis::Analysis a(table, std::move(machine));
  for (const std::string& text : a.summary.warnings) messages.warning(text);
  const std::string json = to_json(a.summary);
  if (!options.out.empty()) {
    run::refuse_to_overwrite(options.out, options.force, run::summary_kind,
                             {run.log, options.machine});
    run::write_file(options.out, json);
  }
  if (options.verdicts)
    fmt::print("{}\n", report::to_json(a.verdicts).text());
  else if (options.json)
    fmt::print("{}", json);
  else
    print_verdicts(a.summary, a.machine, units.requested());
  return ok;
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  CLI::App& sub =
      subcommand(app, "run", "Run an experiment and keep its log and numbers in a new folder",
                 "sinew run experiments/walk-test-1.toml --set \"trolley.drag=0 lbf\"");
  RunCommandOptions& options = runs(sub, action, run_experiment);
  sub.add_option("EXPERIMENT", options.run.experiment, "experiment file")->required();
  add_run_options(sub, "--port", options);
  sub.add_option("--pace", options.pace, "simulated seconds per real second; default: 0, no limit")
      ->transform(passes(a_pace));
}

void add_view(CLI::App& app, Action& action) {
  CLI::App& sub =
      subcommand(app, "view", "Show a run or a study in the browser, recorded or while it runs",
                 "sinew view --live experiments/tune-in-air.toml");
  ViewOptions& options = runs(sub, action, view);
  CLI::Option* dir = sub.add_option("DIR", options.what,
                                    "run folder, folder of runs, log file, or one or two study "
                                    "files; default: the newest run in runs/");
  add_machine(sub, options.machine);
  CLI::Option* live =
      sub.add_option("--live", options.live.run.experiment, "FILE: experiment to run and show");
  live->excludes(dir);
  sub.add_option("--port", options.port,
                 "port on 127.0.0.1, 0 for a free one; default: the same one for this folder")
      ->transform(between(0, 65535));
  sub.add_flag("!--no-open", options.open, "print the address and open no browser");
  options.live.pace = 1;
  sub.add_option("--pace", options.live.pace,
                 "simulated seconds per real second, 0 for no limit; default: 1")
      ->transform(passes(a_pace))
      ->needs(live);
  sub.add_flag("--paused", options.paused, "begin when the page's button is pressed")->needs(live);
  sub.add_flag("--once", options.once, "exit when the run ends")->needs(live);
  add_run_options(sub, "--place", options.live);
  for (const char* of_a_run : {"--place", "--clear-fault", "--output", "--force", "--set",
                               "--allow-unreachable", "--no-report", "--units", "--json"})
    sub.get_option(of_a_run)->needs(live);
}

void add_replay(CLI::App& app, Action& action) {
  CLI::App& sub =
      subcommand(app, "replay", "Replay a recording with the present controller or plant",
                 "sinew replay runs/walk-test-1/1 --of plant -o runs/replayed");
  ReplayOptions& options = runs(sub, action, replay_run);
  sub.add_option("DIR", options.request.run, "run folder or log file")->required();
  sub.add_option(
         "--of", options.of,
         "part that runs again: the controller, with the recorded readings, or the plant, with the "
         "recorded valve commands; default: controller")
      ->check(one_of({"controller", "plant"}));
  add_machine(sub, options.request.machine);
  add_sets(sub, options.request.sets);
  sub.add_option("--band", options.band, "for plant: tolerance [% of channel range]; default: 5");
  sub.add_option("-o,--output", options.folder, "DIR: keep the replay in this folder, as a run");
  sub.add_flag("--force", options.request.force, "replace an existing run");
  add_units(sub, options.units, "the table; --json is in SI");
  add_flags(sub, options, "", "print the result as JSON");
}

void add_import(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(
      app, "import", "Import a recording of a laboratory as a run folder",
      "sinew import rig.csv --experiment one-joint.toml --map /joint/elbow/angle=Winkel");
  ImportOptions& options = runs(sub, action, import_recording);
  run::ImportRequest& request = options.request;
  sub.add_option("FILE", request.files,
                 "table as CSV, log as MCAP, .mat of MATLAB, or the thesis's out.dat")
      ->required();
  sub.add_option("--experiment", request.experiment, "FILE: experiment with machine and phases")
      ->required();
  add_mapping_options(sub, options);
  add_clock_options(sub, options);
  add_folder(sub, request);
  add_flags(sub, options, "", "print summary.json");
}

void add_analyze(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "analyze", "Compute a run's numbers and check the reported ones",
                             "sinew analyze runs/walk-test-1/1 --json");
  AnalyzeOptions& options = runs(sub, action, analyze_run);
  sub.add_option("DIR", options.run, "run folder or log file")->required();
  add_machine(sub, options.machine);
  sub.add_option("-o,--output", options.out, "FILE: also write the summary to this file");
  add_flags(sub, options, "replace an existing file", "print the summary as JSON");
  sub.add_flag("--verdicts", options.verdicts, "print reported values with verdicts, as JSON")
      ->excludes(sub.get_option("--json"));
  add_units(sub, options.units, "printed numbers (default: the source's own); --json is in SI");
}

}  // namespace sinew::cli
