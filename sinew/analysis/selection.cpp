#include "sinew/analysis/selection.h"

#include <algorithm>
#include <utility>

#include "sinew/analysis/figures.h"
#include "sinew/analysis/record/derived.h"
#include "sinew/analysis/record/record.h"

namespace sinew::analysis {

Selection::Selection(std::vector<std::string> keys, const signals::Table& table,
                     const Machine& machine)
    : keys_(std::move(keys)) {
  (void)add(table, derive(table, machine), machine, topics_);
  TopicNames inputs;  // topics from which derived ones follow
  (void)derive(table, machine, &topics_, &inputs);
  topics_.merge(inputs);
}

Summary Selection::add(const signals::Table& table, const signals::Table& derived,
                       const Machine& machine, TopicNames& read) const {
  const Record record(table, machine, &derived, "", &read);
  Summary summary;
  Figures figures{machine, record, summary, &keys_};
  add_figures(figures, table, derived, &read);
  if (record.rows() > 0) add_supervision(figures);
  return summary;
}

std::optional<Summary> Selection::figures(const signals::Table& table,
                                          const Machine& machine) const {
  TopicNames read;
  const signals::Table derived = derive(table, machine, &topics_, &read);
  Summary summary = add(table, derived, machine, read);
  if (!std::ranges::includes(topics_, read)) return std::nullopt;
  return summary;
}

}  // namespace sinew::analysis
