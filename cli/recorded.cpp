// cli/recorded.cpp - pages, comparisons, tables and films of recorded runs: report, compare, export
// and film.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/option_groups.h"
#include "cli/terminal.h"
#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/machine.h"
#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/config/shipped.h"
#include "sinew/experiment/globs.h"
#include "sinew/host/module.h"
#include "sinew/log/csv.h"
#include "sinew/log/reader.h"
#include "sinew/report/compare/comparison.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/page.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/tune/page/study_view.h"
#include "thesis/out_dat/out_dat.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

// --- alignment of runs with the first one ---

constexpr int most_runs = 8;  // as many colors are distinct

// The options as they are given.
struct Alignment {
  std::string align = "start", clock = "none";
  report::AlignOptions options;

  report::AlignOptions align_options() const;
  std::string given() const;  // the setting of one that was given, "align_by"; "" for none
};

report::AlignOptions Alignment::align_options() const {
  report::AlignOptions out = options;
  out.fit_clock = clock == "fit";
  for (const auto by : {report::Align::sequence, report::Align::event, report::Align::correlation})
    if (to_text(by) == align) out.by = by;
  // An event or channels choose the way of alignment.
  if (!out.event.empty()) out.by = report::Align::event;
  if (!out.channels.empty() && out.by == report::Align::start) out.by = report::Align::correlation;
  return out;
}

std::string Alignment::given() const {
  if (align != "start") return "align";
  if (!options.event.empty()) return "event";
  if (!options.channels.empty()) return "align_by";
  if (clock != "none") return "clock";
  return options.largest_shift < std::numeric_limits<double>::infinity() ? "within" : "";
}

void add_alignment(CLI::App& sub, Alignment& alignment) {
  sub.add_option("--align", alignment.align, "how to align others with the first (default: start)")
      ->check(one_of({"start", "sequence", "event", "correlation"}));
  sub.add_option(
      "--event", alignment.options.event,
      "EVENT: for --align event: \"/joint/elbow/angle > 10 deg\"; default: first clear motion");
  sub.add_option("--align-by", alignment.options.channels,
                 "CHANNEL: channels to correlate; default: chosen automatically")
      ->expected(1, CLI::detail::expected_max_vector_size);
  sub.add_option("--clock", alignment.clock,
                 "fit: also correct the clock rates of the other runs; default: none")
      ->check(one_of({"none", "fit"}));
  sub.add_option("--within", alignment.options.largest_shift,
                 "largest shift [s]; default: no limit");
}

// --- report ---

struct ReportOptions : Flags {
  std::vector<std::string> runs;
  std::string machine, out, units;
};

ExitCode write(const fs::path& out, const std::string& page, const Messages& messages) {
  run::write_file(out, page);
  messages.note(
      fmt::format("{}, {:.1f} MB", out.string(), 1e-6 * static_cast<double>(page.size())));
  return ok;
}

ExitCode report_study(const ReportOptions& options) {
  fs::path out = options.out;
  if (out.empty()) out = fs::path(options.runs[0]).replace_extension(".html");
  const std::vector<fs::path> files(options.runs.begin(), options.runs.end());
  constexpr run::FileKind kind{"page of studies", "such a page", "\"sinew.study_page/"};
  run::refuse_to_overwrite(out, options.force, kind, files);
  return write(out, tune::study_page_of(files), Messages(options.quiet));
}

ExitCode report_run(const ReportOptions& options) {
  const Messages messages(options.quiet);
  const run::RunFiles recorded = run::run_files(options.runs[0]);
  const fs::path out =
      options.out.empty() ? recorded.log.parent_path() / run::report_name : fs::path(options.out);
  run::refuse_to_overwrite(out, options.force, run::report_kind,
                           {recorded.log, recorded.resolved, options.machine});
  return write(out, run::page_of(recorded, options.machine, messages.notices(), options.units),
               messages);
}

// --- compare ---

struct CompareOptions : Flags {
  std::vector<std::string> runs, channels;
  Alignment alignment;
  std::string out, residuals, units;
  bool all = false;
};

