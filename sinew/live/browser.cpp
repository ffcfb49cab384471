#include "sinew/live/browser.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>

extern char** environ;

namespace sinew::live {

namespace {

namespace fs = std::filesystem;

// Writes a new file of mode 0600. Returns its name, or "" if it cannot be written.
fs::path private_file(const std::string& text) {
  const char* own = std::getenv("XDG_RUNTIME_DIR");
  std::error_code none;
  const fs::path folder = own && *own ? fs::path(own) : fs::temp_directory_path(none);
  if (folder.empty()) return {};  // TMPDIR is no folder; the address is printed anyway
  std::string name = (folder / "sinew-view-XXXXXX.html").string();
  const int file = mkstemps(name.data(), 5);  // length of ".html"
  if (file < 0) return {};
  const bool whole = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  if (whole) return name;
  ::unlink(name.c_str());
  return {};
}

void start_quietly(std::string program, std::string word) {
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int out : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, out, "/dev/null", O_WRONLY, 0);
  char* const arguments[] = {program.data(), word.data(), nullptr};
  pid_t pid = 0;
  posix_spawnp(&pid, program.c_str(), &quiet, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&quiet);
}

}  // namespace

Browser::Browser(const std::string& url) {
  if (url.empty() || (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))) return;
  redirecting_page_ = private_file(fmt::format(
      "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Sinew</title><meta "
      "http-equiv=\"refresh\" content=\"0; url={0}\"></head><body><a "
      "href=\"{0}\">{0}</a></body></html>\n",
      url));
  if (!redirecting_page_.empty()) start_quietly("xdg-open", redirecting_page_.string());
}

Browser::~Browser() {
  std::error_code ignored;
  if (!redirecting_page_.empty()) fs::remove(redirecting_page_, ignored);
}

}  // namespace sinew::live
