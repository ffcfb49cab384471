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

struct Options {
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
      if (word != "svg" && word != "png")
        config::fail({"--format", 0, 0}, "", fmt::format("\"{}\"", word), "svg, png or csv",
                     "--format svg,png");
      const auto picture = word == "svg" ? report::Picture::svg : report::Picture::png;
      if (std::ranges::find(out, picture) == out.end()) out.push_back(picture);
    }
  }
  return out;
}

ExitCode draw(Options& options) {
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

void add_figures(Command app, Action& action) {
  auto options = std::make_shared<Options>();
  Command sub = app.subcommand(
      "figures", "figures for print, with the CSV behind each: of runs, or the thesis's",
      "sinew figures runs/walk-test-1/1 --units thesis\n  sinew figures --thesis -o figures");
  Option runs = sub.add_option("DIR", options->runs.runs, "folders of runs, or log files");
  Option thesis = sub.add_flag("--thesis", options->of_thesis, "those of Colbrunn (2000)");
  runs.excludes(thesis);
  sub.add_option("-o,--output", options->runs.out,
                 "folder for the figures and index.json; of runs: else figures/ beside the log");
  sub.add_option("--root", options->thesis.root,
                 "--thesis: the project's folder, with robots/ and experiments/; .");
  sub.add_option("--format", options->runs.formats, "svg, png or csv; svg,png").takes_one();
  sub.add_option("--only", options->runs.only, "of runs: these figures alone").excludes(thesis);
  sub.add_option("--units", options->runs.units, "of runs: si or thesis (in, lbf, psi, deg); si")
      .is_one_of({"si", "thesis"})
      .excludes(thesis);
  sub.add_option("--from", options->runs.from, "of runs: \"2 s\"; what was before is left out")
      .excludes(thesis);
  sub.add_option("--to", options->runs.to, "of runs: what was after is left out").excludes(thesis);
  sub.add_option("--machine", options->runs.machine,
                 "of runs: what was run, in place of the folder's resolved.toml")
      .excludes(thesis);
  sub.add_flag("--force", options->runs.force, "replace the figures that are there");
  sub.add_flag("--json", options->runs.json, "print index.json; of runs all of them");
  sub.add_flag("--quiet", options->runs.quiet, "only errors on stderr");
  sub.callback([=, &action] {
    if (!options->of_thesis && options->runs.runs.empty())
      require("DIR, the folder of a run, or --thesis");
    if (options->of_thesis && options->runs.out.empty()) require("-o with --thesis");
    action = [=] { return draw(*options); };
  });
}

}  // namespace sinew::cli
