// python/binding/recording.h - recorded run held by Python.
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
#include "sinew/report/compare/comparison.h"
#include "sinew/signals/table.h"

namespace sinew::python {

// Recorded run that provides its samples as arrays in its own memory.
class Recording {
 public:
  signals::Table table;
  // Analysis of the table; nullptr if the table itself was derived from a run.
  std::unique_ptr<const analysis::Analysis> analysis;
  std::string summary;   // summary.json
  std::string verdicts;  // comparison with reported figures: JSON
  std::vector<std::string> warnings;
  config::Node resolved;  // the run's resolved.toml
  std::string name;       // name of the experiment
  std::string folder;     // folder of the run; empty: not kept
  std::string board;      // board at the port; empty: simulated, or unknown

  // Channel with its unit: "/joint/hip/angle", "/foot/position.x".
  struct Channel {
    std::string name, unit, description;
  };
  std::vector<Channel> channels() const;

  // Return the samples and their times. Throw py::key_error for an unknown channel.
  const std::vector<double>& values(const std::string& channel);
  const std::vector<double>& time(const std::string& channel);

 private:
  struct Place {
    std::size_t series = 0, field = 0;
  };
  Place find(const std::string& channel) const;

  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> values_;  // cache
  std::map<std::size_t, std::vector<double>> times_;
};

// Sets the summary and the verdicts from `table` and `resolved`, which are kept; a part of a run
// has no verdicts.
void summarize(Recording& recording);

// Returns HTML that shows a page in a notebook cell.
py::object in_a_cell(const std::string& page);

// Returns the alignment of that name. Throws ValueError for another word.
report::Align align_of(const std::string& word);

// Reads a kept run's folder or a log. Throws config::Error and log::Error.
std::shared_ptr<Recording> read_run(const std::string& named);

}  // namespace sinew::python
