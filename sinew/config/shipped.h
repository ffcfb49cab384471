// config/shipped.h - location of the robots, experiments and valves shipped with Sinew.
//
//   config::shipped_folder() / "experiments/walk-test-1.toml"
//
// An installation has them in share/sinew below its prefix, a build in the source tree above it.
// The environment variable SINEW_SHARE takes precedence, for a program moved away from its files.
#pragma once

#include <filesystem>
#include <string>

namespace sinew::config {

// Returns the folder that contains robots/, experiments/ and data/. Throws config::Error
// if it is not found.
std::filesystem::path shipped_folder();

// Returns the path of the shipped file of this name, "experiments/walk-test-1.toml"; empty if no
// such file ships.
std::string find_shipped(const std::string& name);

// Returns the same if the current folder has no file of that name; else the name.
std::string or_shipped(const std::string& name);

}  // namespace sinew::config
