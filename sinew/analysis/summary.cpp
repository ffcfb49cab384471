#include "sinew/analysis/summary.h"

#include <vector>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/warnings.h"

namespace sinew::analysis {

Summary summarize(const signals::Table& table, const Machine& machine) {
  if (machine.stand) return summarize_stand(table, machine);
  const signals::Table derived = derive(table, machine);
  const Record record(table, machine, &derived);
  Summary summary;
  summary.title = machine.title;
  summary.reproduces = machine.reproduces;
  summary.warnings = texts(warnings(table, machine));
  if (record.rows() == 0) return summary;
  summary.faults = begun_by(machine.faults, record.time(record.rows() - 1));

  Figures figures{machine, record, summary};
  add_run(figures);
  add_trolley(figures);
  const bool one_leg = machine.robot.legs.empty();
  if (one_leg) {
    add_joints(figures);
    add_muscles(figures);
  }
  add_passiveness(figures);
  if (one_leg) {
    add_foot(figures);
    add_ground_reaction(figures);
  }
  add_air(figures);
  add_air_balance(figures);
  add_valves(figures);
  add_machine(figures);
  if (one_leg) add_phases(figures);
  add_legs(figures, table, derived);
  add_supervision(figures);
  return summary;
}

Summary summarize_trip(const signals::Table& table, const Machine& machine) {
  const Record record(table, machine);
  Summary summary;
  summary.title = machine.title;
  summary.warnings = texts(warnings(table, machine));
  if (record.rows() == 0) return summary;
  summary.faults = begun_by(machine.faults, record.time(record.rows() - 1));
  Figures figures{machine, record, summary};
  add_supervision(figures);
  return summary;
}

}  // namespace sinew::analysis
