#include "sinew/config/shipped.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "sinew/config/diagnostics.h"

namespace sinew::config {

namespace {

namespace fs = std::filesystem;

// Maximum number of levels from the program or Python's module up to share/sinew or the sources.
constexpr int furthest = 5;

bool is_it(const fs::path& folder) {
  std::error_code none;
  return fs::is_regular_file(folder / "robots/one-joint/robot.toml", none) &&
         fs::is_directory(folder / "experiments", none) &&
         fs::is_directory(folder / "data/templates", none);
}

// Returns the folders of the program and of the library that contains this code.
std::vector<fs::path> beginnings() {
  std::error_code none;
  std::vector<fs::path> out;
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&shipped_folder), &info) != 0 && info.dli_fname)
    out.push_back(fs::weakly_canonical(info.dli_fname, none).parent_path());
  out.push_back(fs::read_symlink("/proc/self/exe", none).parent_path());
  return out;
}

}  // namespace

fs::path shipped_folder() {
  std::error_code none;
  if (const char* named = std::getenv("SINEW_SHARE"); named && *named) {
    if (is_it(named)) return fs::canonical(named, none);
    fail({named, 0, 0}, "SINEW_SHARE", "no robots/, experiments/ and data/templates/ there",
         "the folder share/sinew of an installation, or Sinew's sources",
         "to unset it: then the folder next to the program is used");
  }
  for (fs::path folder : beginnings())
    for (int up = 0; up <= furthest && !folder.empty(); ++up, folder = folder.parent_path())
      for (const fs::path& place : {folder / "share/sinew", folder})
        if (is_it(place)) return fs::canonical(place, none);
  fail({"share/sinew", 0, 0}, "", "nothing near the program",
       "the robots and experiments that come with Sinew", "SINEW_SHARE=FOLDER in the environment");
}

std::string find_shipped(const std::string& name) {
  constexpr const char* folders[] = {"robots/", "experiments/", "studies/", "data/"};
  if (std::ranges::none_of(folders, [&](auto f) { return name.starts_with(f); })) return "";
  std::error_code none;
  try {
    const fs::path own = shipped_folder() / name;
    return fs::is_regular_file(own, none) ? own.string() : "";
  } catch (const Error&) {
    return "";  // nothing is installed near the program: the command names what is missing
  }
}

std::string or_shipped(const std::string& name) {
  std::error_code none;
  if (fs::exists(name, none)) return name;
  const std::string own = find_shipped(name);
  return own.empty() ? name : own;
}

}  // namespace sinew::config
