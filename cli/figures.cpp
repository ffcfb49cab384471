// cli/figures.cpp - `sinew figures`: figures for print, of runs or of the thesis.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "cli/command.h"
#include "cli/figures_runs.h"
#include "cli/figures_thesis.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {
namespace {

struct FiguresOptions {
  RunFiguresRequest runs;
  ThesisFiguresRequest thesis;
  bool of_thesis = false;
};

std::vector<report::Picture> parse_formats(const std::vector<std::string>& words) {
  std::vector<report::Picture> out;
  for (const std::string& list : words) {
    std::istringstream in(list);
    for (std::string word; std::getline(in, word, ',');) {
      if (word == "csv") continue;
      const std::optional<report::Picture> picture = report::picture_of(word);
      if (!picture)
        config::fail({"--format", 0, 0}, "", fmt::format("\"{}\"", word), "pdf, svg, png or csv",
                     "--format pdf,png");
      if (std::ranges::find(out, *picture) == out.end()) out.push_back(*picture);
    }
  }
  return out;
}

ExitCode draw(FiguresOptions& options) {
  if (!options.of_thesis) return draw_runs(options.runs);
  options.thesis.out = options.runs.out;
  options.thesis.formats = options.runs.formats;
  options.thesis.force = options.runs.force;
  options.thesis.json = options.runs.json;
  options.thesis.quiet = options.runs.quiet;
  return draw_thesis(options.thesis);
}

}  // namespace

run::FigureFiles files_of(const std::vector<std::string>& formats, bool force) {
  run::FigureFiles files{.must_draw = !formats.empty(), .force = force};
  if (files.must_draw) files.pictures = parse_formats(formats);
  return files;
}

namespace {

// These options are for runs alone.
void add_run_options(CLI::App& sub, RunFiguresRequest& runs, CLI::Option* thesis) {
  const auto of_runs = [&](CLI::Option* option) { option->excludes(thesis); };
  of_runs(sub.add_option("--only", runs.only, "of runs: these figures alone"));
  of_runs(sub.add_option("--channels", runs.channels,
                         "of runs: a figure of these, \"/joint/*/angle,/muscle/*/tension\"; a "
                         "comma begins a plot below; may be repeated")
              ->allow_extra_args(false));
  of_runs(sub.add_flag("--overlay", runs.overlay, "the runs in the same axes; needs -o"));
  of_runs(sub.add_option("--label", runs.labels,
                         "what a run is called, in their order; the runs are in the same axes")
              ->allow_extra_args(false));
  CLI::Option* align =
      sub.add_option("--align", runs.align,
                     "how the others are aligned with the first run: start, event or "
                     "correlation; start")
          ->check(one_of({"start", "event", "correlation"}));
  of_runs(align);
  of_runs(sub.add_option("--event", runs.event,
                         "of --align event: '/joint/elbow/angle > 10 deg'; else the first motion")
              ->needs(align));
  of_runs(sub.add_option("--clock", runs.clock,
                         "fit: the rate of another run's clock is taken out, too; none")
              ->check(one_of({"none", "fit"}))
              ->needs(align));
  of_runs(sub.add_option("--title", runs.title, "above the picture, of one figure"));
  of_runs(sub.add_option("--width", runs.width, "of the picture; \"89 mm\""));
  of_runs(sub.add_option("--height", runs.height, "of the picture; else as its plots want"));
  of_runs(sub.add_option("--font", runs.font, "size of the letters; \"7 pt\""));
  of_runs(sub.add_option("--labels", runs.words, "a file with labels in your language"));
  of_runs(sub.add_flag("--labels-template", runs.labels_template,
                       "print such a file, with all that these figures say"));
  of_runs(sub.add_option("--units", runs.units,
                         "of runs: si, thesis, metric, or metric,length=cm; else as set"));
  of_runs(sub.add_option("--from", runs.from, "of runs: \"2 s\"; what was before is left out"));
  of_runs(sub.add_option("--to", runs.to, "of runs: what was after is left out"));
  of_runs(sub.add_option("--machine", runs.machine,
                         "of runs: what was run, in place of the folder's resolved.toml"));
}

}  // namespace

void add_figures(CLI::App& app, Action& action) {
  auto options = std::make_shared<FiguresOptions>();
  CLI::App& sub = subcommand(
      app, "figures", "figures for print, with the CSV behind each: of runs, or the thesis's",
      "sinew figures runs/walk-test-1/1 --format pdf --width \"84 mm\" --units metric\n"
      "  sinew figures mine runs/arm/1 --label measured --label simulated -o figures\n"
      "  sinew figures muscle.toml --format pdf\n"
      "  sinew figures --thesis -o figures");
  CLI::Option* runs =
      sub.add_option("DIR", options->runs.runs, "folders of runs, log files, or files of muscles");
  CLI::Option* thesis = sub.add_flag("--thesis", options->of_thesis, "those of Colbrunn (2000)");
  runs->excludes(thesis);
  sub.add_option("-o,--output", options->runs.out,
                 "folder for the figures and index.json; of runs: else figures/ beside the log");
  sub.add_option("--root", options->thesis.root,
                 "--thesis: the project's folder, with robots/ and experiments/; .");
  sub.add_option("--format", options->runs.formats, "pdf, svg, png or csv; svg,png")
      ->allow_extra_args(false);
  add_run_options(sub, options->runs, thesis);
  sub.add_flag("--force", options->runs.force, "replace the figures that are there");
  sub.add_flag("--json", options->runs.json, "print index.json; of runs all of them");
  sub.add_flag("--quiet", options->runs.quiet, "only errors on stderr");
  sub.callback([=, &action] {
    const RunFiguresRequest& of_runs = options->runs;
    if (!options->of_thesis && of_runs.runs.empty())
      require("DIR", "the folder of a run, or --thesis in its place");
    if (options->of_thesis && of_runs.out.empty())
      require("--output", "the folder for the figures of --thesis");
    if (of_runs.overlaid() && !of_runs.labels_template && of_runs.out.empty())
      require("--output", "a folder for the figures of --overlay, --label or --align");
    action = [=] { return draw(*options); };
  });
}

}  // namespace sinew::cli
