#include "sinew/run/folder/drawn_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/setting.h"
#include "sinew/config/shown_units.h"
#include "sinew/experiment/globs.h"
#include "sinew/log/reader.h"
#include "sinew/report/figures/figure_layout.h"
#include "sinew/report/figures/overlay.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::run {

namespace {

namespace fs = std::filesystem;
using Figures = std::vector<report::Figure>;

// A run with final times, and its analysis.
struct Analysed {
  explicit Analysed(const ReadRun& run)
      : drawn(run), analysis(run.table, analysis::read_machine(run.resolved)) {}

  report::Run run() const {
    return {.analysis = analysis, .resolved = drawn.resolved, .name = drawn.name};
  }

  const ReadRun& drawn;
  analysis::Analysis analysis;
};

ReadRun read(const fs::path& named, const DrawingRequest& request, const Notices& notices) {
  return read_run(run_files(named), request.machine, "the figures show", notices);
}

// Converts "/joint/*/angle,/muscle/*/tension" into a figure with two plots.
report::ChosenFigure chosen(const std::string& text) {
  report::ChosenFigure out;
  for (const std::string& pattern : config::at_commas(text))
    out.push_back({pattern, [pattern](std::string_view topic) {
                     return experiment::matches(pattern, topic);
                   }});
  return out;
}

// Throws if a pattern matches no channel of any run.
void check_channels(const std::vector<report::ChosenFigure>& figures,
                    const std::deque<Analysed>& runs) {
  std::vector<std::string> topics;
  for (const Analysed& one : runs)
    for (std::string& topic : report::topics_of(one.run())) topics.push_back(std::move(topic));
  constexpr std::string_view truth = "/true";
  const std::vector<std::string_view> names(topics.begin(), topics.end());
  for (const report::ChosenFigure& figure : figures)
    for (const report::ChosenChannels& part : figure) {
      const auto there = [&](std::string_view topic) {
        return part.has(topic) ||
               (topic.starts_with(truth) && part.has(topic.substr(truth.size())));
      };
      if (std::ranges::any_of(names, there)) continue;
      const std::string near = config::closest_in_quotes(part.name, names);
      config::fail({"channels", 0, 0}, "", config::in_quotes(part.name),
                   runs.size() == 1 ? "a channel of the run, or * in place of its parts"
                                    : "a channel of one of the runs, or * in place of its parts",
                   near.empty() ? "\"/joint/*/angle\"" : near);
    }
}

// Keeps the figures named in `only`; all if it is empty.
void choose(Figures& figures, const std::vector<std::string>& only, const fs::path& run) {
  if (only.empty()) return;
  std::vector<std::string> there;
  for (const report::Figure& f : figures) there.push_back(f.name);
  for (const std::string& name : only)
    if (std::ranges::find(there, name) == there.end())
      config::fail({run.string(), 0, 0}, "only", fmt::format("\"{}\"", name),
                   fmt::format("one of {}", fmt::join(there, ", ")),
                   std::string(config::closest(name, {there.begin(), there.end()})));
  std::erase_if(figures, [&](const report::Figure& f) {
    return std::ranges::find(only, f.name) == only.end();
  });
}

void put_title(Figures& figures, const std::string& title) {
  if (title.empty()) return;
  if (figures.size() != 1)
    config::fail({"title", 0, 0}, "", fmt::format("{} figures", figures.size()),
                 "one, whose title it is", "only=NAME of a figure");
  figures[0].plots[0].title = title;
}

// Throws if the paper has no room for a figure's contents.
void put_on_paper(Figures& figures, const report::Paper& paper) {
  for (report::Figure& f : figures) {
    f.paper = paper;
    try {
      report::layout(f);
    } catch (const std::invalid_argument& too_low) {
      config::fail({"height", 0, 0}, "", fmt::format("{:.4g} mm", paper.height / 72 * 25.4),
                   too_low.what());
    }
  }
}

// Warns of labels that no figure contains. This is no error, since they may be for other runs.
void warn_of_unused_labels(const Figures& figures, const report::Labels& labels,
                           const Notices& notices) {
  report::FigureTexts phrases;
  for (const report::Figure& f : figures) phrases.add(f);
  for (const config::Problem& p : unused_labels(labels, phrases))
    notices.warning(config::to_text(p));
}

std::vector<Figures> figures_of(const std::vector<ReadRun>& runs, const DrawingRequest& request) {
  report::RunFigureOptions options = request.options;
  options.units =
      config::units_to_show({.now = request.units, .run = &runs.front().resolved}).units;
  for (const std::string& text : request.channels) options.channels.push_back(chosen(text));
  std::deque<Analysed> analysed(runs.begin(), runs.end());
  if (!options.channels.empty()) check_channels(options.channels, analysed);
  std::vector<Figures> out;
  for (const Analysed& one : analysed) out.push_back(report::run_figures(one.run(), options));
  return out;
}

// `what` is the run named in messages, `of` the name of the figures on the folder's page.
std::string finish(Figures figures, const fs::path& what, const std::string& of,
                   const fs::path& folder, const DrawingRequest& request, const Notices& notices) {
  if (figures.empty())
    config::fail({what.string(), 0, 0}, "", "no samples",
                 "a log with samples in the requested time", "another time");
  warn_of_unused_labels(figures, request.files.labels, notices);
  choose(figures, request.only, what);
  put_title(figures, request.title);
  put_on_paper(figures, request.paper);
  report::Gallery gallery{.title = of.empty() ? "Figures" : "Figures of " + of};
  for (report::Figure& f : figures) gallery.exhibits.push_back({std::move(f), {}});
  return write_figures(folder, std::move(gallery), request.files, notices);
}

// Returns "walk-test-1/2" for a numbered folder, else the folder's own name.
std::string name_of(const fs::path& named) {
  const fs::path folder = fs::absolute(named).lexically_normal();
  const fs::path own = folder.has_filename() ? folder : folder.parent_path();
  const std::string last = own.filename().string();
  const bool number = !last.empty() && last.find_first_not_of("0123456789") == last.npos;
  return number ? (own.parent_path().filename() / last).string() : last;
}

std::vector<std::string> names_of(const OverlaidRuns& overlaid) {
  std::vector<std::string> out = overlaid.labels;
  if (out.size() > overlaid.runs.size())
    config::fail({"label", 0, 0}, "", fmt::format("{} labels", out.size()),
                 fmt::format("one for each run, {} at most", overlaid.runs.size()),
                 "as many as there are runs, in their order");
  for (std::size_t i = out.size(); i < overlaid.runs.size(); ++i) {
    const std::string name = name_of(overlaid.runs[i]);
    const bool taken = std::ranges::find(out, name) != out.end();
    out.push_back(taken ? overlaid.runs[i].string() : name);
  }
  for (const std::string& name : out)
    if (std::ranges::count(out, name) > 1)
      config::fail({"label", 0, 0}, "", config::in_quotes(name) + " for two runs",
                   "labels that differ", "label=A label=B");
  return out;
}

void align_with_first(std::vector<ReadRun>& runs, const OverlaidRuns& overlaid,
                      const std::vector<std::string>& names, const Notices& notices) {
  if (!overlaid.align) return;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    analysis::AlignRequest request = *overlaid.align;
    request.name = overlaid.runs[i].string();
    const analysis::Alignment found = analysis::align(runs[0].table, runs[i].table, request);
    analysis::reclock(runs[i].table, found.clock);
    std::string how = fmt::format("{}: aligned with {} by a shift of {:.4g} s", names[i], names[0],
                                  found.clock.shift);
    if (found.clock.rate != 0)
      how += fmt::format(" and a clock that is {:.3g} % too {}", 100 * std::abs(found.clock.rate),
                         found.clock.rate > 0 ? "fast" : "slow");
    notices.note(how);
  }
}

}  // namespace

