#include "sinew/analysis/summary.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/state_hash.h"
#include "sinew/analysis/warnings.h"

namespace sinew::analysis {

void add_figures(Figures& figures, const signals::Table& table, const signals::Table& derived,
                 TopicNames* read) {
  if (figures.machine.stand) return add_stand(figures);
  if (figures.record.rows() == 0) return;
  add_run(figures);
  add_trolley(figures);
  const bool one_leg = figures.machine.robot.legs.empty();
  if (one_leg) {
    add_joints(figures);
    add_muscles(figures);
  }
  add_smallest_passiveness(figures, "");
  if (one_leg) {
    add_foot(figures);
    add_ground_reaction(figures);
  }
  add_air(figures);
  add_air_balance(figures);
  add_valves(figures);
  add_machine(figures);
  if (one_leg) add_phases(figures);
  add_legs(figures, table, derived, read);
}

namespace {

// Returns whether the table has true values, which only a simulation has.
bool is_simulated(const signals::Table& table) {
  return std::ranges::any_of(table.series, [](const signals::Series& series) {
    return series.topic.name.starts_with("/true/");
  });
}

// Returns the time of the last row, or without rows that of the last sample [s].
double last_time(const Analysis& a) {
  if (a.record.rows() > 0) return a.record.time(a.record.rows() - 1);
  std::int64_t last = -1;
  for (const signals::Series& series : a.table.series)
    if (!series.time_ns.empty()) last = std::max(last, series.time_ns.back());
  return static_cast<double>(last) / 1e9;
}

Summary summary_of(const Analysis& a) {
  const bool whole = a.ended.empty();
  Summary summary;
  summary.title = a.machine.title;
  if (whole) summary.reproduces = a.machine.reproduces;
  summary.warnings = texts(a.warnings);
  summary.faults = begun_by(a.machine.faults, last_time(a));
  Figures figures{a.machine, a.record, summary};
  if (whole) add_figures(figures, a.table, a.derived);
  if (a.record.rows() > 0) add_supervision(figures);
  if (whole && a.table.complete && is_simulated(a.table)) summary.state_hash = state_hash(a.table);
  summary.cut_off = !a.table.complete;
  return summary;
}

std::vector<Verdict> verdicts_of(const Analysis& a) {
  if (!a.ended.empty() || !a.table.complete) return {};
  return compare(a.summary, a.machine.reported, a.machine.atmosphere);
}

}  // namespace

Analysis::Analysis(const signals::Table& of, Machine its, std::string why)
    : table(of),
      ended(std::move(why)),
      machine(std::move(its)),
      derived(derive(table, machine)),
      record(table, machine, &derived),
      warnings(analysis::warnings(table, machine)),
      summary(summary_of(*this)),
      verdicts(verdicts_of(*this)) {}

Summary summarize(const signals::Table& table, const Machine& machine) {
  return Analysis(table, machine).summary;
}

}  // namespace sinew::analysis
