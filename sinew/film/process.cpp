#include "sinew/film/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>

extern char** environ;

namespace sinew::film {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

// Above the numbers that a program is given, so that none is overwritten before it is copied.
int moved_up(int file) {
  const int out = ::fcntl(file, F_DUPFD_CLOEXEC, 20);
  const int error = errno;
  ::close(file);
  if (out < 0) fail(error, "a pipe");
  return out;
}

}  // namespace

fs::path find_program(const std::vector<std::string>& names) {
  const char* path = std::getenv("PATH");
  if (!path) return {};
  for (const std::string& name : names) {
    std::istringstream folders(path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const fs::path file = fs::path(folder) / name;
      std::error_code none;
      if (::access(file.c_str(), X_OK) == 0 && fs::is_regular_file(file, none)) return file;
    }
  }
  return {};
}

End& End::operator=(End&& other) noexcept {
  if (this != &other) {
    close();
    file_ = std::exchange(other.file_, -1);
  }
  return *this;
}

void End::close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

Pipe Pipe::make() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail(errno, "a pipe");
  End read(moved_up(ends[0])), write(moved_up(ends[1]));
  return {std::move(read), std::move(write)};
}

pid_t start(const std::vector<std::string>& arguments, const std::vector<Given>& files,
            const fs::path& words) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, words.c_str(),
                                   O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  for (const Given& g : files) posix_spawn_file_actions_adddup2(&actions, g.file, g.as);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<std::string> texts = arguments;
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  pid_t pid = -1;
  const int error =
      posix_spawn(&pid, texts[0].c_str(), &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail(error, arguments[0]);
  return pid;
}

int wait_for(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool ends_within(pid_t pid, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    // Left to be waited for: only looked at.
    siginfo_t info{};
    if (waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        info.si_pid == pid)
      return true;
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void kill_group(pid_t pid) { ::kill(-pid, SIGKILL); }

bool write_all(int file, std::string_view bytes) {
  // A closed pipe is an error of this write and does not end the program.
  sigset_t pipe, before;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe, &before);
  bool whole = true;
  while (whole && !bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n >= 0) bytes.remove_prefix(static_cast<std::size_t>(n));
    whole = n >= 0 || errno == EINTR;
  }
  if (!whole) {
    const timespec at_once{};
    while (sigtimedwait(&pipe, nullptr, &at_once) == SIGPIPE) {}
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return whole;
}

std::string last_words(const fs::path& words) {
  std::ifstream in(words);
  std::string before, last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) before = std::exchange(last, line);
  return before.empty() ? last : before + "; " + last;
}

}  // namespace sinew::film
