// files/check.h - what is wrong with a file, or a run's folder, of any kind that Sinew reads,
// without running anything.
#pragma once

#include <string>
#include <vector>

namespace sinew::files {

// A value of which nobody says where it comes from.
struct Unsourced {
  std::string key, value, file;
  int line = 0;
};

// Sentences as they are printed, each with its place.
struct Finding {
  std::string file;
  std::vector<std::string> problems, warnings;
  std::vector<std::string> faults;   // what the experiment breaks, and when
  std::vector<Unsourced> unsourced;  // a warning tells how many, the text has them as a table
};

// Looks at an experiment, rig, plan, tuning, robot, actuator, valves or wiring file, predict.dat,
// gain*.dat, a run's folder or log; which of them the file says. Never throws for what is wrong
// with it: that is what it returns.
Finding check(const std::string& path);

// Returns lines of text: its sentences, a table of the values without a source, then how many
// there are.
std::string text_of(const Finding& finding);

// Returns them as an array of JSON, an object for each file.
std::string json_of(const std::vector<Finding>& findings);

}  // namespace sinew::files
