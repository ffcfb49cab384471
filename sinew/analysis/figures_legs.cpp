#include "sinew/analysis/figures.h"
#include "sinew/analysis/measures/statistics.h"
#include "sinew/analysis/record/legs.h"

namespace sinew::analysis {
namespace {

// The share of the sequence's time in which the ground carries a part of the foot, and how much.
void add_load(Figures& f) {
  const Column load = f.record.column("/true/foot/force", "y");
  if (load.empty() || !f.machine.robot.ground.present) return;
  Column loaded = f.record.new_column();
  for (const double newton : load) loaded.push_back(newton > 0 ? 1.0 : 0.0);
  f.add("foot.loaded_share_true", mean, loaded, f.record.sequence());
  f.add("foot.mean_load_true_N", mean, load, f.record.sequence());
}

}  // namespace

void add_legs(Figures& figures, const signals::Table& table, const signals::Table& derived) {
  for (const MachineLeg& leg : legs_of(figures.machine)) {
    const Record record(table, leg.machine, &derived, leg.name);
    Summary own;
    Figures f{leg.machine, record, own};
    add_joints(f);
    add_muscles(f);
    add_passiveness(f);
    add_foot(f);
    add_load(f);
    add_sole(f);
    add_ground_reaction(f);
    add_air(f);
    add_phases(f);
    for (const Entry& e : own.entries())
      figures.summary.add("legs." + leg.name + "." + e.key, e.value);
  }
}

}  // namespace sinew::analysis
