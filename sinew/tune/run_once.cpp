#include <fmt/format.h>

#include "sinew/analysis/verdict/reported.h"
#include "sinew/analysis/warnings.h"
#include "sinew/config/compose.h"
#include "sinew/run/setup/buildable.h"
#include "sinew/run/simulation/run.h"
#include "sinew/tune/sweep.h"

namespace sinew::tune {
namespace {

// The first of what is wrong, in one line of a table.
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

// What the summary alone does not show of its figures.
void judge(const run::Outcome& outcome, const analysis::Machine& machine, Ran& out) {
  out.no_air = !analysis::unused_air(outcome.table, machine).empty();
  for (const analysis::Verdict& v :
       analysis::compare(out.summary, machine.reported, machine.atmosphere))
    if (v.is == analysis::Verdict::Is::differs) out.differs.push_back(v.key);
}

}  // namespace

// The log's files are not written: the summary is of the table in memory.
Ran run_once(const std::string& file, const std::vector<std::string>& sets,
             bool allow_unreachable) {
  Ran out;
  try {
    const config::Node root = config::compose(file, sets);
    const analysis::Machine machine = analysis::read_machine(root);
    const experiment::Experiment e = run::buildable(root, file);
    if (!allow_unreachable) experiment::refuse_unreachable(e);
    const run::Outcome outcome = run::run(e);
    out.status = status_of(e, outcome);
    out.atmosphere = machine.atmosphere;
    if (!out.ok()) return out;
    out.summary = analysis::summarize(outcome.table, machine);
    judge(outcome, machine, out);
  } catch (const config::Error& e) {
    out.status = "refused: " + first_problem(e);
  } catch (const std::exception& e) {
    out.status = std::string("refused: ") + e.what();
  }
  return out;
}

}  // namespace sinew::tune
