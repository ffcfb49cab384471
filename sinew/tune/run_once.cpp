#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/compose.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/run/simulation/run.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune {
namespace {

// Returns the first problem, as one line of a table.
std::string first_problem(const config::Error& e) {
  const std::size_t more = e.problems().size() - 1;
  return config::to_text(e.problems().front()) +
         (more > 0 ? fmt::format(" (and {} more)", more) : "");
}

std::string status_of(const experiment::Experiment& e, const run::Outcome& outcome) {
  if (outcome.ended_early()) return "ended early: " + cause_of(e, outcome);
  if (!outcome.table.complete) return "more valve edges than there was room for";
  return "ok";
}

// Adds judgements of the figures that are not part of the summary.
void compare_with_reported(const run::Outcome& outcome, const analysis::Machine& machine,
                           RunResult& out) {
  out.no_air = !analysis::unused_air(outcome.table, machine).empty();
  for (const analysis::Verdict& v :
       analysis::compare(out.summary, machine.reported, machine.atmosphere))
    if (v.agreement == analysis::Verdict::Agreement::differs) out.differs.push_back(v.key);
}

// Returns the run that `work` fills, or its refusal.
template <class Work>
RunResult refusing(const Work& work) {
  RunResult out;
  try {
    work(out);
  } catch (const config::Error& e) {
    out.status = "refused: " + first_problem(e);
  } catch (const std::exception& e) {
    out.status = std::string("refused: ") + e.what();
  }
  return out;
}

// A run that is ready to begin.
struct Prepared {
  Prepared(const RequestedRun& requested, config::Composer& files, bool allow_unreachable)
      : Prepared(requested, files.compose(requested.experiment, requested.sets),
                 allow_unreachable) {}
  Prepared(const RequestedRun& requested, const config::Node& root, bool allow_unreachable)
      : point(requested.point),
        machine(analysis::read_machine(root)),
        experiment(run::buildable(root, requested.experiment)) {
    if (!allow_unreachable) experiment::refuse_unreachable(experiment);
  }

  std::size_t point;
  analysis::Machine machine;
  experiment::Experiment experiment;
};

// Summarises the table in memory; no log is written.
void summarize(const Prepared& p, const run::Outcome& outcome, RunResult& out) {
  out.status = status_of(p.experiment, outcome);
  out.atmosphere = p.machine.atmosphere;
  if (!out.ok()) return;
  out.summary = analysis::summarize(outcome.table, p.machine);
  compare_with_reported(outcome, p.machine, out);
}

}  // namespace

RunResult run_once(const std::string& file, const std::vector<std::string>& sets,
                   bool allow_unreachable) {
  config::Composer files;
  return run_once(file, sets, allow_unreachable, files);
}

RunResult run_once(const std::string& file, const std::vector<std::string>& sets,
                   bool allow_unreachable, config::Composer& files) {
  return refusing([&](RunResult& out) {
    const Prepared p({0, file, sets}, files, allow_unreachable);
    summarize(p, run::run(p.experiment), out);
  });
}

void run_many(const Many& many) {
  std::vector<std::unique_ptr<Prepared>> going;
  config::Composer own;
  config::Composer& files = many.files ? *many.files : own;
  const auto prepare = [&](const RequestedRun& requested) {
    std::unique_ptr<Prepared> p;
    RunResult refused = refusing([&](RunResult&) {
      p = std::make_unique<Prepared>(requested, files, many.allow_unreachable);
    });
    if (!p) many.done(requested.point, std::move(refused));
    return p;
  };
  const auto next = [&]() -> const experiment::Experiment* {
    while (const std::optional<RequestedRun> requested = many.next())
      if (std::unique_ptr<Prepared> p = prepare(*requested))
        return &going.emplace_back(std::move(p))->experiment;
    return nullptr;
  };
  const auto done = [&](const experiment::Experiment& e, const run::Outcome& outcome,
                        const std::exception_ptr& thrown) {
    const auto it =
        std::ranges::find_if(going, [&](const auto& p) { return &p->experiment == &e; });
    const std::unique_ptr<Prepared> p = std::move(*it);
    going.erase(it);
    many.done(p->point, refusing([&](RunResult& out) {
                if (thrown) std::rethrow_exception(thrown);
                summarize(*p, outcome, out);
              }));
  };
  run::run_in_lanes({.next = next, .done = done, .most = many.lanes});
}

}  // namespace sinew::tune
