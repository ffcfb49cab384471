// Loaded before the C library (LD_PRELOAD), it makes one call that writes to the disk fail as on a
// full disk: the call number SINEW_FAIL_WRITE. It then makes the file SINEW_FAIL_TOLD. Output to
// stdin, stdout and stderr is not counted.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

namespace {

std::atomic<long> calls{0};

bool fails(int descriptor) {
  static const char* const which = std::getenv("SINEW_FAIL_WRITE");
  if (!which || descriptor <= 2 || ++calls != std::atol(which)) return false;
  if (const char* told = std::getenv("SINEW_FAIL_TOLD"))
    syscall(SYS_close, syscall(SYS_openat, AT_FDCWD, told, O_CREAT | O_WRONLY, 0600));
  errno = ENOSPC;
  return true;
}

constexpr int no_descriptor = 3;  // counted

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int fd, const void* data, size_t size) {
  if (fails(fd)) return -1;
  return next<ssize_t (*)(int, const void*, size_t)>("write")(fd, data, size);
}

ssize_t writev(int fd, const iovec* data, int count) {
  if (fails(fd)) return -1;
  return next<ssize_t (*)(int, const iovec*, int)>("writev")(fd, data, count);
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
  if (fails(fd)) return -1;
  return next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite")(fd, data, size, at);
}

ssize_t pwrite64(int fd, const void* data, size_t size, off64_t at) {
  if (fails(fd)) return -1;
  return next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64")(fd, data, size, at);
}

int fdatasync(int fd) {
  if (fails(fd)) return -1;
  return next<int (*)(int)>("fdatasync")(fd);
}

int fsync(int fd) {
  if (fails(fd)) return -1;
  return next<int (*)(int)>("fsync")(fd);
}

int ftruncate(int fd, off_t length) noexcept {
  if (fails(fd)) return -1;
  return next<int (*)(int, off_t)>("ftruncate")(fd, length);
}

int rename(const char* from, const char* to) noexcept {
  if (fails(no_descriptor)) return -1;
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}
}
