#include "sinew/log/lock.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <fstream>
#include <sstream>

namespace sinew::log {
namespace {

// Returns the holder's process id from the kernel's list of locks, which has a line for each:
//   1: FLOCK  ADVISORY  WRITE 4711 fe:00:131080 0 EOF
// Returns "" if it is not listed, for example for a process in another container.
std::string holder_of(int descriptor) {
  struct stat info {};
  if (::fstat(descriptor, &info) != 0) return "";
  const std::string inode = fmt::format(":{}", info.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, mode, pid, place;
    words >> number >> kind >> advisory >> mode >> pid >> place;
    if (kind == "FLOCK" && place.ends_with(inode) && pid != "0") return pid;
  }
  return "";
}

}  // namespace

std::string lock(int descriptor) {
  // If the holder cannot be found, it may have just ended: the next try then takes the lock.
  for (int tries = 0; tries < 10; ++tries) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return "";
    const std::string pid = holder_of(descriptor);
    if (!pid.empty()) return "process " + pid;
  }
  return "another process";
}

void wait_for_lock(int descriptor) {
  while (::flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {}
}

}  // namespace sinew::log
