// files/keys_test.h - shipped TOML files, for tests.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>

#include "sinew/config/compose.h"
#include "tests/places.h"

namespace sinew::files {

// Returns the path of each file and its kind.
inline std::map<std::string, std::string> shipped_files() {
  std::map<std::string, std::string> out;
  for (const char* folder : {"robots", "experiments", "studies"}) {
    const std::string root = sinew::test::source_dir() + "/" + folder;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (entry.path().extension() != ".toml") continue;
      const config::Node file = config::compose(entry.path().string());
      out[entry.path().string()] = config::tables_kind(file);
    }
  }
  return out;
}

}  // namespace sinew::files
