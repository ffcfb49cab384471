// tune/results/kept.h - a sweep whose rows are kept as they come, and what is to be said of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sinew/run/folder/notices.h"
#include "sinew/tune/results/results.h"

namespace sinew::tune {

// Opens the study's file and takes the rows of the options' share that are there, which are not run
// again. Says how many. Throws what Results throws.
void open_results(const Sweep& sweep, const std::filesystem::path& file, Options& options,
                  std::optional<Results>& results, const run::Notices& notices);

// Warns of rows, and refuses what is no whole table of so many points. `kept` is the file with the
// rows, empty where there is none; `goes_on` says that the same command runs the others. Throws
// std::runtime_error, or config::Error where a figure has no row.
void judge(const std::vector<Row>& rows, const Sweep& sweep, std::size_t points,
           const std::string& kept, bool goes_on, const run::Notices& notices);

}  // namespace sinew::tune
