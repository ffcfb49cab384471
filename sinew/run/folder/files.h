// run/folder/files.h - files that are written whole or not at all, and never in the place of what
// is not theirs; and how a path is refused.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sinew/config/diagnostics.h"
#include "sinew/log/replacement.h"

namespace sinew::run {

// Throws config::Error where the file exists, unless `force`; with it too where the file is one of
// `inputs`, or a log, parameters or a run's summary. `own` names or ends what the caller writes
// itself: "summary.json", ".toml". A pipe or a device is no such file.
void refuse_to_overwrite(const std::filesystem::path& file, bool force,
                         const std::vector<std::filesystem::path>& inputs = {},
                         std::string_view own = "");

// Throws config::Error where the folder that the file is to stand in is missing.
void require_folder_of(const std::filesystem::path& file);

// Takes the place of an older file when it is whole. Throws config::Error or log::Error; then the
// older one stands.
void write_file(const std::filesystem::path& file, std::string_view text,
                log::Replacement::Sync sync = log::Replacement::Sync::now);

// What the sources of this folder refuse a path with.
//
// A setting of the caller's is named as a key with its value: force=true.

// Throws config::Error that begins with the path.
[[noreturn]] inline void refuse(const std::filesystem::path& where, std::string found,
                                std::string expected, std::string try_this = "") {
  config::fail({where.string(), 0, 0}, "", std::move(found), std::move(expected),
               std::move(try_this));
}

}  // namespace sinew::run
