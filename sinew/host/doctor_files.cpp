#include "sinew/host/doctor_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sinew::host {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream all;
  all << in.rdbuf();
  std::string text = all.str();
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

std::vector<fs::path> named(const fs::path& folder, const std::vector<std::string>& starts) {
  std::vector<fs::path> out;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    if (std::ranges::any_of(starts, [&](const std::string& s) { return name.starts_with(s); }))
      out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

User user_of(const fs::path& root) {
  User out;
  std::istringstream lines(text_of(root / "proc/self/status"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    long real = 0, effective = -1;
    words >> name;
    if (name == "Uid:" && words >> real >> effective) out.id = effective;
    if (name == "Gid:" && words >> real >> effective) out.group = effective;
    if (name == "Groups:")
      for (long group; words >> group;) out.groups.push_back(group);
  }
  return out;
}

bool may_use(const fs::path& file, const User& user) {
  struct stat is {};
  if (::stat(file.c_str(), &is) != 0) return false;
  if (user.id == 0) return true;
  constexpr mode_t both = 06;
  if (static_cast<long>(is.st_uid) == user.id) return (is.st_mode >> 6 & both) == both;
  const auto group = static_cast<long>(is.st_gid);
  if (group == user.group || std::ranges::count(user.groups, group) > 0)
    return (is.st_mode >> 3 & both) == both;
  return (is.st_mode & both) == both;
}

std::string group_of(const fs::path& file, const fs::path& root) {
  struct stat is {};
  if (::stat(file.c_str(), &is) != 0) return "";
  const std::string number = std::to_string(is.st_gid);
  std::istringstream lines(text_of(root / "etc/group"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, password, id;
    std::getline(words, name, ':');
    std::getline(words, password, ':');
    std::getline(words, id, ':');
    if (id == number) return name;
  }
  return number;
}

double limit_of(const fs::path& root, const std::string& name) {
  std::istringstream lines(text_of(root / "proc/self/limits"));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(name)) continue;
    std::istringstream words(line.substr(name.size()));
    std::string soft;
    words >> soft;
    return soft == "unlimited" ? -1 : std::atof(soft.c_str());
  }
  return 0;
}

}  // namespace sinew::host
