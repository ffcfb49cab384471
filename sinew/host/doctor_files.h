// host/doctor_files.h - what the doctor reads of a system below a root: text, devices, the groups
// and limits of this process.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::host {

// The text of a file without what ends it; empty where there is none.
std::string text_of(const std::filesystem::path& file);

// Files of a folder whose names start so, sorted.
std::vector<std::filesystem::path> named(const std::filesystem::path& folder,
                                         const std::vector<std::string>& starts);

// Who this process is, by /proc/self/status.
struct User {
  long id = -1, group = -1;
  std::vector<long> groups;
};
User user_of(const std::filesystem::path& root);

// May the user read and write it, by owner, group and mode? The first user may everything.
bool may_use(const std::filesystem::path& file, const User& user);

// The name of the group that a file has, by etc/group; its number where there is no name.
std::string group_of(const std::filesystem::path& file, const std::filesystem::path& root);

// A soft limit by its name in /proc/self/limits; -1: unlimited, 0 where it is not told.
double limit_of(const std::filesystem::path& root, const std::string& name);

}  // namespace sinew::host
