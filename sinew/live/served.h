// live/served.h - what `sinew view` serves of what is there: runs, or a study.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/live/server.h"
#include "sinew/run/folder/notices.h"

namespace sinew::live {

struct Served {
  std::function<Reply(std::string_view path)> get;              // for a server
  std::function<std::string(const std::string& url)> in_words;  // what stands there
};

// `what`: the folder of a run, a log, or a study's file; empty: the runs below runs/, the newest
// first. `machine`: what was run, in place of a folder's resolved.toml; may be empty. Throws
// config::Error or log::Error where nothing of the kind is there.
Served served(const std::string& what, const std::string& machine, run::Notices notices = {});

// The same of several: none or one is as above, two studies' files stand beside each other.
Served served(const std::vector<std::string>& what, const std::string& machine,
              run::Notices notices = {});

}  // namespace sinew::live
