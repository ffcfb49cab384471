#include "cli/figure_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/gnuplot.h"
#include "cli/run_folder.h"
#include "sinew/config/diagnostics.h"

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;  // keys stay in the order in which they come
using report::Picture;

constexpr const char* index_name = "index.json";
constexpr const char* format = "sinew.figures/1";

std::string_view ending(Picture picture) { return picture == Picture::svg ? "svg" : "png"; }

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json curve_of(const report::Plot& plot, const report::Curve& curve, const report::Sheet& sheet,
              std::size_t column) {
  return {{"curve", curve.label.empty() ? plot.y.name : curve.label},
          {"kind", report::to_text(curve.kind)},
          {"source", curve.source},
          {"file", sheet.name + ".csv"},
          {"x", sheet.headings[0]},
          {"y", sheet.headings[column]}};
}

Json figure_of(const report::Figure& figure, const std::vector<Picture>& pictures, bool scripts) {
  const report::FigureData data = report::data(figure);
  Json out{{"figure", figure.name}, {"title", figure.title}, {"caption", figure.caption}};
  for (const Picture p : pictures) out[ending(p)] = fmt::format("{}.{}", figure.name, ending(p));
  if (scripts) out["script"] = figure.name + ".gp";
  out["curves"] = Json::array();
  for (std::size_t p = 0; p < figure.plots.size(); ++p)
    for (std::size_t c = 0; c < figure.plots[p].curves.size(); ++c) {
      const report::Place at = data.places[p][c];
      out["curves"].push_back(
          curve_of(figure.plots[p], figure.plots[p].curves[c], data.sheets[at.sheet], at.column));
    }
  for (const report::Missing& m : figure.missing)
    out["curves"].push_back({{"curve", m.what}, {"kind", "unavailable"}, {"source", m.why}});
  return out;
}

// Names in an index, its own too: only of files that stand in its folder.
std::set<std::string> files_of(const Json& index) {
  std::set<std::string> files;
  const auto add = [&](const Json& of, const char* key) {
    if (!of.contains(key) || !of[key].is_string()) return;
    const std::string name = of[key];
    if (!name.empty() && fs::path(name).filename() == name && name != "." && name != "..")
      files.insert(name);
  };
  for (const Json& figure : index["figures"]) {
    for (const char* key : {"svg", "png", "script"}) add(figure, key);
    for (const Json& curve : figure.value("curves", Json::array())) add(curve, "file");
  }
  return files;
}

void remove_earlier(const fs::path& folder) {
  std::ifstream in(folder / index_name);
  const Json index = Json::parse(in, nullptr, false);
  if (!index.is_object() || index.value("format", "") != format || !index.contains("figures"))
    return;
  for (const std::string& name : files_of(index))
    if (fs::is_regular_file(folder / name)) fs::remove(folder / name);
}

void draw_all(const fs::path& folder, const std::vector<std::string>& scripts) {
  const std::vector<std::string> failed = draw(folder, scripts);
  if (failed.empty()) return;
  throw std::runtime_error(fmt::format("{}: gnuplot could not draw {}; its words are above",
                                       folder.string(), fmt::join(failed, ", ")));
}

}  // namespace

std::vector<Picture> parse_formats(const std::vector<std::string>& words) {
  std::vector<Picture> out;
  for (const std::string& list : words) {
    std::istringstream in(list);
    for (std::string word; std::getline(in, word, ',');) {
      if (word == "csv") continue;
      if (word != "svg" && word != "png")
        config::fail({"--format", 0, 0}, "", fmt::format("\"{}\"", word), "svg, png or csv",
                     "--format svg,png");
      const Picture picture = word == "svg" ? Picture::svg : Picture::png;
      if (std::ranges::find(out, picture) == out.end()) out.push_back(picture);
    }
  }
  return out;
}

std::string figure_index(const std::vector<report::Figure>& figures,
                         const std::vector<Picture>& pictures, bool scripts) {
  Json out{{"format", format}, {"figures", Json::array()}};
  for (const report::Figure& figure : figures)
    out["figures"].push_back(figure_of(figure, pictures, scripts));
  return text_of(out);
}

std::string write_figures(const fs::path& folder, const std::vector<report::Figure>& figures,
                          const FigureFiles& options, const Messages& messages) {
  const bool drawing = !options.pictures.empty() && has_gnuplot();
  const std::vector<Picture> drawn = drawing ? options.pictures : std::vector<Picture>{};
  const std::string index = figure_index(figures, drawn, !options.pictures.empty());
  if (options.force) remove_earlier(folder);
  refuse_to_overwrite(folder / index_name, options.force);
  for (const std::string& name : files_of(Json::parse(index)))
    refuse_to_overwrite(folder / name, options.force);

  fs::create_directories(folder);
  std::vector<std::string> scripts;
  for (const report::Figure& figure : figures) {
    const report::FigureData data = report::data(figure);
    for (const report::Sheet& sheet : data.sheets)
      write_file(folder / (sheet.name + ".csv"), report::csv(sheet));
    if (options.pictures.empty()) continue;
    scripts.push_back(figure.name + ".gp");
    write_file(folder / scripts.back(), report::script(figure, data, options.pictures));
  }
  write_file(folder / index_name, index);
  if (drawing) {
    draw_all(folder, scripts);
  } else if (!options.pictures.empty()) {
    const std::string missing =
        "gnuplot is missing: the CSV files and scripts are written, no pictures; try apt-get "
        "install gnuplot-nox";
    if (options.must_draw) throw std::runtime_error(folder.string() + ": " + missing);
    messages.warning(missing);
  }
  return index;
}

}  // namespace sinew::cli
