#include "tests/cli/program.h"
#include "tests/places.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sinew::test {

namespace fs = std::filesystem;

namespace {

fs::path fresh_folder() {
  std::string name = (fs::temp_directory_path() / "sinew-cli-XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  return name;
}

// In the child: where it writes to and what it is. Does not return.
[[noreturn]] void become(const Words& words, const fs::path& folder, const fs::path& streams) {
  std::vector<char*> arguments{const_cast<char*>("sinew")};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const auto to = [&](const char* name, int stream) {
    const int file = open((streams / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    return file >= 0 && dup2(file, stream) >= 0;
  };
  // The tests do not use the settings of the user who runs them.
  setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
  const bool ready = chdir(folder.c_str()) == 0 && to("out", STDOUT_FILENO) && to("err", 2);
  if (ready) execv(sinew::test::program().c_str(), arguments.data());
  _exit(126);
}

pid_t start_in(const Words& words, const fs::path& folder, const fs::path& streams) {
  const pid_t child = fork();
  if (child == 0) become(words, folder, streams);
  return child;
}

}  // namespace

Workspace::Workspace() : path_(fresh_folder()) {
  unsetenv("SINEW_UNITS");
  for (const char* folder : {"robots", "experiments"})
    fs::copy(fs::path(sinew::test::source_dir()) / folder, path_ / folder,
             fs::copy_options::recursive);
}

Workspace::~Workspace() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Result Workspace::sinew(const Words& words) const {
  const fs::path streams = fresh_folder();
  int status = 0;
  waitpid(start_in(words, path_, streams), &status, 0);
  Result result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(streams / "out"),
                read_text(streams / "err")};
  fs::remove_all(streams);
  return result;
}

pid_t Workspace::start(const Words& words) const { return start_in(words, path_, path_); }

int Workspace::edit(const std::string& file, const std::string& from, const std::string& to) const {
  std::string text = read_text(path_ / file);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << file << " does not say " << from;
  EXPECT_EQ(text.find(from, at + 1), text.npos) << file << " says twice " << from;
  if (at == text.npos) return 0;
  const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  text.replace(at, from.size(), to);
  write_text(path_ / file, text);
  return static_cast<int>(lines) + 1;
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace sinew::test
