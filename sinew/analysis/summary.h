// analysis/summary.h - results of a run: its figures, warnings and verdicts, from its log.
#pragma once

#include <string>
#include <vector>

#include "sinew/analysis/record/machine.h"
#include "sinew/analysis/record/record.h"
#include "sinew/analysis/verdict/compare.h"
#include "sinew/analysis/verdict/reported.h"
#include "sinew/analysis/warnings.h"
#include "sinew/signals/table.h"

namespace sinew::analysis {

// Holds all results of a run's channels and its description. It is made once and handed to summary,
// page, figures and Python.
struct Analysis {
  // Makes the results of a table, which has to outlive them. `why` is the cause that ended a run
  // before its time and is empty for other runs: the summary of an ended run has counts and the
  // cause, without a whole run's figures. The source reports whole runs, so that an ended run, and
  // a log that was cut off, have no verdicts.
  Analysis(const signals::Table& table, Machine machine, std::string why = "");
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  const signals::Table& table;
  const std::string ended;  // `why`
  const Machine machine;
  const signals::Table derived;  // channels that follow from those of the table
  const Record record;           // `table` and `derived` as rows
  const std::vector<Warning> warnings;
  const Summary summary;
  const std::vector<Verdict> verdicts;
};

// Returns the figures of a whole run, and its warnings.
Summary summarize(const signals::Table&, const Machine&);

}  // namespace sinew::analysis
