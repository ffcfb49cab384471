// experiment/log_table.h - what of a run is recorded: [log] of every kind of experiment.
#pragma once

#include <string>
#include <vector>

namespace sinew::experiment {

struct Log {
  bool enabled = true;
  std::vector<std::string> channels = {"*"};  // topics, * for any run of characters
  double period = 0.01;                       // [s]
  bool gains = false;                         // those in effect too; a stand has none
};

}  // namespace sinew::experiment
