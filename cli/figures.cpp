// cli/figures.cpp - `sinew figures`: the curves of the thesis's figures as CSV, with an index that
// says of each what it is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/figures_runs.h"
#include "cli/named.h"
#include "cli/run_folder.h"
#include "cli/terminal.h"
#include "cli/text_table.h"
#include "cli/thesis_figures.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/quantity.h"
#include "sinew/experiment/machine_file.h"

namespace sinew::cli {

void FigureSet::add(const Figure& figure, Curve::Kind kind, const std::string& source,
                    Sheet sheet) {
  if (std::ranges::find(figures, figure.number, &Figure::number) == figures.end())
    figures.push_back(figure);
  const std::string x = sheet.headings[0];
  for (std::size_t c = 1; c < sheet.headings.size(); ++c) {
    const std::string& y = sheet.headings[c];
    curves.push_back({figure.number, y.substr(0, y.rfind(" [")), kind, source, sheet.name, x, y});
  }
  sheets.push_back(std::move(sheet));
}

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Options {
  RunFiguresRequest runs;
  std::string folder, root = ".";
  bool thesis = false, force = false, json = false;
};

std::string_view word(Curve::Kind kind) {
  if (kind == Curve::Kind::computed) return "computed";
  return kind == Curve::Kind::synthetic ? "synthetic" : "unavailable";
}

FigureSources sources(const std::string& root) {
  const auto path = [&](std::string_view file) { return (fs::path(root) / file).string(); };
  if (!fs::exists(path("robots/leg/valves.toml")))
    config::fail({path("robots/leg/valves.toml"), 0, 0}, "", "no such file",
                 "the project's folder, with robots/ and experiments/", "--root DIR");
  FigureSources out{.root = root};
  out.actuator = experiment::load_machine_file(path("robots/leg-as-printed/actuator.toml"))
                     .experiment.actuators.at(0);
  out.actuator.effectiveness.argument = actuator::Effectiveness::Argument::gauge;
  out.actuator.effectiveness.scale = 1;
  const auto valve = [&](const std::string& file, const std::string& name) {
    return named(experiment::load_machine_file(path(file)).experiment.valves, name, "--root",
                 "valve");
  };
  out.chapter3 = valve("robots/leg/valves.toml", "758");
  out.inlet = valve("robots/leg/valves-at-the-bench.toml", "inlet");
  out.exhaust = valve("robots/leg/valves-at-the-bench.toml", "exhaust");
  return out;
}

std::string csv(const Sheet& sheet) {
  std::string out = fmt::format("{}\n", fmt::join(sheet.headings, ","));
  for (const std::vector<double>& row : sheet.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c > 0) out += ',';
      if (!std::isnan(row[c])) out += config::format_number(row[c]);
    }
    out += '\n';
  }
  return out;
}

// Figures in the order of the thesis: 2-6, 2-8 … 4-9.
void in_order(FigureSet& set) {
  const auto place = [](const Figure& figure) {
    const std::size_t dash = figure.number.find('-');
    return std::pair(std::stoi(figure.number.substr(0, dash)),
                     std::stoi(figure.number.substr(dash + 1)));
  };
  std::ranges::stable_sort(set.figures, {}, place);
}

Json index_of(const FigureSet& set) {
  Json out{{"format", "sinew.figures/1"}, {"figures", Json::array()}};
  for (const Figure& figure : set.figures) {
    Json f{{"figure", figure.number}, {"caption", figure.caption}, {"curves", Json::array()}};
    for (const Curve& c : set.curves) {
      if (c.figure != figure.number) continue;
      Json curve{{"curve", c.what}, {"kind", word(c.kind)}, {"source", c.source}};
      if (!c.sheet.empty()) {
        curve["file"] = c.sheet + ".csv";
        curve["x"] = c.x;
        curve["y"] = c.y;
      }
      f["curves"].push_back(std::move(curve));
    }
    out["figures"].push_back(std::move(f));
  }
  return out;
}

void print(const FigureSet& set) {
  using enum TextTable::Align;
  TextTable table({"figure", "", "computed", "synthetic", "unavailable"},
                  {left, left, right, right, right});
  for (const Figure& figure : set.figures) {
    int count[3] = {};
    for (const Curve& c : set.curves)
      if (c.figure == figure.number) ++count[static_cast<int>(c.kind)];
    const auto shown = [](int n) { return n > 0 ? std::to_string(n) : std::string(); };
    table.add({figure.number, figure.caption, shown(count[0]), shown(count[1]), shown(count[2])});
  }
  fmt::print("{}", table.text());
}

ExitCode run_figures(const Options& options) {
  const fs::path folder(options.folder);
  refuse_to_overwrite(folder / "index.json", options.force);
  FigureSet set;
  const FigureSources from = sources(options.root);
  add_actuator_figures(set, from);
  add_static_figures(set, from);
  add_dynamic_figures(set, from);
  add_valve_figures(set, from);
  in_order(set);

  const std::string index = index_of(set).dump(2) + "\n";
  fs::create_directories(folder);
  for (const Sheet& sheet : set.sheets) {
    const fs::path file = folder / (sheet.name + ".csv");
    refuse_to_overwrite(file, options.force);
    write_file(file, csv(sheet));
  }
  write_file(folder / "index.json", index);
  if (options.json)
    fmt::print("{}", index);
  else
    print(set);
  return ok;
}

}  // namespace

void add_figures(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App& sub = subcommand(
      app, "figures", "figures for print, with the CSV behind each: of runs, or the thesis's",
      "sinew figures runs/walk-test-1/1 --units thesis\n  sinew figures --thesis -o figures");
  CLI::Option* runs = sub.add_option("DIR", options->runs.runs, "folders of runs, or log files");
  CLI::Option* thesis = sub.add_flag("--thesis", options->thesis, "those of Colbrunn (2000)");
  runs->excludes(thesis);
  sub.add_option("-o,--output", options->folder,
                 "folder for the figures and index.json; of runs: else figures/ beside the log");
  sub.add_option("--root", options->root,
                 "--thesis: the project's folder, with robots/ and experiments/; .");
  sub.add_option("--format", options->runs.formats, "svg, png or csv; svg,png");
  sub.add_option("--only", options->runs.only, "of runs: these figures alone")->excludes(thesis);
  sub.add_option("--units", options->runs.units, "of runs: si or thesis (in, lbf, psi, deg); si")
      ->check(CLI::IsMember({"si", "thesis"}))
      ->excludes(thesis);
  sub.add_option("--from", options->runs.from, "of runs: \"2 s\"; what was before is left out")
      ->excludes(thesis);
  sub.add_option("--to", options->runs.to, "of runs: what was after is left out")->excludes(thesis);
  sub.add_option("--machine", options->runs.machine,
                 "of runs: what was run, in place of the folder's resolved.toml")
      ->excludes(thesis);
  sub.add_flag("--force", options->force, "replace the figures that are there");
  sub.add_flag("--json", options->json, "print index.json");
  sub.add_flag("--quiet", options->runs.quiet, "only errors on stderr");
  sub.callback([=, &action] {
    if (!options->thesis && options->runs.runs.empty())
      throw CLI::RequiredError("DIR, the folder of a run, or --thesis");
    if (options->thesis && options->folder.empty()) throw CLI::RequiredError("-o with --thesis");
    action = [=] {
      if (options->thesis) return run_figures(*options);
      options->runs.out = options->folder;
      options->runs.force = options->force;
      options->runs.json = options->json;
      return draw_runs(options->runs);
    };
  });
}

}  // namespace sinew::cli
