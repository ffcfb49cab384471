#include "sinew/report/figures/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

namespace sinew::report {
namespace {

// With its settings as delivered: nothing of the user's, nothing of this terminal.
pid_t start(const std::filesystem::path& folder, std::string argument) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string name = "gnuplot", defaults = "-d";
  char* const arguments[] = {name.data(), defaults.data(), argument.data(), nullptr};
  pid_t pid = -1;
  if (posix_spawnp(&pid, name.c_str(), &actions, nullptr, arguments, environ) != 0) pid = -1;
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

bool succeeds(pid_t pid) {
  int status = 0;
  while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR) {}
  return pid > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

bool has_gnuplot() {
  // Nothing to do: it ends at once.
  return succeeds(start({}, "/dev/null"));
}

std::vector<std::string> draw(const std::filesystem::path& folder,
                              const std::vector<std::string>& scripts) {
  const std::size_t at_once = std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
  std::vector<std::string> failed;
  for (std::size_t first = 0; first < scripts.size(); first += at_once) {
    const std::size_t last = std::min(first + at_once, scripts.size());
    std::vector<pid_t> running;
    for (std::size_t i = first; i < last; ++i) running.push_back(start(folder, scripts[i]));
    for (std::size_t i = first; i < last; ++i)
      if (!succeeds(running[i - first])) failed.push_back(scripts[i]);
  }
  return failed;
}

// The rest of a PDF knows by their places where its parts are, so blanks take the date's place.
void take_date_out(const std::filesystem::path& pdf) {
  std::ostringstream text;
  text << std::ifstream(pdf, std::ios::binary).rdbuf();
  std::string bytes = text.str();
  const std::size_t from = bytes.rfind("/CreationDate (");
  const std::size_t to = bytes.find(')', from == bytes.npos ? bytes.size() : from);
  if (to == bytes.npos) return;
  bytes.replace(from, to + 1 - from, std::string(to + 1 - from, ' '));
  std::ofstream(pdf, std::ios::binary) << bytes;
}

}  // namespace sinew::report
