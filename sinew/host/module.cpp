#include "sinew/host/module.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
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

void continue_as(std::vector<std::string> words, const std::string& if_missing,
                 const std::string& input) {
  if (!input.empty()) {
    std::FILE* file = ::fdopen(::memfd_create("input", 0), "w+");
    if (!file || std::fwrite(input.data(), 1, input.size(), file) != input.size() ||
        std::fflush(file) != 0 || ::dup2(::fileno(file), STDIN_FILENO) < 0)
      throw std::system_error(errno, std::generic_category(), "the input of " + words[0]);
    std::rewind(file);
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(stdout);
  ::execvp(arguments[0], arguments.data());
  if (errno == ENOENT) throw std::runtime_error(if_missing);
  throw std::system_error(errno, std::generic_category(), words[0] + ": cannot be started");
}

int exit_code_of(const std::vector<std::string>& words, const std::string& if_missing) {
  constexpr int not_started = 127;
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), words[0]);
  if (child == 0) {
    try {
      continue_as(words, "");
    } catch (const std::exception&) {
      ::_exit(not_started);
    }
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  if (!WIFEXITED(status)) return 1;
  if (WEXITSTATUS(status) == not_started) throw std::runtime_error(if_missing);
  return WEXITSTATUS(status);
}

}  // namespace sinew::host
