// run/folder/files.h - atomic writing of files, protection of other programs' files, and refusal of
// paths.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/log/replacement.h"

namespace sinew::run {

// Throws config::Error if the file exists and `force` is false. Throws even with `force` if the
// file is one of `inputs`, a log, a parameter file or a run's summary. `own` is the name or
// extension of the files that the caller itself writes: "summary.json", ".toml". Pipes and devices
// are always accepted.
void refuse_to_overwrite(const std::filesystem::path& file, bool force,
                         const std::vector<std::filesystem::path>& inputs = {},
                         std::string_view own = "");

// Throws config::Error if the folder that is to contain the file is missing, and log::Error if it
// may not be written to.
void require_folder_of(const std::filesystem::path& file);

// Writes the file completely and then replaces an older one. Throws config::Error or log::Error;
// the older file is then unchanged.
void write_file(const std::filesystem::path& file, std::string_view text,
                log::Replacement::Sync sync = log::Replacement::Sync::now);

// Refusal of a path by the sources of this folder. A setting of the caller is named as a key with
// its value: force=true.

// Throws a config::Error that begins with the path.
[[noreturn]] inline void refuse(const std::filesystem::path& where, std::string found,
                                std::string expected, std::string try_this = "") {
  config::fail({where.string(), 0, 0}, "", std::move(found), std::move(expected),
               std::move(try_this));
}

}  // namespace sinew::run
