// cli/run_rig.h - `sinew run` of an experiment on the test stand.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace sinew::cli {

struct RigOptions {
  std::string experiment, folder;
  std::vector<std::string> sets;
  bool force = false, report = true, json = false, quiet = false;
};

// Is the file's format sinew.rig?
bool is_rig(const std::string& path);

ExitCode run_rig(const RigOptions& options);

}  // namespace sinew::cli
