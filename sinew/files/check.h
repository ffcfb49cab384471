// files/check.h - check of any file that Sinew reads, or of a run's folder, without running
// anything.
#pragma once

#include <string>
#include <vector>

namespace sinew::files {

// Value without a source.
struct UnsourcedValue {
  std::string key, value, file;
  int line = 0;
};

// Result of a check, as printable sentences, each with its place.
struct Finding {
  std::string file;
  std::vector<std::string> problems, warnings;
  std::vector<std::string> faults;        // effects of the experiment's faults, with their times
  std::vector<UnsourcedValue> unsourced;  // a warning gives their number, text_of() lists them
};

// Checks an experiment, rig, plan, tuning, robot, actuator, valves or wiring file, predict.dat,
// gain*.dat, a run's folder or a log; the kind is found from the file. Returns all faults of the
// file and never throws for them.
Finding check(const std::string& path);

// Returns lines of text: the sentences, a table of the values without a source, then the counts.
std::string text_of(const Finding& finding);

// Returns them as an array of JSON, an object for each file.
std::string json_of(const std::vector<Finding>& findings);

}  // namespace sinew::files