std::string draw_run(const fs::path& named, const fs::path& folder, const DrawingRequest& request,
                     const Notices& notices) {
  std::vector<ReadRun> runs;
  runs.push_back(read(named, request, notices));
  return finish(std::move(figures_of(runs, request)[0]), named, runs[0].name, folder, request,
                notices);
}

std::string draw_muscles(const fs::path& file, const fs::path& folder,
                         const DrawingRequest& request, const Notices& notices) {
  if (!request.channels.empty() || std::isfinite(request.options.from) ||
      std::isfinite(request.options.to))
    config::fail({file.string(), 0, 0}, "", "a file of muscles with channels or a time",
                 "the folder of a run", "leaving them out");
  const units::ShownUnits units =
      config::units_to_show({.now = request.units}, units::UnitSet::metric).units;
  return finish(muscle_figures(file, units), file, file.filename().string(), folder, request,
                notices);
}

std::string draw_runs(const OverlaidRuns& overlaid, const fs::path& folder,
                      const DrawingRequest& request, const Notices& notices) {
  const std::vector<std::string> names = names_of(overlaid);
  std::vector<ReadRun> runs;
  for (const fs::path& named : overlaid.runs) runs.push_back(read(named, request, notices));
  align_with_first(runs, overlaid, names, notices);
  std::vector<Figures> each = figures_of(runs, request);
  std::vector<report::LabelledRun> labelled;
  for (std::size_t i = 0; i < each.size(); ++i) labelled.push_back({names[i], std::move(each[i])});
  return finish(report::overlaid(labelled), overlaid.runs.front(),
                fmt::format("{}", fmt::join(names, " and ")), folder, request, notices);
}

std::string labels_of_runs(const std::vector<fs::path>& named, const DrawingRequest& request) {
  std::vector<ReadRun> runs;
  for (const fs::path& one : named) runs.push_back(read(one, request, {}));
  report::FigureTexts phrases;
  for (const Figures& figures : figures_of(runs, request))
    for (const report::Figure& f : figures) phrases.add(f);
  return report::labels_file(phrases);
}

}  // namespace sinew::run
