// python/binding/recording.h - what a run recorded, as Python holds it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/binding/bind.h"
#include "sinew/analysis/summary.h"
#include "sinew/config/node.h"
#include "sinew/signals/table.h"

namespace sinew::python {

// Recording gives its samples out as arrays that stand in its own memory.
class Recording {
 public:
  signals::Table table;
  // Holds what follows from the table; nullptr where the table itself was derived from a run.
  std::unique_ptr<const analysis::Analysis> analysis;
  std::string summary;   // summary.json
  std::string verdicts;  // what is reported of the run, beside it: JSON
  std::vector<std::string> warnings;
  config::Node resolved;  // what was run, as resolved.toml says it
  std::string name;       // of the experiment
  std::string folder;     // where it is kept; empty: nowhere
  std::string board;      // who answered at the port; empty: simulated, or not known

  // "/joint/hip/angle", "/foot/position.x": every channel that there is, with its unit.
  struct Channel {
    std::string name, unit, description;
  };
  std::vector<Channel> channels() const;

  // Throw py::key_error for a channel that there is not.
  const std::vector<double>& values(const std::string& channel);
  const std::vector<double>& time(const std::string& channel);

 private:
  struct Place {
    std::size_t series = 0, field = 0;
  };
  Place find(const std::string& channel) const;

  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> values_;  // once asked for
  std::map<std::size_t, std::vector<double>> times_;
};

// Fills what follows from table and `resolved`, which both stay: summary and verdicts; a part of a
// run has no verdicts.
void sum_up(Recording& recording);

// Returns a page as HTML that a cell of a notebook shows.
py::object in_a_cell(const std::string& page);

// Returns what a kept run's folder, or a log, holds. Throws config::Error and log::Error.
std::shared_ptr<Recording> read_run(const std::string& named);

}  // namespace sinew::python
