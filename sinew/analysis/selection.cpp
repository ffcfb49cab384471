#include "sinew/analysis/selection.h"

#include <algorithm>
#include <utility>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/record.h"
#include "sinew/robot/legs.h"

namespace sinew::analysis {
namespace {

std::string air_in(const Machine& machine, const robot::Muscle& muscle) {
  return robot::logged_topic(machine.robot, "/true/muscle/" + muscle.name + "/air_in");
}

// Returns whether a muscle took air, or whether the table does not show it.
bool took_air(const signals::Table& table, const Machine& machine) {
  return std::ranges::any_of(machine.robot.muscles, [&](const robot::Muscle& muscle) {
    const Column* in = table.column(air_in(machine, muscle));
    return !in || in->empty() || in->back() > in->front();
  });
}

}  // namespace

Selection::Selection(std::vector<std::string> keys, const signals::Table& table,
                     const Machine& machine)
    : keys_(std::move(keys)) {
  (void)add(table, derive(table, machine), machine, topics_);
  TopicNames inputs;  // topics from which derived ones follow
  (void)derive(table, machine, &topics_, &inputs);
  topics_.merge(inputs);
  for (const robot::Muscle& muscle : machine.robot.muscles) topics_.insert(air_in(machine, muscle));
}

Summary Selection::add(const signals::Table& table, const signals::Table& derived,
                       const Machine& machine, TopicNames& read) const {
  const Record record(table, machine, &derived, "", &read);
  Summary summary;
  if (record.rows() == 0) return summary;
  Figures figures{machine, record, summary, &keys_};
  add_figures(figures, table, derived, &read);
  add_supervision(figures);
  return summary;
}

std::optional<Summary> Selection::figures(const signals::Table& table,
                                          const Machine& machine) const {
  TopicNames read;
  const signals::Table derived = derive(table, machine, &topics_, &read);
  Summary summary = add(table, derived, machine, read);
  if (!std::ranges::includes(topics_, read) || !took_air(table, machine)) return std::nullopt;
  return summary;
}

}  // namespace sinew::analysis
