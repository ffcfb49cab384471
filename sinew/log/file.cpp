#include "sinew/log/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <fmt/format.h>
#include <sys/file.h>
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>

namespace sinew::log {
namespace {

const char* const kWhereToLook = "check the name, and that `sinew run` wrote a log there";

// Unlinks an old file instead of truncating it, as it may be mapped by a reader; keeps one that is
// being written.
void unlink_old_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return;
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const std::string holder = fd < 0 ? "" : lock(fd);
  if (holder.empty()) std::filesystem::remove(path, ignored);
  if (fd >= 0) ::close(fd);
  if (!holder.empty())
    throw Error(path, "cannot create the log: " + holder + " is writing it",
                "wait for it, or choose another name");
}

}  // namespace

Mapping::Mapping(const std::filesystem::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw Error(path, "cannot open the log: " + system_error_text(errno), kWhereToLook);
  try {
    map(fd, path);
  } catch (...) {
    ::close(fd);
    throw;
  }
  ::close(fd);
}

Mapping::Mapping(int descriptor, const std::filesystem::path& path) { map(descriptor, path); }

void Mapping::map(int fd, const std::filesystem::path& path) {
  struct stat info {};
  const bool regular = ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
  size_ = regular ? static_cast<std::size_t>(info.st_size) : 0;
  void* at = size_ ? ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd, 0) : nullptr;
  const int error = errno;
  if (!regular) throw Error(path, "not a file", "name the log itself, for instance log.mcap");
  if (size_ == 0) throw Error(path, "the file is empty", "run the experiment again");
  if (at == MAP_FAILED)
    throw Error(path, "cannot read the log: " + system_error_text(error),
                "copy it to a local disk");
  data_ = static_cast<const char*>(at);
}

void Mapping::release(std::size_t from, std::size_t count) const noexcept {
  (void)::madvise(const_cast<char*>(data_) + from, count, MADV_DONTNEED);
}

void Mapping::release_before(const char* here) const noexcept {
  const auto read = static_cast<std::size_t>(here - data_);
  for (; released_ + stride <= read; released_ += stride) release(released_, stride);
}

std::uint32_t Mapping::crc(std::size_t bytes) const {
  std::uint32_t out = 0;
  for (std::size_t at = 0; at < bytes; at += stride) {
    out = crc32(this->bytes().substr(at, std::min(stride, bytes - at)), out);
    if (bytes - at > stride) release(at, stride);
  }
  return out;
}

Mapping::~Mapping() { ::munmap(const_cast<char*>(data_), size_); }

Output::Output(const std::filesystem::path& path) {
  unlink_old_file(path);
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd_ < 0)
    throw Error(path, "cannot create the log: " + system_error_text(errno),
                "choose a folder that exists and that you may write to");
  (void)lock(fd_);  // the file is new, so the lock is free
}

Output::~Output() { close(); }

bool Output::write(std::string_view bytes) noexcept {
  while (!bytes.empty() && error_ == 0) {
    const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      error_ = errno;
      break;
    }
    const auto done = static_cast<std::size_t>(n);
    crc_ = crc32(bytes.substr(0, done), crc_);
    position_ += done;
    bytes.remove_prefix(done);
  }
  return error_ == 0;
}

bool Output::sync() noexcept {
  if (error_ == 0 && ::fsync(fd_) != 0) error_ = errno;
  return error_ == 0;
}

bool Output::is_file_at(const std::filesystem::path& path) const noexcept {
  struct stat mine {
  }, named{};
  return fd_ >= 0 && ::fstat(fd_, &mine) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         mine.st_dev == named.st_dev && mine.st_ino == named.st_ino;
}

bool Output::close() noexcept {
  if (fd_ >= 0 && ::close(fd_) != 0 && error_ == 0) error_ = errno;
  fd_ = -1;
  return error_ == 0;
}

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string system_error_text(int error) { return std::generic_category().message(error); }

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