constexpr run::FileKind comparison_page{"page of `sinew compare`", "such a page",
                                        "\"sinew.comparison/"};
constexpr run::FileKind residual_table{"table of residuals", "such a table", " /",
                                       run::FileKind::At::first_line};

// Refuses to replace a file without --force, and a run that is read.
void refuse_outputs(const CompareOptions& options) {
  if (!options.out.empty()) report::require_page(options.out);
  std::vector<fs::path> inputs;
  for (const std::string& named : options.runs) {
    const run::RunFiles run = run::run_files(named);
    inputs.insert(inputs.end(), {run.log, run.resolved});
  }
  run::refuse_same_files({{"--output", options.out}, {"--residuals", options.residuals}});
  if (!options.out.empty())
    run::refuse_to_overwrite(options.out, options.force, comparison_page, inputs);
  if (!options.residuals.empty())
    run::refuse_to_overwrite(options.residuals, options.force, residual_table, inputs);
}

ExitCode compare_runs(const CompareOptions& options) {
  const Messages messages(options.quiet);
  refuse_outputs(options);
  const report::Comparison comparison = run::compare_runs(
      options.runs, options.alignment.align_options(), options.channels, messages.notices());

  // Files come before what is printed: a reader that ends early, such as head, ends the
  // program.
  if (!options.residuals.empty()) {
    run::write_file(options.residuals, report::residuals_csv(comparison));
    messages.note(options.residuals);
  }
  const fs::path first = run::run_files(options.runs.front()).resolved;
  const auto units = [&](units::UnitSet otherwise) {
    return chosen_units(options.units, otherwise, first).units;
  };
  if (!options.out.empty())
    write(options.out, report::page(comparison, units(units::UnitSet::si)), messages);
  if (options.json)
    fmt::print("{}", to_json(comparison));
  else
    fmt::print("{}", text_of(comparison, {.units = units(units::UnitSet::thesis),
                                          .all = options.all,
                                          .width = width_of_output(),
                                          .see_all = "--all",
                                          .fit_clock = "--clock fit",
                                          .color = output_has_color()}));
  return ok;
}

// --- export ---

struct ExportOptions : Flags {
  std::string run, out, machine;
  std::string format = "csv";
  std::vector<std::string> channels;
  bool csv = false, derived = false;
};

// Writes line by line, since the text of a long run is longer than memory.
void put_csv(const run::RunFiles& run, const ExportOptions& options, signals::Table table) {
  if (options.derived) {
    const config::Node root = config::compose(run::machine_of(run, options.machine).string());
    signals::Table derived = analysis::derive(table, analysis::read_machine(root));
    for (signals::Series& s : derived.series) table.series.push_back(std::move(s));
  }
  const std::vector<std::string> topics =
      experiment::select(options.channels, experiment::names_of(table), {"--channels", 0, 0});
  if (!options.out.empty()) {
    run::require_folder_of(options.out);
    return log::write_csv(table, options.out, topics);
  }
  log::write_csv(table, std::cout, topics);
  std::cout.flush();
}

void put(const run::RunFiles& run, const ExportOptions& options, signals::Table table) {
  if (options.format == "csv") return put_csv(run, options, std::move(table));
  const std::string file = run::machine_of(run, options.machine).string();
  const experiment::Experiment e = run::buildable_robot(config::compose(file), file);
  const std::string text =
      options.format == "ports" ? thesis::write_ports(table, e) : thesis::write_out_dat(table, e);
  if (!options.out.empty()) return run::write_file(options.out, text);
  fmt::print("{}", text);
}

// Returns the kind of file that is written.
run::FileKind kind_of(const ExportOptions& options) {
  if (options.format == "out.dat")
    return {"out.dat", "an out.dat", "modetimer", run::FileKind::At::start};
  if (options.format == "ports")
    return {"table of ports", "such a table", "port0[1]", run::FileKind::At::first_line};
  return {"table of channels", "such a table", "time[s],/", run::FileKind::At::start};
}

