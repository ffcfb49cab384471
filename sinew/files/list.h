// files/list.h - robots, experiments, rigs, studies and examples: those that come with Sinew, and
// those in a folder.
//
//   for (const files::Listed& one : files::list("robots").files) …one.path, one.title…
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

// Returns the kinds: robots, experiments, rigs, studies, examples.
std::span<const std::string_view> listed_kinds();

// One file, or the folder of an example.
struct Listed {
  std::string kind;   // one of listed_kinds()
  std::string path;   // as a command takes it here: relative where it is below this folder
  std::string title;  // the file's own: its title, else what its first comment says, else its name
  std::string problem;   // why it has no title; empty: it can be read
  bool shipped = false;  // comes with Sinew
};

// What there is, and where it was looked for.
struct Listing {
  std::string shipped_from;   // the folder of those that come with Sinew; empty: it was not found
  std::vector<Listed> files;  // by kind, those that come with Sinew first, by path
  bool cut = false;           // the folder has more than was looked at
};

// What there is of one kind, or of all where it is empty. `here` is searched with the folders below
// it, but for hidden ones, runs and builds. Throws config::Error for a kind that there is not, and
// for a folder that cannot be read.
Listing list(const std::string& kind = "", const std::filesystem::path& here = ".");

// Returns lines of text: a heading per kind and place, then path and title of each.
std::string text_of(const Listing& listing, const std::string& kind = "");

// Returns all of it as JSON, sinew.list/1.
std::string json_of(const Listing& listing);

}  // namespace sinew::files
