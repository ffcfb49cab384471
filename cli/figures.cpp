// cli/figures.cpp - `sinew figures`: figures for print, of runs, of muscles or of the thesis.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/terminal.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/host/module.h"
#include "sinew/json/json.h"
#include "sinew/report/figures/gallery.h"
#include "sinew/run/folder/drawn_run.h"
#include "sinew/run/folder/figure_files.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/units/constants.h"

namespace sinew::cli {

namespace {

namespace fs = std::filesystem;

struct FiguresOptions : Flags {
  std::vector<std::string> runs;  // folders, logs, or files of muscles
  std::string out;                // empty: figures/ in each run's folder
  run::DrawingRequest drawing;
  std::string from, to;                          // "2 s"; empty: all
  std::string width, height, font, labels_file;  // pictures
  std::vector<std::string> labels, formats;
  std::string align = "start", event, clock = "none";  // for runs in the same axes
  std::string root = ".";                              // thesis
  bool thesis = false, overlay = false, labels_template = false;

  bool overlaid() const { return overlay || !labels.empty() || align != "start"; }
};

// Returns the files of --format and --force; "csv" alone draws nothing.
run::FigureFiles files_of(const FiguresOptions& options) {
  run::FigureFiles out{.must_draw = !options.formats.empty(), .force = options.force};
  if (out.must_draw) out.pictures.clear();
  for (const std::string& list : options.formats)
    for (const std::string& word : config::at_commas(list)) {
      const std::optional<report::Picture> picture = report::picture_of(word);
      if (!picture && word != "csv")
        config::fail({"--format", 0, 0}, "", config::in_quotes(word), "pdf, svg, png or csv",
                     "--format pdf,png");
      if (picture && std::ranges::find(out.pictures, *picture) == out.pictures.end())
        out.pictures.push_back(*picture);
    }
  return out;
}

// These options are for runs alone.
void add_options_of_runs(CLI::App& sub, FiguresOptions& o, CLI::Option* thesis) {
  const auto add = [&](const char* name, auto& value, const char* text) {
    return sub.add_option(name, value, text)->excludes(thesis);
  };
  const auto add_flag = [&](const char* name, bool& value, const char* text) {
    sub.add_flag(name, value, text)->excludes(thesis);
  };
  add("--only", o.drawing.only, "NAME: for runs: draw only these figures");
  add("--channels", o.drawing.channels,
      "CHANNELS: for runs: draw a figure of these channels, \"/joint/*/angle,/muscle/*/tension\"; "
      "a comma begins a plot below")
      ->allow_extra_args(false);
  add_flag("--overlay", o.overlay, "draw all runs in the same axes; needs -o");
  add("--label", o.labels, "NAME: name of a run, in their order; draws them in the same axes")
      ->allow_extra_args(false);
  CLI::Option* align =
      add("--align", o.align, "how to align the other runs with the first; default: start")
          ->check(one_of({"start", "event", "correlation"}));
  add("--event", o.event, "EVENT: for event: '/joint/elbow/angle > 10 deg'; default: first motion")
      ->needs(align);
  add("--clock", o.clock, "fit: correct the clock rates of the other runs; default: none")
      ->check(one_of({"none", "fit"}))
      ->needs(align);
  add("--title", o.drawing.title, "TITLE: title above the picture, for a single figure");
  add("--width", o.width, "QUANTITY: width of the picture; default: 89 mm");
  add("--height", o.height, "QUANTITY: height of the picture; default: by the number of its plots");
  add("--font", o.font, "QUANTITY: size of the letters; default: 7 pt");
  add("--labels", o.labels_file, "FILE: labels in your language; see --labels-template");
  add_flag("--labels-template", o.labels_template, "print labels of these figures, for --labels");
  add("--units", o.drawing.units,
      "UNITS: for runs: si, thesis, metric, or metric,length=cm; default: as in the settings");
  add("--from", o.from, "TIME: for runs: draw from this time on, \"2 s\"");
  add("--to", o.to, "TIME: for runs: draw up to this time, \"5 s\"");
  add("--machine", o.drawing.machine, "FILE: for runs: machine; default: the run's resolved.toml");
}

// Returns nothing where the runs begin together.
std::optional<analysis::AlignRequest> align_of(const FiguresOptions& request) {
  if (request.align == "start") return std::nullopt;
  const bool event = request.align == "event";
  return analysis::AlignRequest{
      .by = event ? analysis::AlignBy::event : analysis::AlignBy::correlation,
      .event = request.event,
      .fit_clock = request.clock == "fit"};
}

run::DrawingRequest drawing_of(const FiguresOptions& options) {
  run::DrawingRequest out = options.drawing;
  const auto time = [](const char* name, const std::string& text, double& value) {
    if (!text.empty()) value = config::quantity_setting(name, text, "s", units::atmosphere);
  };
  time("from", options.from, out.options.from);
  time("to", options.to, out.options.to);
  if (out.options.from >= out.options.to)
    config::fail({"--from", 0, 0}, "", options.from,
                 fmt::format("a time before --to, {}", options.to));
  out.paper = report::read_paper(options.width, options.height, options.font);
  out.files = files_of(options);
  if (!options.labels_file.empty()) out.files.labels = report::read_labels(options.labels_file);
  return out;
}

// Returns the run's own folder, or one below --output where there are several runs.
fs::path folder_of(const FiguresOptions& request, const std::string& named) {
  const fs::path source = run::is_muscle_file(named) ? fs::path(named) : run::run_files(named).log;
  if (request.out.empty()) return source.parent_path() / run::figures_name;
  if (request.runs.size() == 1) return request.out;
  return fs::path(request.out) / report::file_name_of(named);
}

// Returns each folder with the name of its run.
std::vector<std::pair<fs::path, std::string>> folders_of(const FiguresOptions& request) {
  std::vector<std::pair<fs::path, std::string>> out;
  for (const std::string& named : request.runs) {
    const fs::path folder = folder_of(request, named);
    for (const auto& [taken, other] : out)
      if (taken == folder)
        config::fail({named, 0, 0}, "", "the same run, or one of the same name, a second time",
                     "each run once", "without -o");
    out.emplace_back(folder, named);
  }
  return out;
}

ExitCode draw_runs(const FiguresOptions& request) {
  const Messages messages(request.quiet);
  const run::DrawingRequest drawing = drawing_of(request);
  if (request.labels_template) {
    fmt::print("{}", run::labels_of_runs({request.runs.begin(), request.runs.end()}, drawing));
    return ok;
  }
  Json out{{"format", "sinew.figures/1"}, {"runs", Json::array()}};
  const auto add = [&](const fs::path& folder, const std::string& index) {
    out["runs"].push_back(
        {{"folder", folder.string()}, {"figures", Json::parse(index)["figures"]}});
  };
  if (request.overlaid()) {
    const run::OverlaidRuns runs{
        {request.runs.begin(), request.runs.end()}, request.labels, align_of(request)};
    add(request.out, run::draw_runs(runs, request.out, drawing, messages.notices()));
  } else {
    for (const auto& [folder, named] : folders_of(request))
      add(folder, run::is_muscle_file(named)
                      ? run::draw_muscles(named, folder, drawing, messages.notices())
                      : run::draw_run(named, folder, drawing, messages.notices()));
  }
  if (request.json)
    fmt::print("{}\n", out.text(2));
  else
    for (const Json& run : out["runs"])
      fmt::print("{}\n{}", run["folder"].string(), report::text_of_figures(run["figures"]));
  return ok;
}

// Becomes the program thesis-figures (cli/thesis/figures.cpp).
ExitCode draw_thesis(const FiguresOptions& request) {
  const run::FigureFiles files = files_of(request);
  run::refuse_to_overwrite(std::filesystem::path(request.out) / "index.json", request.force,
                           run::figures_kind);
  const std::string program = host::find_module("thesis-figures").string();
  if (program.empty())
    throw std::runtime_error(
        "sinew figures --thesis: found no program thesis-figures next to this one; expected it in "
        "lib/sinew; try: cmake --preset release && cmake --build --preset all");

  const auto flag = [](bool set) { return set ? "yes" : "no"; };
  std::vector<std::string> words{program,
                                 request.root,
                                 request.out,
                                 flag(request.force),
                                 flag(files.must_draw),
                                 flag(request.json),
                                 flag(request.quiet)};
  for (const report::Picture picture : files.pictures) words.emplace_back(report::ending(picture));
  host::continue_as(words, program + ": cannot be started");
}

}  // namespace

void add_figures(CLI::App& app, Action& action) {
  auto options = std::make_shared<FiguresOptions>();
  CLI::App& sub = subcommand(
      app, "figures", "Draw figures of runs or of the thesis for print, each with its data as CSV",
      "sinew figures runs/walk-test-1/1 --format pdf --width \"84 mm\" --units metric\n"
      "  sinew figures mine runs/arm/1 --label measured --label simulated -o figures\n"
      "  sinew figures muscle.toml --format pdf\n"
      "  sinew figures --thesis -o figures");
  CLI::Option* runs =
      sub.add_option("DIR", options->runs, "run folders, log files or muscle files");
  CLI::Option* thesis = sub.add_flag("--thesis", options->thesis, "draw those of Colbrunn (2000)");
  runs->excludes(thesis);
  sub.add_option(
      "-o,--output", options->out,
      "DIR: folder for the figures and index.json; default for runs: figures/ in the log's folder");
  sub.add_option("--root", options->root, "DIR: parent of robots/, for --thesis; default: .");
  add_words(sub, "--format", options->formats, "FORMAT: pdf, svg, png or csv; default: svg,png");
  add_options_of_runs(sub, *options, thesis);
  add_flags(sub, *options, "replace existing figures",
            "print index.json; of several runs, each one");
  sub.callback([=, &action] {
    if (!options->thesis && options->runs.empty())
      require("DIR", "the folder of a run, or --thesis in its place");
    if (options->thesis && options->out.empty())
      require("--output", "the folder for the figures of --thesis");
    if (options->overlaid() && !options->labels_template && options->out.empty())
      require("--output", "a folder for the figures of --overlay, --label or --align");
    action = [=] { return options->thesis ? draw_thesis(*options) : draw_runs(*options); };
  });
}

}  // namespace sinew::cli
