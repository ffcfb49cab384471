// cli/figures_thesis.h - `sinew figures --thesis`: the figures of Colbrunn (2000), with verdicts.
#pragma once

#include <string>
#include <vector>

#include "cli/command.h"

namespace sinew::cli {

struct ThesisFiguresRequest {
  std::string out, root = ".";
  std::vector<std::string> formats;
  bool force = false, json = false, quiet = false;
};

ExitCode draw_thesis(const ThesisFiguresRequest& request);

}  // namespace sinew::cli
