#include "sinew/run/folder/figure_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <set>

#include "sinew/json/json.h"
#include "sinew/report/figures/gnuplot.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/output_folder.h"

namespace sinew::run {
namespace {

namespace fs = std::filesystem;
using report::Picture;

constexpr const char* index_name = "index.json";
constexpr const char* page_name = "index.html";
constexpr const char* format = "sinew.figures/1";

// Names that an index lists, if they are such as it lists: of files that stand in its folder.
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

// Into the folder where they are drawn; those that gnuplot is to draw come back.
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

// Returns the figures of an earlier call, which may be replaced where `force` says so.
std::vector<std::string> replaceable(const fs::path& folder, const std::string& index, bool force) {
  std::vector<std::string> old = figures_in(folder);
  refuse_to_overwrite(folder / index_name, force);
  for (const std::string& name : files_of(Json::parse(index)))
    refuse_to_overwrite(folder / name, force);
  return old;
}

// The stage is nobody's but ours, and figures that did not become whole are quickly drawn again.
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
  refuse_to_overwrite(folder / index_name, options.force);
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
