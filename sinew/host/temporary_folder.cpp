#include "sinew/host/temporary_folder.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

namespace sinew::host {

std::string make_temporary_folder(const std::string& name) {
  const char* named = std::getenv("TMPDIR");
  const bool is_named = named && *named;
  const std::string parent = is_named ? named : "/tmp";
  std::string path = parent + "/" + name + "-XXXXXX";
  if (::mkdtemp(path.data())) return path;
  const int error = errno;
  throw std::runtime_error(fmt::format("{}{}: cannot make a folder for temporary files: {}; {}",
                                       is_named ? "TMPDIR: " : "", parent,
                                       std::generic_category().message(error),
                                       "name a folder that exists and can be written by TMPDIR"));
}

}  // namespace sinew::host
