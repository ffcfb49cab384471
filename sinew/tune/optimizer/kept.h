// tune/optimizer/kept.h - a tuning whose study is kept in a file: each row as soon as its run is
// done, each candidate as soon as its generation is.
#pragma once

#include <filesystem>
#include <functional>

#include "sinew/run/folder/notices.h"
#include "sinew/tune/optimizer/optimize.h"

namespace sinew::tune {

// How a tuning is run that is kept in a file.
struct KeptOptions {
  TuneOptions tune;                        // without known and done
  std::function<void()> ask_to_stop = {};  // called where a row cannot be written
  run::Notices notices = {};
};

// Goes on with what the file has, or makes it. Says a note for each generation. Throws what
// optimize() and Results throw; what was done by then is in the file.
Tuned optimize_kept(const Tuning& tuning, const std::filesystem::path& file,
                    const KeptOptions& options);

}  // namespace sinew::tune
