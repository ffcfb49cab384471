// run/folder/refusal.h - what the sources of this folder refuse a path with.
//
// A setting of the caller's is named as a key with its value: force=true.
#pragma once

#include <filesystem>
#include <string>

#include "sinew/config/diagnostics.h"

namespace sinew::run {

// Throws config::Error that begins with the path.
[[noreturn]] inline void refuse(const std::filesystem::path& where, std::string found,
                                std::string expected, std::string try_this = "") {
  config::fail({where.string(), 0, 0}, "", std::move(found), std::move(expected),
               std::move(try_this));
}

}  // namespace sinew::run
