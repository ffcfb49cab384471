// cli/view.h - what the two kinds of `sinew view` share.
#pragma once

#include <cstdint>
#include <string>

#include "cli/command.h"
#include "cli/run.h"

namespace sinew::cli {

struct ViewOptions {
  std::string run, machine;  // recorded
  RunOptions live;           // .run.experiment empty: a recorded one
  int port = 0;              // 0: a free one
  bool open = true, once = false, paused = false;
};

// A run while it goes. Ends with it, or stays with its page until Ctrl-C.
ExitCode view_live(const ViewOptions& options);

}  // namespace sinew::cli
