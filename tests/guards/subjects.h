// tests/guards/subjects.h - shipped experiments as trees, of the robots and of the test stand, and
// short runs of variations of them.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/compose.h"
#include "sinew/experiment/experiment.fields.h"
#include "sinew/experiment/experiment.h"
#include "sinew/run/simulation/run.h"
#include "tests/guards/numeric_fields.h"
#include "tests/places.h"

namespace sinew::guards {

// An experiment as its resolved file has it.
struct Subject {
  std::string name;
  bool rig = false;
  config::Node root;
  std::vector<NumericField> fields;
};

inline Subject subject(const std::filesystem::path& file) {
  Subject out{.name = file.stem().string(), .rig = false, .root = {}, .fields = {}};
  const config::Node composed = config::compose(file.string());
  out.rig = config::is_on_stand(composed);
  Lister lister;
  experiment::Experiment e = experiment::load(composed, file.string());
  const std::string text = experiment::resolved(e, "0");
  experiment::run_fields(lister, e);
  experiment::machine_fields(lister, e);
  out.root = config::parse_text(text, "resolved.toml");
  out.fields = std::move(lister.fields);
  return out;
}

// Returns the shipped experiments of experiments/ and experiments/rig/, sorted by name.
inline std::vector<std::filesystem::path> shipped() {
  std::set<std::filesystem::path> files;
  for (const char* folder : {"/experiments", "/experiments/rig"})
    for (const auto& entry :
         std::filesystem::directory_iterator(sinew::test::source_dir() + std::string(folder)))
      if (entry.path().extension() == ".toml") files.insert(entry.path());
  return {files.begin(), files.end()};
}

// Ran is the outcome of a short run.
struct Ran {
  bool ended = false;
  std::string cause;
  signals::Table table;
  std::vector<std::string> not_finite;  // topics and summary keys
};

inline void look_at(const signals::Table& table, const analysis::Summary& summary, Ran& out) {
  for (const signals::Series& s : table.series)
    for (const auto& column : s.columns)
      if (!std::ranges::all_of(column, [](double x) { return std::isfinite(x); })) {
        out.not_finite.push_back(s.topic.name);
        break;
      }
  for (const analysis::Entry& entry : summary.entries())
    if (!std::isfinite(entry.value)) out.not_finite.push_back(entry.key);
}

// The machine's first moments: every phase once, none for long.
inline Ran short_run(experiment::Experiment e, const analysis::Machine& machine) {
  if (e.stand) {
    experiment::Stand& stand = *e.stand;
    stand.duration = std::min(stand.duration, std::max(0.25, 6 * stand.drive.period));
    stand.measured.from = 0;
    if (stand.sweep.step > 0) stand.sweep.step = std::max(stand.sweep.step, 0.3);
  }
  constexpr double most = 0.06;  // of a phase [s]
  e.plan.repeat = 1;
  e.start.settle = std::min(e.start.settle, most);
  e.plan.settle = e.start.settle;
  e.robot.low_level.vent_time = std::min(e.robot.low_level.vent_time, most);
  for (gait::Phase& phase : e.plan.phases) phase.duration = std::min(phase.duration, most);
  e.log.period = std::max(e.log.period, 1e-3);
  run::Outcome outcome = run::run(e, {.threads = 1});
  Ran out;
  out.ended = outcome.ended_early();
  if (out.ended) out.cause = cause_of(e, outcome);
  if (!out.ended) look_at(outcome.table, analysis::summarize(outcome.table, machine), out);
  out.table = std::move(outcome.table);
  return out;
}

}  // namespace sinew::guards
