// tests/cli/program.h - runs the built program in a folder of its own.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::test {

using Words = std::vector<std::string>;

struct Result {
  int code = -1;  // -1: ended by a signal
  std::string out, err;
};

// A folder that is removed afterwards, with the shipped robots/ and experiments/ in it; the program
// runs there, with the settings of config/sinew/settings.toml in it alone.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  Result sinew(const Words& words) const;
  pid_t start(const Words& words) const;  // does not wait

  // Replaces the only occurrence of `from` in a file, and returns its line.
  int edit(const std::string& file, const std::string& from, const std::string& to) const;

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);
std::vector<std::string> names_in(const std::filesystem::path& folder);  // sorted

}  // namespace sinew::test
