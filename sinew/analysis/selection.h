// analysis/selection.h - chosen figures of many runs of the same kind, from the channels that they
// need.
//
//   Selection selection({"trolley.distance_m"}, table, machine);   // needs one whole run's table
//   selection.topics()                                             // to be recorded by the others
//   selection.figures(table, machine)                              // for another run
//
// The figures have the bits of summarize(): the same functions compute them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

class Selection {
 public:
  // Finds the topics that the figures of these keys are computed from, by the table of a whole
  // run. A key that its summary lacks may appear in other runs, and the other way round.
  Selection(std::vector<std::string> keys, const signals::Table& table, const Machine& machine);

  // Returns the topics of the log that figures() needs, and those of series derived from them.
  const signals::TopicNames& topics() const { return topics_; }
  // Adds topics that runs like others need.
  void add(const signals::TopicNames& topics) { topics_.insert(topics.begin(), topics.end()); }

  // Returns the figures of these keys, and maybe of others, for a run that recorded at least the
  // topics above; a topic that was not recorded has an empty series. Returns nothing if this run's
  // figures depend on other topics.
  std::optional<Summary> figures(const signals::Table& table, const Machine& machine) const;

 private:
  Summary add(const signals::Table& table, const signals::Table& derived, const Machine& machine,
              signals::TopicNames& read) const;

  std::vector<std::string> keys_;
  signals::TopicNames topics_;  // topics in the log, and derived ones
};

}  // namespace sinew::analysis
