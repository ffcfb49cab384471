#include "sinew/host/module.h"

#include <dlfcn.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace sinew::host {

namespace fs = std::filesystem;

namespace {

// Returns the folders that may contain modules: the program's own, and if this code is in a library
// loaded by another program (Python), those above that library.
std::vector<fs::path> folders() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  std::vector<fs::path> out{program.parent_path() / SINEW_MODULES};
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&open_module), &info) == 0 || !info.dli_fname)
    return out;
  fs::path above = fs::weakly_canonical(info.dli_fname, none);
  if (above == program) return out;
  for (int up = 0; up < 4; ++up) {
    above = above.parent_path();
    out.push_back(above / SINEW_MODULES);
  }
  return out;
}

}  // namespace

fs::path find_module(const char* file) {
  std::error_code none;
  for (const fs::path& folder : folders())
    if (fs::is_regular_file(folder / file, none)) return fs::canonical(folder / file, none);
  return {};
}

void* open_module(const char* file) {
  std::vector<fs::path> places;
  for (const fs::path& folder : folders()) places.push_back(folder / file);
  places.emplace_back(file);
  for (const fs::path& path : places)
    if (void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
  return nullptr;
}

void* function_of(void* module, const char* name) { return dlsym(module, name); }

namespace {

// Returns whether a folder of the PATH has the program; folders without access are passed over.
bool is_there(const std::string& program) {
  std::error_code none;
  if (program.find('/') != std::string::npos) return fs::is_regular_file(program, none);
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nothing sets it
  std::istringstream folders(path ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::is_regular_file(fs::path(folder) / program, none)) return true;
  return false;
}

// Reports why a program did not start. A folder of the PATH without access hides the reason that no
// other folder has the program.
[[noreturn]] void not_started(int reason, const std::string& program,
                              const std::string& if_missing) {
  if (reason == ENOENT || (reason == EACCES && !is_there(program)))
    throw std::runtime_error(if_missing);
  throw std::system_error(reason, std::generic_category(), program + ": cannot be started");
}

std::vector<char*> arguments_of(std::vector<std::string>& words) {
  std::vector<char*> out;
  for (std::string& word : words) out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

// Makes the text this program's stdin; returns false with errno if that fails.
bool read_from(const std::string& text) {
  const int memory = ::memfd_create("input", 0);
  if (memory < 0) return false;
  std::FILE* file = ::fdopen(memory, "w+");
  if (!file || std::fwrite(text.data(), 1, text.size(), file) != text.size() ||
      std::fflush(file) != 0 || ::dup2(memory, STDIN_FILENO) < 0)
    return false;
  std::rewind(file);
  return true;
}

}  // namespace

void continue_as(std::vector<std::string> words, const std::string& if_missing,
                 const std::string& input) {
  if (!input.empty() && !read_from(input))
    throw std::system_error(errno, std::generic_category(), "the input of " + words[0]);
  const std::vector<char*> arguments = arguments_of(words);
  std::fflush(stdout);
  ::execvp(arguments[0], arguments.data());
  not_started(errno, words[0], if_missing);
}

int exit_code_of(std::vector<std::string> words, const std::string& if_missing) {
  const std::vector<char*> arguments = arguments_of(words);
  std::fflush(stdout);
  pid_t child = 0;
  const int reason =
      ::posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ);
  if (reason != 0) not_started(reason, words[0], if_missing);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace sinew::host
