// python/binding/figures.cpp - printable figures of kept runs, and the pages of their films.
#include <pybind11/stl.h>

#include "python/binding/recording.h"
#include "sinew/config/diagnostics.h"
#include "sinew/report/compare/comparison.h"
#include "sinew/run/folder/drawn_run.h"
#include "sinew/run/folder/files.h"
#include "sinew/run/folder/page.h"

namespace sinew::python {

namespace {

using Names = std::vector<std::string>;

std::vector<std::string> runs_of(const py::object& runs) {
  std::vector<std::string> out = paths_of(runs);
  if (out.empty()) throw py::value_error("runs: found none; expected the folder of a run");
  return out;
}

report::Picture picture_of(const std::string& word) {
  for (const report::Picture p : {report::Picture::pdf, report::Picture::svg, report::Picture::png})
    if (report::ending(p) == word) return p;
  throw py::value_error("formats: found \"" + word + "\"; expected pdf, svg or png");
}

double time_of(const py::object& seconds, double otherwise) {
  return seconds.is_none() ? otherwise : seconds.cast<double>();
}

std::optional<analysis::AlignRequest> request_of(const std::string& word, bool fit_clock) {
  if (word.empty() || word == "start") return std::nullopt;
  if (word != "event" && word != "correlation")
    throw py::value_error("align: found \"" + word + "\"; expected start, event or correlation");
  const bool event = word == "event";
  return analysis::AlignRequest{
      .by = event ? analysis::AlignBy::event : analysis::AlignBy::correlation,
      .fit_clock = fit_clock};
}

py::object figures(const py::object& runs, const py::object& folder, const Names& formats,
                   const Names& only, const Names& channels, const Names& names, bool overlay,
                   const std::string& align, bool fit_clock, const py::object& labels,
                   const std::string& units, const std::string& width, const std::string& height,
                   const std::string& font, const std::string& title, const py::object& start,
                   const py::object& stop, bool force) {
  const Names folders = runs_of(runs);
  run::OverlaidRuns overlaid{{folders.begin(), folders.end()}, names, request_of(align, fit_clock)};
  overlay = overlay || !names.empty() || overlaid.align;
  if (overlaid.runs.size() > 1 && !overlay)
    throw py::value_error("runs: found several; expected one, or names or overlay=True");
  run::DrawingRequest request{.units = units, .channels = channels, .only = only, .title = title};
  request.options.from = time_of(start, request.options.from);
  request.options.to = time_of(stop, request.options.to);
  request.paper = report::read_paper(width, height, font);
  request.files.force = force;
  request.files.must_draw = true;
  request.files.pictures.clear();
  for (const std::string& word : formats) request.files.pictures.push_back(picture_of(word));
  if (!labels.is_none()) request.files.labels = report::read_labels(path_of(labels));
  const std::string out = path_of(folder);
  Names warnings;
  const run::Notices notices{
      .on_warning = [&](std::string_view text) { warnings.emplace_back(text); }};
  std::string index;
  {
    const py::gil_scoped_release unlocked;
    index = overlay ? run::draw_runs(overlaid, out, request, notices)
                    : run::draw_run(overlaid.runs[0], out, request, notices);
  }
  const py::object about = parsed(index);
  about["warnings"] = warnings;
  return about;
}

std::string film_page(const Names& runs, const py::object& path, const std::string& align,
                      bool fit_clock, bool force) {
  if (runs.empty()) throw py::value_error("runs: found none; expected the folder of a run");
  report::AlignOptions align_options(align_of(align));
  align_options.fit_clock = fit_clock;
  if (runs.size() == 1 && (align_options.by != report::Align::start || fit_clock))
    throw py::value_error(
        "align: found one run; expected several, which are aligned with each other");
  const std::string file = path_of(path);
  run::refuse_to_overwrite(file, force, run::film_kind(file));
  run::require_folder_of(file);
  const py::gil_scoped_release unlocked;
  return run::film_page(runs, align_options);
}

[[noreturn]] void refuse(const std::string& name, const std::string& found,
                         const std::string& expected, const std::string& try_this) {
  config::fail({name, 0, 0}, "", found, expected, try_this);
}

}  // namespace

void bind_figures(py::module_& m) {
  m.def(
      "figures", &figures, py::arg("runs"), py::arg("folder"), py::kw_only(),
      py::arg("formats") = Names{"svg", "png"}, py::arg("only") = Names(),
      py::arg("channels") = Names(), py::arg("names") = Names(), py::arg("overlay") = false,
      py::arg("align") = "start", py::arg("fit_clock") = false, py::arg("labels") = py::none(),
      py::arg("units") = "", py::arg("width") = "", py::arg("height") = "", py::arg("font") = "",
      py::arg("title") = "", py::arg("start") = py::none(), py::arg("stop") = py::none(),
      py::arg("force") = false,
      "Draws the figures of a run into a folder, for print, each with its data as CSV; of several\n"
      "runs in the same axes, which `names` call in the legend. `align` aligns the others with "
      "the\n"
      "first run: start, event or correlation; `fit_clock` takes out their clocks' rates, too.\n"
      "`formats` are pdf, svg and png.\n"
      "`only` are names of figures; `channels` are figures of your choice in their place:\n"
      "\"/joint/*/angle,/muscle/*/tension\" is one with two plots. `labels` is a file with words\n"
      "in your language. `width`, `height` and `font` are texts with units, \"84 mm\" and \"9 "
      "pt\";\n"
      "`units` is si, thesis, metric or metric,length=cm; `start` and `stop` are in s. Returns\n"
      "the content of index.json, with `warnings`. Raises InputError.");
  m.def("film_page", &film_page, "Returns the page whose replay a film of these runs shows.");
  m.def("refuse", &refuse, py::arg("name"), py::arg("found"), py::arg("expected"),
        py::arg("try_this") = "", "Raises InputError.");
}

}  // namespace sinew::python
