#include "sinew/signals/page_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace sinew::signals {

struct PageFile::Impl {
  ~Impl() {
    if (descriptor >= 0) ::close(descriptor);
  }

  int descriptor = -1;
  int error = 0;                      // errno of the last failure, or 0
  std::array<char, 1024> folder{};    // folder of the file
  std::uint32_t end = 0;              // number of pages in the file
  std::vector<std::uint32_t> unused;  // free pages
};

namespace {

const char* folder_of_temporary_files() noexcept {
  const char* named = std::getenv("TMPDIR");
  return named && *named ? named : "/var/tmp";
}

// Returns a descriptor of a file without a name, or -1.
int nameless_file(const char* folder) noexcept {
  const int fd = ::open(folder, O_TMPFILE | O_RDWR | O_EXCL | O_CLOEXEC, 0600);
  if (fd >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != ENOENT)) return fd;
  // On file systems without O_TMPFILE: a named file that is unlinked at once.
  std::array<char, 1100> path{};
  const int n = std::snprintf(path.data(), path.size(), "%s/sinew-XXXXXX", folder);
  if (n < 0 || static_cast<std::size_t>(n) >= path.size()) return -1;
  const int named = ::mkostemp(path.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(path.data());
  return named;
}

// Writes all bytes; returns false with errno if that fails.
bool write_all(int fd, const char* bytes, std::size_t count, off_t at) noexcept {
  while (count > 0) {
    const ssize_t n = ::pwrite(fd, bytes, count, at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes += n;
    at += n;
    count -= static_cast<std::size_t>(n);
  }
  return true;
}

off_t place_of(std::uint32_t page) {
  return static_cast<off_t>(page) * static_cast<off_t>(PageFile::page_bytes);
}

}  // namespace

PageFile PageFile::make() {
  PageFile file;
  file.impl_ = std::make_shared<Impl>();
  return file;
}

bool PageFile::open(std::size_t pages) noexcept {
  if (!impl_) return false;
  try {
    impl_->unused.reserve(pages);
  } catch (const std::exception&) {
    impl_->error = ENOMEM;
    return false;
  }
  if (impl_->descriptor >= 0) return true;
  const char* folder = folder_of_temporary_files();
  std::snprintf(impl_->folder.data(), impl_->folder.size(), "%s", folder);
  impl_->descriptor = nameless_file(folder);
  if (impl_->descriptor < 0) impl_->error = errno;
  return impl_->descriptor >= 0;
}

std::uint32_t PageFile::write(const void* bytes, std::size_t count) noexcept {
  if (!impl_ || !open(0)) return no_page;
  const bool again = !impl_->unused.empty();
  const std::uint32_t page = again ? impl_->unused.back() : impl_->end;
  if (page == no_page) return no_page;
  if (!write_all(impl_->descriptor, static_cast<const char*>(bytes), count, place_of(page))) {
    impl_->error = errno;
    return no_page;
  }
  if (again)
    impl_->unused.pop_back();
  else
    ++impl_->end;
  return page;
}

bool PageFile::rewrite(std::uint32_t page, std::size_t offset, const void* bytes,
                       std::size_t count) noexcept {
  const bool written = write_all(impl_->descriptor, static_cast<const char*>(bytes), count,
                                 place_of(page) + static_cast<off_t>(offset));
  if (!written) impl_->error = errno;
  return written;
}

bool PageFile::read(std::uint32_t page, void* bytes, std::size_t count) const noexcept {
  char* to = static_cast<char*>(bytes);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t n = ::pread(impl_->descriptor, to + done, count - done,
                              place_of(page) + static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      impl_->error = n < 0 ? errno : EIO;
      return false;
    }
    done += static_cast<std::size_t>(n);
  }
  return true;
}

void PageFile::release(std::uint32_t page) noexcept {
  if (!impl_) return;
  try {
    impl_->unused.push_back(page);
  } catch (const std::bad_alloc&) {
    // The page stays unused until the file is closed.
  }
}

std::size_t PageFile::pages() const noexcept { return impl_ ? impl_->end : 0; }

std::string PageFile::problem() const {
  if (!impl_ || impl_->error == 0) return "";
  return std::string(impl_->folder.data()) +
         ": cannot keep a long run's numbers in a temporary file: " +
         std::generic_category().message(impl_->error) +
         "; make room there, or name another folder by TMPDIR";
}

void fail(const PageFile& file) { throw std::runtime_error(file.problem()); }

}  // namespace sinew::signals
