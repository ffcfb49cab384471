// files/shipped.h - where the robots and experiments are that come with Sinew.
//
//   files::shipped_folder() / "experiments/walk-test-1.toml"
//
// An installation has them in share/sinew below its prefix, a build in the sources above it. The
// environment's SINEW_SHARE comes first, for a program that was moved away from its files.
#pragma once

#include <filesystem>

namespace sinew::files {

// The folder that has robots/, experiments/ and data/templates/ in it. Throws config::Error where
// none is found.
std::filesystem::path shipped_folder();

}  // namespace sinew::files
