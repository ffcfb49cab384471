// files/list.h - listing of robots, experiments, rigs, studies, valves and examples, both those
// shipped with Sinew and those in a folder.
//
//   for (const files::Listed& one : files::list("robots").files) …one.path, one.title…
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

// Returns the kinds: robots, experiments, rigs, studies, valves, examples.
std::span<const std::string_view> listed_kinds();

// Listed file, or the folder of an example.
struct Listed {
  std::string kind;      // one of listed_kinds()
  std::string path;      // as a command takes it: relative if it is below the folder
  std::string title;     // its title, else its first comment, else its name
  std::string problem;   // reason for a missing title; empty: the file can be read
  bool shipped = false;  // shipped with Sinew
};

// Result of a listing.
struct Listing {
  std::string shipped_from;   // folder of the shipped files; empty: not found
  std::vector<Listed> files;  // sorted by kind, shipped ones first, then by path
  bool cut = false;           // whether the search stopped at its limit
};

// Lists the files of a kind, or of all kinds if it is empty. Searches `here` and the folders below
// it, except hidden ones, runs and builds. Throws config::Error for an unknown kind and for a
// folder that cannot be read.
Listing list(const std::string& kind = "", const std::filesystem::path& here = ".");

// Returns lines of text: a heading for each kind and place, then the path and title of each file.
std::string text_of(const Listing& listing, const std::string& kind = "");

// Returns the list as JSON, sinew.list/1.
std::string json_of(const Listing& listing);

}  // namespace sinew::files
