#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/compose.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/lanes.h"
#include "sinew/run/simulation/run.h"
#include "sinew/tune/run_many.h"
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
void judge(const run::Outcome& outcome, const analysis::Machine& machine, Ran& out) {
  out.no_air = !analysis::unused_air(outcome.table, machine).empty();
  for (const analysis::Verdict& v :
       analysis::compare(out.summary, machine.reported, machine.atmosphere))
    if (v.is == analysis::Verdict::Is::differs) out.differs.push_back(v.key);
}

// Returns the run that `work` fills, or its refusal.
template <class Work>
Ran refusing(const Work& work) {
  Ran out;
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
  Prepared(const Wanted& wanted, bool allow_unreachable)
      : Prepared(wanted, config::compose(wanted.experiment, wanted.sets), allow_unreachable) {}
  Prepared(const Wanted& wanted, const config::Node& root, bool allow_unreachable)
      : point(wanted.point),
        machine(analysis::read_machine(root)),
        experiment(run::buildable(root, wanted.experiment)) {
    if (!allow_unreachable) experiment::refuse_unreachable(experiment);
  }

  std::size_t point;
  analysis::Machine machine;
  experiment::Experiment experiment;
};

// Summarises the table in memory; no log is written.
void sum_up(const Prepared& p, const run::Outcome& outcome, Ran& out) {
  out.status = status_of(p.experiment, outcome);
  out.atmosphere = p.machine.atmosphere;
  if (!out.ok()) return;
  out.summary = analysis::summarize(outcome.table, p.machine);
  judge(outcome, p.machine, out);
}

}  // namespace

Ran run_once(const std::string& file, const std::vector<std::string>& sets,
             bool allow_unreachable) {
  return refusing([&](Ran& out) {
    const Prepared p({0, file, sets}, allow_unreachable);
    sum_up(p, run::run(p.experiment), out);
  });
}

void run_many(const Many& many) {
  std::vector<std::unique_ptr<Prepared>> going;
  const auto prepare = [&](const Wanted& wanted) {
    std::unique_ptr<Prepared> p;
    Ran refused =
        refusing([&](Ran&) { p = std::make_unique<Prepared>(wanted, many.allow_unreachable); });
    if (!p) many.done(wanted.point, std::move(refused));
    return p;
  };
  const auto next = [&]() -> const experiment::Experiment* {
    while (const std::optional<Wanted> wanted = many.next())
      if (std::unique_ptr<Prepared> p = prepare(*wanted))
        return &going.emplace_back(std::move(p))->experiment;
    return nullptr;
  };
  const auto done = [&](const experiment::Experiment& e, const run::Outcome& outcome,
                        const std::exception_ptr& thrown) {
    const auto it =
        std::ranges::find_if(going, [&](const auto& p) { return &p->experiment == &e; });
    const std::unique_ptr<Prepared> p = std::move(*it);
    going.erase(it);
    many.done(p->point, refusing([&](Ran& out) {
                if (thrown) std::rethrow_exception(thrown);
                sum_up(*p, outcome, out);
              }));
  };
  run::run_in_lanes({.next = next, .done = done, .most = many.lanes});
}

}  // namespace sinew::tune
