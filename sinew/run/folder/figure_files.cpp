#include "sinew/run/folder/figure_files.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sinew/actuator/body.h"
#include "sinew/actuator/operating_point.h"
#include "sinew/config/diagnostics.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/json/json.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/files.h"

namespace sinew::run {

namespace {

constexpr int intervals = 200;  // into which a curve's length is divided
constexpr double most_curves = 6;

// Returns a step of 1, 2 or 5 times a power of ten, which gives few curves at round pressures.
double round_step(double top) {
  const double least = top / most_curves;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= least * (1 - 1e-9)) return digit * power;
  return 10 * power;
}

double top_pressure(const actuator::Actuator& a) {
  return a.prediction.highest > 0 ? a.prediction.highest : a.effectiveness.valid_to;
}

report::Axis axis(std::string name, const units::ShownUnit& unit) {
  return {.name = std::move(name), .unit = unit.label(), .scale = unit.scale};
}

report::Figure figure_of(const actuator::Actuator& a, const gas::Air& air,
                         const std::string& source, const units::ShownUnits& units) {
  const double shortest = actuator::shortest_length(a), longest = a.long_end.length;
  const actuator::Surroundings around{air.atmosphere, air.polytropic_exponent, 0};
  const double top = top_pressure(a);
  const double largest = actuator::operating_point(a, longest, top, around).tension;
  const units::ShownUnit length = units.of("m", longest), force = units.of("N", largest),
                         pressure = units.of("Pa gauge", top, air.atmosphere);
  report::Plot plot{.x = axis("length", length), .y = axis("tension", force)};
  const double step = round_step(pressure.of(top));
  for (int k = 0; k * step <= pressure.of(top) * (1 + 1e-9); ++k) {
    report::Curve curve{.label = fmt::format("{:.4g} {}", k * step, pressure.name),
                        .source = source};
    for (int i = 0; i <= intervals; ++i) {
      const double at = shortest + (longest - shortest) * i / intervals;
      const double gauge = pressure.back(k * step);
      curve.xs.push_back(length.of(at));
      // A muscle cannot push, so a negative tension is drawn as 0.
      curve.ys.push_back(
          force.of(std::max(0.0, actuator::operating_point(a, at, gauge, around).tension)));
    }
    plot.curves.push_back(std::move(curve));
  }
  report::Figure out{.name = report::file_name_of(a.name), .title = "Characteristic of " + a.name};
  out.caption = fmt::format(
      "Tension of {} at rest over its length, without losses, at gauge pressures up to {:.4g} {}, "
      "by {}.",
      a.name, pressure.of(top), pressure.name, source);
  out.plots.push_back(std::move(plot));
  return out;
}

}  // namespace

bool is_muscle_file(const std::filesystem::path& named) {
  std::error_code none;
  return named.extension() == ".toml" && std::filesystem::is_regular_file(named, none);
}

std::vector<report::Figure> muscle_figures(const std::filesystem::path& file,
                                           const units::ShownUnits& units) {
  const experiment::Experiment e = experiment::load_machine_file(file.string()).experiment;
  if (e.actuators.empty())
    config::fail({file.string(), 0, 0}, "", "no actuator", "an actuator or a robot file");
  std::vector<report::Figure> out;
  for (const actuator::Actuator& a : e.actuators)
    out.push_back(figure_of(a, e.air, file.filename().string(), units));
  return out;
}

namespace {

namespace fs = std::filesystem;
using report::Picture;

constexpr const char* index_name = "index.json";
constexpr const char* page_name = "index.html";
constexpr const char* format = "sinew.figures/1";

// Returns the names that an index lists, restricted to the expected kinds of files in its own
// folder.
std::set<std::string> files_of(const Json& index) {
  std::set<std::string> files;
  const auto add = [&](const Json& of, const char* key, const char* ending) {
    if (!of.is_object() || !of.contains(key) || !of[key].is_string()) return;
    const std::string name = of[key].string();
    if (fs::path(name).filename() == name && fs::path(name).extension() == ending)
      files.insert(name);
  };
  for (const Json& figure : index["figures"]) {
    add(figure, "svg", ".svg");
    add(figure, "png", ".png");
    add(figure, "pdf", ".pdf");
    add(figure, "script", ".gp");
    if (!figure.is_object() || !figure.contains("curves")) continue;
    for (const Json& curve : figure["curves"]) add(curve, "file", ".csv");
  }
  add(index, "page", ".html");
  return files;
}

void draw_all(const fs::path& folder, const std::vector<std::string>& scripts) {
  const std::vector<std::string> failed = report::draw(folder, scripts);
  for (const std::string& script : scripts)
    if (const fs::path pdf = (folder / script).replace_extension("pdf"); fs::exists(pdf))
      report::take_date_out(pdf);
  if (failed.empty()) return;
  throw std::runtime_error(fmt::format("{}: gnuplot could not draw {}; its words are above",
                                       folder.string(), fmt::join(failed, ", ")));
}

}  // namespace