ExitCode export_run(const ExportOptions& options) {
  const Messages messages(options.quiet);
  if (options.format != "csv" && (!options.channels.empty() || options.derived))
    config::fail({"--format", 0, 0}, "", config::in_quotes(options.format),
                 "csv, for --channels and --derived");
  const run::RunFiles run = run::run_files(options.run);
  if (!options.out.empty())
    run::refuse_to_overwrite(options.out, options.force, kind_of(options),
                             {run.log, run.resolved, options.machine});

  signals::Table table = log::read(run.log);
  if (!table.complete)
    messages.warning(
        fmt::format("{} was cut off; what stands before is exported", run.log.string()));
  put(run, options, std::move(table));
  if (!options.out.empty()) messages.note(options.out);
  return ok;
}

// --- film ---

// python/sinew/_film.py checks the options and makes the film.
struct FilmOptions : Flags {
  std::vector<std::string> runs;
  Alignment alignment;
  std::string machine, out, from, to;
  double speed = 1;
  int width = 880, height = 470, fps = 25;
  bool dark = false, still = false;
};

std::vector<std::string> film_arguments(const FilmOptions& o) {
  const fs::path script = config::shipped_folder() / "python/sinew/_film.py";
  std::vector<std::string> out{"python3", script.string()};
  const auto add = [&](const char* name, double value) {
    out.push_back(fmt::format("--{}={}", name, value));
  };
  if (!o.from.empty()) add("start", config::quantity_setting("from", o.from, "s"));
  if (!o.to.empty()) add("stop", config::quantity_setting("to", o.to, "s"));
  add("speed", o.speed);
  add("width", o.width);
  add("height", o.height);
  add("fps", o.fps);
  for (const auto& [name, is_set] :
       {std::pair{"--dark", o.dark}, {"--still", o.still}, {"--quiet", o.quiet}})
    if (is_set) out.emplace_back(name);
  out.insert(out.end(), {"--", o.out});
  out.insert(out.end(), o.runs.begin(), o.runs.end());
  return out;
}

ExitCode make(const FilmOptions& options) {
  const Messages messages(options.quiet);
  const bool several = options.runs.size() > 1;
  if (const std::string given = options.alignment.given(); !several && !given.empty())
    config::fail({given, 0, 0}, "", "one run",
                 "two runs or more, which are aligned with each other");
  if (several && !options.machine.empty())
    config::fail({"machine", 0, 0}, "", config::in_quotes(options.machine),
                 "no option: each of several runs has its own machine");
  std::vector<std::string> arguments = film_arguments(options);
  run::refuse_to_overwrite(options.out, options.force, run::film_kind(options.out));
  run::require_folder_of(options.out);
  // Reading a long log takes time, so the script first checks options and programs.
  constexpr const char* missing =
      "python3, which makes films, is not on the PATH; try apt-get install python3";
  arguments.insert(arguments.begin() + 2, "--check");
  if (const int code = host::exit_code_of(arguments, missing); code != 0)
    return static_cast<ExitCode>(code);
  arguments.erase(arguments.begin() + 2);
  host::continue_as(arguments, missing,
                    run::film_page(options.runs, options.alignment.align_options(), options.machine,
                                   messages.notices()));
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App& sub = subcommand(app, "report", "Write a run or a study as one page for any browser",
                             "sinew report runs/walk-test-1/1 -o walk.html");
  sub.add_option("DIR", options->runs, "run folder, log file, or one or two study files")
      ->required()
      ->expected(1, 2);
  sub.add_option(
      "-o,--output", options->out,
      "FILE: page to write; default: report.html in the log's folder, STUDY.html next to STUDY.db");
  add_machine(sub, options->machine);
  add_units(sub, options->units, "a run's page when it opens (default: as in the settings)");
  add_flags(sub, *options, "replace an existing file", "");
  sub.callback([=, &action] {
    const bool study = tune::is_study(options->runs.front());
    if (!study && options->runs.size() > 1)
      refuse("DIR", "two runs", "one run, or studies; sinew compare shows several runs together");
    if (study && !options->machine.empty())
      refuse("--machine", "a study to compare with", "a run: a study has no machine of its own");
    action = [=] { return study ? report_study(*options) : report_run(*options); };
  });
}

