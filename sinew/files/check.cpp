#include "sinew/files/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "sinew/config/compose.h"
#include "sinew/config/diagnostics.h"
#include "sinew/config/gains.h"
#include "sinew/config/shown_units.h"
#include "sinew/config/valve_timing.h"
#include "sinew/experiment/faults.h"
#include "sinew/experiment/machine_file.h"
#include "sinew/gas/delay.h"
#include "sinew/json/json.h"
#include "sinew/log/reader.h"
#include "sinew/recording/mapping.h"
#include "sinew/report/figures/labels.h"
#include "sinew/report/text/text_table.h"
#include "sinew/run/folder/run_folder.h"
#include "sinew/run/folder/run_storage.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "sinew/tune/optimizer/tuning.h"
#include "sinew/tune/study.h"

namespace sinew::files {

namespace {

using Problems = std::vector<config::Problem>;

void add(const Problems& found, std::vector<std::string>& to) {
  for (const config::Problem& problem : found) to.push_back(config::to_text(problem));
}

void check_log(const std::filesystem::path& file, Finding& out) {
  const signals::Table table = log::read(file);
  if (table.series.empty())
    out.problems.push_back(file.string() + ": found no topic with numbers; expected a run's log");
  if (!table.complete)
    out.warnings.push_back(file.string() +
                           ": was cut off or is damaged; everything before can be read");
}

void check_run(const std::filesystem::path& folder, Finding& out) {
  const run::RunFiles run = run::run_files(folder);
  check_log(run.log, out);
  add(experiment::load_machine_file(run::machine_of(run, "")).experiment.warnings, out.warnings);
}

// Adds a warning per file, and the values as rows of the table.
void add_source_warnings(const Problems& unsourced, Finding& out) {
  std::map<std::string, int> counts;
  for (const config::Problem& p : unsourced) {
    ++counts[p.where.file];
    const std::string value = p.found.substr(0, p.found.find(" without a source"));
    out.unsourced.push_back({p.key, value, p.where.file, p.where.line});
  }
  for (const auto& [file, count] : counts)
    out.warnings.push_back(
        fmt::format("{}: {} value{} without a source", file, count, count == 1 ? "" : "s"));
}

// Returns the values in columns, " key value file:line".
std::string table_of(const std::vector<UnsourcedValue>& values) {
  report::TextTable table({"key", "value", "where"});
  for (const UnsourcedValue& one : values)
    table.add({one.key, one.value, fmt::format("{}:{}", one.file, one.line)});
  return table.empty() ? "" : table.text("  ");
}

// Reports each fault and its time, and warns of faults without effect; why(fault) returns the
// reason.
template <class Why>
void add_faults(const std::string& path, const std::vector<experiment::Fault>& faults, Why why,
                Finding& out) {
  for (std::size_t i = 0; i < faults.size(); ++i) {
    out.faults.push_back(experiment::to_text(faults[i]));
    if (const std::string idle = why(faults[i]); !idle.empty())
      out.warnings.push_back(fmt::format("{}: fault[{}] never acts: {}", path, i, idle));
  }
}

// Warns of valves that need much of a period to open, so that small duties deliver nothing.
void warn_of_slow_valves(const experiment::Experiment& e, Finding& out) {
  constexpr double much = 0.25;  // share of the period
  const double period = 1e-4 * e.robot.low_level.pwm_ticks;
  for (const gas::Valve& valve : e.valves) {
    const double opens = gas::delays(valve).opening;
    const bool driven = std::ranges::any_of(e.robot.muscles, [&](const robot::Muscle& m) {
      return m.inlet == valve.name || m.exhaust == valve.name;
    });
    if (!driven || opens <= much * period) continue;
    out.warnings.push_back(
        fmt::format("{}: valve.{} takes {:.3g} ms of a period of {:.3g} ms to open: duties below "
                    "{:.0f} % deliver "
                    "nothing; try more low_level.pwm_ticks, or a quicker valve",
                    e.path, valve.name, 1e3 * opens, 1e3 * period, 100 * opens / period));
  }
}

void check_machine(const std::string& path, Finding& out) {
  const std::string kind(config::format_kind(config::parse_file(path)));
  const bool runs = kind == "experiment";
  experiment::MachineFile file;
  if (runs) {
    file = {kind, run::runnable(path, {}, false)};
  } else {
    file = experiment::load_machine_file(path);
    run::refuse_unbuildable(file);
  }
  const experiment::Experiment& e = file.experiment;
  add(e.warnings, out.warnings);
  add_source_warnings(e.unsourced, out);
  warn_of_slow_valves(e, out);
  if (!runs) return;
  for (const robot::Contradiction& c : run::beyond_reach(e))
    out.warnings.push_back(fmt::format("{}: {}: found {}; expected {}; try {}", path, c.key,
                                       c.found, c.expected, c.try_this));
  const auto why = [&](const experiment::Fault& f) {
    return why_idle(e, f, experiment::last_tick(e));
  };
  add_faults(e.path, e.faults, why, out);
  const double end = static_cast<double>(experiment::last_tick(e)) * signals::tick_seconds;
  for (std::size_t i = 0; i < e.plan.changes.size(); ++i)
    if (const std::string idle = why_idle(e, e.plan.changes[i], end); !idle.empty())
      out.warnings.push_back(fmt::format("{}: change[{}] never acts: {}", path, i, idle));
}

}  // namespace

Finding check(const std::string& path) {
  Finding out{.file = path};
  try {
    const std::filesystem::path file(path);
    if (std::filesystem::is_directory(file)) {
      check_run(file, out);
    } else if (file.extension() == ".mcap") {
      check_log(file, out);
    } else if (file.extension() == ".dat" && file.filename().string().starts_with("gain")) {
      config::read_gains(path);
    } else if (file.extension() == ".dat") {
      config::read_valve_timing(path);
    } else if (const config::Node root = config::parse_file(path);
               config::format_kind(root) == "plan") {
      tune::check(tune::sweep_of(tune::load_study(path)));
    } else if (config::format_kind(root) == "mapping") {
      recording::load_mapping(path);
    } else if (config::format_kind(root) == "labels") {
      report::read_labels(path);
    } else if (config::format_kind(root) == "settings") {
      config::read_user_settings(path);
    } else if (config::format_kind(root) == "tuning") {
      tune::load_tuning(path);
    } else {
      check_machine(path, out);
    }
  } catch (const config::Error& e) {
    add(e.problems(), out.problems);
  } catch (const std::exception& e) {
    out.problems.push_back(e.what());
  }
  return out;
}

std::string text_of(const Finding& finding) {
  std::string out;
  for (const std::string& text : finding.problems) out += text + "\n";
  for (const std::string& text : finding.warnings) out += "warning: " + text + "\n";
  out += table_of(finding.unsourced);
  const auto count = [](std::size_t n, std::string_view what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  if (!finding.faults.empty())
    out += fmt::format("{}: {}: {}\n", finding.file, count(finding.faults.size(), "fault"),
                       fmt::join(finding.faults, "; "));
  const bool good = finding.problems.empty();
  std::string line = good ? "ok" : count(finding.problems.size(), "problem");
  if (!finding.warnings.empty()) line += ", " + count(finding.warnings.size(), "warning");
  return out + fmt::format("{}: {}\n", finding.file, line);
}

std::string json_of(const std::vector<Finding>& findings) {
  Json out = Json::array();
  for (const Finding& finding : findings) {
    out.push_back(
        {{"file", finding.file}, {"problems", finding.problems}, {"warnings", finding.warnings}});
    if (!finding.faults.empty()) out.back()["faults"] = finding.faults;
    for (const UnsourcedValue& one : finding.unsourced)
      out.back()["unsourced"].push_back(
          {{"key", one.key}, {"value", one.value}, {"file", one.file}, {"line", one.line}});
  }
  return out.text(2) + "\n";
}

}  // namespace sinew::files