std::vector<std::string> figures_in(const fs::path& folder) {
  std::ifstream in(folder / index_name);
  Json index;
  if (!Json::parse(in, index) || !index.is_object() || !index.contains("format") ||
      index["format"] != format || !index.contains("figures"))
    return {};
  const std::set<std::string> files = files_of(index);
  std::vector<std::string> out(files.begin(), files.end());
  out.emplace_back(index_name);
  return out;
}

namespace {

// Writes all files but the pictures into the work folder; returns the scripts for gnuplot.
std::vector<std::string> write_all(const fs::path& folder, const report::Gallery& gallery,
                                   const std::string& index, const FigureFiles& options) {
  constexpr auto later = log::Replacement::Sync::later;
  std::vector<std::string> scripts;
  for (const report::Exhibit& exhibit : gallery.exhibits) {
    const report::Figure& figure = exhibit.figure;
    const report::FigureData data = report::data(figure);
    for (const report::Sheet& sheet : data.sheets)
      write_file(folder / (sheet.name + ".csv"), report::csv(sheet), later);
    if (options.pictures.empty()) continue;
    scripts.push_back(figure.name + ".gp");
    write_file(folder / scripts.back(),
               report::script(labelled(figure, options.labels), data, options.pictures), later);
  }
  write_file(folder / index_name, index, later);
  write_file(folder / page_name, report::index_html(gallery), later);
  return scripts;
}

// Returns the figures of an earlier call, to be replaced. Throws if they exist and `force` is
// false, or if another file has the name of a new figure.
std::vector<std::string> replaceable(const fs::path& folder, const std::string& index, bool force) {
  std::vector<std::string> old = figures_in(folder);
  refuse_to_overwrite(folder / index_name, force, figures_kind);
  for (const std::string& name : files_of(Json::parse(index)))
    if (fs::exists(folder / name) && std::ranges::find(old, name) == old.end())
      refuse(folder / name, "a file that " + std::string(index_name) + " does not list",
             "an unused name", "another folder, or to move that file elsewhere");
  return old;
}

// The folder of unfinished figures. It is removed on failure, since it holds nothing else and
// figures are quickly drawn again.
struct Stage {
  explicit Stage(OutputFolder& folder) : folder_(folder) {
    fs::remove_all(folder.path() / name);
    folder.stage(name);
  }
  ~Stage() {
    std::error_code ignored;
    if (folder_.staged()) fs::remove_all(folder_.work(), ignored);
    if (!fs::is_symlink(folder_.path())) fs::remove(folder_.path(), ignored);  // if it is empty
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  static constexpr const char* name = ".unfinished";
  OutputFolder& folder_;
};

}  // namespace

std::string write_figures(const fs::path& folder, report::Gallery gallery,
                          const FigureFiles& options, const Notices& notices) {
  const bool drawing = !options.pictures.empty() && report::has_gnuplot();
  gallery.pictures.clear();
  if (drawing)
    for (const Picture p : options.pictures) gallery.pictures.emplace_back(report::ending(p));
  gallery.scripts = !options.pictures.empty();
  const std::string index = report::index_json(gallery);

  finish_replacing(folder);
  refuse_to_overwrite(folder / index_name, options.force, figures_kind);
  OutputFolder out(folder);
  const Stage stage(out);
  const std::vector<std::string> replaced = replaceable(folder, index, options.force);
  const std::vector<std::string> scripts = write_all(out.work(), gallery, index, options);
  if (drawing) draw_all(out.work(), scripts);
  out.commit(replaced);
  if (!drawing && !options.pictures.empty()) {
    const std::string missing =
        "gnuplot is missing: the CSV files and scripts are written, no pictures; try apt-get "
        "install gnuplot-nox";
    if (options.must_draw) throw std::runtime_error(folder.string() + ": " + missing);
    notices.warning(missing);
  }
  return index;
}

}  // namespace sinew::run
