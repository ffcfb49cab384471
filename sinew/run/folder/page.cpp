#include "sinew/run/folder/page.h"

#include <set>

#include "sinew/config/diagnostics.h"
#include "sinew/experiment/globs.h"
#include "sinew/log/reader.h"
#include "sinew/report/page/page.h"
#include "sinew/run/folder/run_log.h"

namespace sinew::run {

namespace {

namespace fs = std::filesystem;

// Returns the last `parts` names of a run's path, without the usual name of a log.
std::string tail_of(const fs::path& run, std::size_t parts) {
  std::vector<std::string> names;
  for (const fs::path& part : run.lexically_normal())
    if (!part.empty() && part != "." && part != log_name) names.push_back(part.string());
  std::string tail;
  for (std::size_t i = names.size() > parts ? names.size() - parts : 0; i < names.size(); ++i)
    tail += (tail.empty() || tail == "/" ? "" : "/") + names[i];
  return tail.empty() ? "." : tail;
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

// Returns the shortest ends of the paths that distinguish the runs. A number alone is not
// descriptive enough.
std::vector<std::string> labels_of(const std::vector<std::string>& runs) {
  const std::set<fs::path> all(runs.begin(), runs.end());
  for (std::size_t parts = 1;; ++parts) {
    std::vector<std::string> labels;
    bool numbers = false;
    for (const std::string& run : runs) {
      labels.push_back(tail_of(run, parts));
      numbers = numbers || is_number(labels.back());
    }
    const std::set<std::string> different(labels.begin(), labels.end());
    if ((different.size() == all.size() && (!numbers || parts > 1)) || parts > 8) return labels;
  }
}

// Returns the description of the run, from its folder or from the log itself.
config::Node resolved_of(const RunFiles& run) {
  if (fs::exists(run.resolved)) return config::parse_file(run.resolved.string());
  for (const auto& [key, value] : log::read_metadata(run.log))
    if (key == "resolved") return config::parse_text(value, run.log.string() + ": resolved");
  config::fail({run.log.string(), 0, 0}, "", "a log without the experiment that was run",
               "resolved.toml in its folder, or its text in the log", "sinew import");
}

report::NamedRun recorded(const std::string& named, std::string label, const Notices& notices) {
  const RunFiles run = run_files(named);
  require_finished(run.log);
  report::NamedRun out{std::move(label), log::read(run.log), resolved_of(run)};
  if (!out.logged.complete)
    notices.warning(run.log.string() + " was cut off or is damaged; compared as far as it goes");
  return out;
}

void keep_chosen(report::Comparison& comparison, const std::vector<std::string>& patterns) {
  if (patterns.empty()) return;
  std::vector<std::string_view> names;
  for (const report::ChannelRow& row : comparison.channels) names.push_back(row.channel.topic);
  keep(comparison, experiment::select(patterns, names, {"channels", 0, 0}));
}

}  // namespace

std::string page_of(const RunFiles& run, const std::string& machine, const Notices& notices,
                    const std::string& units) {
  const ReadRun read = read_run(run, machine, "the page shows", notices);
  const analysis::Analysis analysis(read.table, analysis::read_machine(read.resolved), read.ended);
  return report::page(
      {.analysis = analysis, .resolved = read.resolved, .name = read.name, .units = units});
}

bool write_report(const OutputFolder& folder, const analysis::Analysis& logged,
                  const config::Node& values, const std::string& name, const Notices& notices,
                  const std::string& units) {
  if (!report::has_page()) {
    notices.note("no report.html: this sinew was built without npm; docs/dependencies.md");
    return false;
  }
  write_into(folder, report_name,
             report::page({.analysis = logged, .resolved = values, .name = name, .units = units}));
  return true;
}

report::Comparison compare_runs(const std::vector<std::string>& runs,
                                const report::AlignOptions& align_options,
                                const std::vector<std::string>& channels, const Notices& notices) {
  const std::vector<std::string> labels = labels_of(runs);
  std::vector<report::NamedRun> all;
  for (std::size_t i = 0; i < runs.size(); ++i)
    all.push_back(recorded(runs[i], labels[i], notices));
  report::Comparison comparison = compare(std::move(all), align_options);
  keep_chosen(comparison, channels);
  return comparison;
}

FileKind film_kind(const std::filesystem::path& file) {
  constexpr auto start = FileKind::At::start;
  if (file.extension() == ".png") return {"PNG picture", "a picture", "\x89PNG", start};
  if (file.extension() == ".gif") return {"GIF film", "a film", "GIF8", start};
  if (file.extension() == ".webm") return {"WebM film", "a film", "\x1a\x45\xdf\xa3", start};
  return {"MP4 film", "a film", "ftyp"};
}

std::string film_page(const std::vector<std::string>& runs,
                      const report::AlignOptions& align_options, const std::string& machine,
                      const Notices& notices) {
  report::require_page("the film");
  return runs.size() > 1 ? report::page(compare_runs(runs, align_options, {}, notices))
                         : page_of(run_files(runs.front()), machine, notices);
}

}  // namespace sinew::run