void add_compare(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(app, "compare", "Compare several runs: numbers, parameters, channels",
                             "sinew compare runs/walk-test-1/1 runs/walk-test-2/1 -o compare.html");
  CompareOptions& options = runs(sub, action, compare_runs);
  sub.add_option("RUN", options.runs, "run folders or log files; the first is the reference")
      ->required()
      ->expected(2, most_runs);
  sub.add_option("-o,--output", options.out, "FILE: also write a page with overlaid plots");
  sub.add_option("--residuals", options.residuals,
                 "FILE: also write the differences of each run as CSV, a column per channel");
  add_alignment(sub, options.alignment);
  sub.add_option("--channels", options.channels, "CHANNEL: only these, such as '/joint/*/angle'")
      ->expected(1, CLI::detail::expected_max_vector_size);
  add_units(sub, options.units, "the tables (default: thesis) and of the page; --json is in SI");
  sub.add_flag("--all", options.all, "print every figure and channel, equal ones too");
  add_flags(sub, options, "replace existing files", "print everything as JSON");
}

void add_export(CLI::App& app, Action& action) {
  CLI::App& sub = subcommand(
      app, "export", "Export a run's log as CSV, as the thesis's out.dat, or as bytes of its ports",
      "sinew export runs/walk-test-1/1 --csv -o walk.csv");
  ExportOptions& options = runs(sub, action, export_run);
  sub.add_option("DIR", options.run, "run folder or log file")->required();
  CLI::App& how = alternatives(sub, "format");
  how.add_option("--format", options.format,
                 "csv: time [s], then a column per channel; out.dat: the log of the thesis, B.1; "
                 "ports: bytes of the valves' ports")
      ->check(one_of({"csv", "out.dat", "ports"}));
  how.add_flag("--csv", options.csv, "same as --format csv");
  sub.add_option("-o,--output", options.out, "FILE: file to write; default: stdout");
  sub.add_option("--channels", options.channels, "CHANNEL: csv: only these; * matches anything");
  sub.add_flag("--derived", options.derived, "csv: also write what the analysis derives");
  add_machine(sub, options.machine);
  add_flags(sub, options, "replace an existing file", "");
}

void add_film(CLI::App& app, Action& action) {
  CLI::App& sub =
      subcommand(app, "film", "Film the replay of one run or several as GIF, MP4 or WebM",
                 "sinew film runs/walk-test-1/1 -o walk.gif --from \"2 s\" --to "
                 "\"5 s\"\n  sinew film runs/walk-test-1/1 -o walk.mp4 --speed 0.25\n  sinew film "
                 "runs/elbow/1 measured -o both.mp4 --align correlation --clock fit");
  FilmOptions& options = runs(sub, action, make);
  sub.add_option("RUN", options.runs, "run folders or log files; all but the first as ghosts")
      ->required()
      ->expected(1, most_runs);
  sub.add_option("-o,--output", options.out, "FILE: .gif, .mp4 or .webm file to write")->required();
  sub.add_option("--from", options.from, "TIME: begin in the run, \"2 s\"; default: its start");
  sub.add_option("--to", options.to, "TIME: end in the run, \"5 s\"; default: its end");
  sub.add_option("--speed", options.speed, "run seconds per film second")->capture_default_str();
  sub.add_option("--width", options.width, "width of the picture [pixels]")->capture_default_str();
  sub.add_option("--height", options.height, "height of the picture [pixels]")
      ->capture_default_str();
  sub.add_option("--fps", options.fps, "frames per second")->capture_default_str();
  sub.add_flag("--dark", options.dark, "draw light on dark");
  sub.add_flag("--still", options.still, "keep the camera still and show the whole way");
  add_alignment(sub, options.alignment);
  add_machine(sub, options.machine);
  add_flags(sub, options, "replace an existing file", "");
}

}  // namespace sinew::cli
