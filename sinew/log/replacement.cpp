#include "sinew/log/replacement.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <optional>

namespace sinew::log {
namespace {

namespace fs = std::filesystem;

const char* const advice = "make room, or choose a folder that exists and that you may write to";

// Returns the number in "/dev/fd/3", a descriptor that is open in this process.
std::optional<int> own_descriptor(const fs::path& file) {
  const std::string folder = file.parent_path().string(), name = file.filename().string();
  if (folder != "/dev/fd" && folder != "/proc/self/fd") return {};
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc{} || end != name.data() + name.size() || number < 0) return {};
  return number;
}

bool same_file(int descriptor, const fs::path& name) {
  struct stat a {
  }, b{};
  return ::fstat(descriptor, &a) == 0 && ::lstat(name.c_str(), &b) == 0 && a.st_dev == b.st_dev &&
         a.st_ino == b.st_ino;
}

fs::path visible_part(const fs::path& target) { return target.string() + ".part"; }

[[noreturn]] void fail_taken(const fs::path& part) {
  throw Error(part, "stands already: rows of an interrupted sweep, or a file of yours",
              "move it elsewhere or remove it");
}

// Returns the process that is writing the file, or "".
std::string writer_of(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return "";
  std::string holder = lock(fd);
  ::close(fd);
  return holder;
}

}  // namespace

fs::path followed(fs::path file) {
  std::error_code none;
  for (int i = 0; i < 40 && !own_descriptor(file) && fs::is_symlink(file, none); ++i) {
    const fs::path to = fs::read_symlink(file, none);
    file = to.is_absolute() ? to : file.parent_path() / to;
  }
  return file;
}

std::string hidden_name(std::string_view name) {
  return std::string(".").append(name).append(".sinew");
}

void require_free_part(const fs::path& file) {
  if (is_written_directly(file)) return;
  const fs::path part = visible_part(followed(file));
  struct stat info {};
  if (::lstat(part.c_str(), &info) != 0) return;
  if (const std::string holder = writer_of(part); !holder.empty())
    throw Error(file, holder + " is writing it", "wait for it, or choose another name");
  if (::lstat(part.c_str(), &info) != 0) return;  // its writer has just finished
  fail_taken(part);
}

Replacement::Replacement(const fs::path& file, Sync sync, Part part) : file_(file), sync_(sync) {
  const fs::path target = followed(file);
  if (const auto number = own_descriptor(target)) {
    part_ = file_;
    fd_ = ::fcntl(*number, F_DUPFD_CLOEXEC, 0);
    if (fd_ < 0) fail(errno);
    return;
  }
  struct stat old {};
  if (::stat(target.c_str(), &old) == 0) {
    if (!S_ISREG(old.st_mode)) {
      part_ = file_;
      fd_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
      if (fd_ < 0) fail(errno);
      return;
    }
    if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail(errno);
  }
  target_ = target;
  part_ = target_.parent_path() / hidden_name(target_.filename().string());
  open_part();
  if (part == Part::kept) show_part(visible_part(target_));
}

// Opens the part; one left by a killed process is overwritten.
void Replacement::open_part() {
  for (;;) {
    fd_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (fd_ < 0) fail(errno);
    const std::string holder = lock(fd_);
    if (holder.empty() && same_file(fd_, part_)) break;
    ::close(fd_);
    fd_ = -1;
    if (!holder.empty())
      throw Error(file_, holder + " is writing it", "wait for it, or choose another name");
  }
  // The destructor does not run if the constructor throws from here on.
  struct stat old {};
  int error = ::ftruncate(fd_, 0) == 0 ? 0 : errno;
  if (error == 0 && ::stat(target_.c_str(), &old) == 0 && ::fchmod(fd_, old.st_mode & 07777) != 0)
    error = errno;
  if (error == 0) return;
  ::unlink(part_.c_str());
  ::close(fd_);
  fail(error);
}

// Renames the part to a name that must be unused, in one step.
void Replacement::show_part(const fs::path& name) {
  const auto give_up = [this] {
    ::unlink(part_.c_str());
    ::close(fd_);
  };
  while (::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) != 0) {
    const int error = errno;
    if (error != EEXIST) {
      give_up();
      fail(error);
    }
    try {
      require_free_part(file_);  // if it has become free, tries again
    } catch (...) {
      give_up();
      throw;
    }
  }
  part_ = name;
  kept_ = true;
}

Replacement::~Replacement() {
  if (fd_ < 0) return;
  if (!target_.empty() && !kept_) ::unlink(part_.c_str());
  ::close(fd_);
}

void Replacement::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void Replacement::commit() {
  if (!target_.empty()) {
    if (sync_ == Sync::now && ::fsync(fd_) != 0) fail(errno);
    if (::rename(part_.c_str(), target_.c_str()) != 0) fail(errno);
  }
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0) fail(errno);
  if (target_.empty() || sync_ == Sync::later) return;
  if (const int error = sync_folder(target_.parent_path())) fail(error);
}

void Replacement::fail(int error) const {
  throw Error(file_, "cannot be written: " + system_error_text(error), advice);
}

bool is_written_directly(const fs::path& file) {
  const fs::path target = followed(file);
  struct stat info {};
  return own_descriptor(target) ||
         (::stat(target.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode));
}

int sync_folder(const fs::path& folder) noexcept {
  const int fd = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return errno == EACCES ? 0 : errno;  // a folder whose entries may not be read
  const int error = ::fsync(fd) == 0 ? 0 : errno;
  ::close(fd);
  return error == EINVAL || error == ENOTSUP ? 0 : error;  // not supported by the file system
}

}  // namespace sinew::log
