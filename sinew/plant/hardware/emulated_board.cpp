#include "sinew/plant/hardware/emulated_board.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "sinew/control/board/lock_step.h"

extern char** environ;

namespace sinew::plant {

namespace {

namespace record_kind = board::record;

struct Gone {};  // the emulator has ended, or says what it should not

std::string pipe_at(const std::string& path) {
  if (::mkfifo(path.c_str(), 0600) != 0) throw BoardError(path + ": " + std::strerror(errno));
  return path;
}

void set_blocking(int file) { ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK); }

}  // namespace

// --- its process --------------------------------------------------------------------------------

EmulatedBoard::EmulatedBoard(const std::string& image, Wires wires) : wires_(std::move(wires)) {
  if (!std::filesystem::is_regular_file(image))
    throw BoardError(image + ": there is no such program for the emulator");
  std::string folder = std::filesystem::temp_directory_path() / "sinew-board-XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) throw BoardError(folder + ": " + std::strerror(errno));
  folder_ = folder;
  try {
    from_path_ = pipe_at(folder_ + "/from-board");
    to_path_ = pipe_at(folder_ + "/to-board");
    start(image);
    open_pipes();
  } catch (...) {
    quit();
    throw;
  }
}

void EmulatedBoard::start(const std::string& image) {
  const std::string semihosting =
      "enable=on,target=native,arg=board,arg=" + from_path_ + ",arg=" + to_path_;
  const char* words[] = {"qemu-system-arm",
                         "-M",
                         "mps2-an386",
                         "-nographic",
                         "-monitor",
                         "none",
                         "-serial",
                         "none",
                         "-semihosting-config",
                         semihosting.data(),
                         "-kernel",
                         image.data(),
                         nullptr};
  // A Ctrl-C is this program's: it ends the run and vents the board, which has to be there then.
  posix_spawnattr_t own_group;
  ::posix_spawnattr_init(&own_group);
  ::posix_spawnattr_setflags(&own_group, POSIX_SPAWN_SETPGROUP);
  // Where it fails it prints its registers, which say nothing to a user.
  posix_spawn_file_actions_t quiet;
  ::posix_spawn_file_actions_init(&quiet);
  for (const int file : {0, 1, 2})
    ::posix_spawn_file_actions_addopen(&quiet, file, "/dev/null", O_RDWR, 0);
  const int error =
      ::posix_spawnp(&emulator_, words[0], &quiet, &own_group, const_cast<char**>(words), environ);
  ::posix_spawn_file_actions_destroy(&quiet);
  ::posix_spawnattr_destroy(&own_group);
  if (error == 0) return;
  emulator_ = -1;
  throw BoardError(std::string("qemu-system-arm cannot be started: ") + std::strerror(error) +
                   "; Debian: apt install qemu-system-arm");
}

// The board opens both pipes before it says anything; whoever opens one to write waits for a
// reader.
void EmulatedBoard::open_pipes() {
  from_ = ::open(from_path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  for (int i = 0; i < 1'000 && to_ < 0; ++i) {  // of 10 ms
    to_ = ::open(to_path_.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (to_ >= 0) break;
    int status = 0;
    if (::waitpid(emulator_, &status, WNOHANG) == emulator_) {
      emulator_ = -1;
      throw BoardError("the emulator has ended at once: is the file a program for mps2-an386?");
    }
    ::usleep(10'000);
  }
  if (from_ < 0 || to_ < 0)
    throw BoardError("the program in the emulator does not open its pipes: is it lock-step.elf?");
  set_blocking(from_);
  set_blocking(to_);
}

void EmulatedBoard::quit() noexcept {
  for (int* file : {&from_, &to_}) {
    if (*file >= 0) ::close(*file);
    *file = -1;
  }
  if (emulator_ > 0) {
    ::kill(emulator_, SIGKILL);
    ::waitpid(emulator_, nullptr, 0);
  }
  emulator_ = -1;
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  folder_.clear();
}

EmulatedBoard::~EmulatedBoard() { quit(); }

std::optional<EmulatedBoard::Sizes> EmulatedBoard::end() noexcept {
  try {
    while (!waits_) waits_ = record();
    const std::uint8_t ends[] = {board::ends & 0xff, board::ends >> 8};
    put(ends);
    while (!sizes_) (void)record();
  } catch (const Gone&) {
    gone_ = true;
  }
  quit();
  return sizes_;
}

// --- its pipes ----------------------------------------------------------------------------------

bool EmulatedBoard::fill() {
  buffer_.resize(4'096);
  ssize_t n = 0;
  do {
    n = ::read(from_, buffer_.data(), buffer_.size());
  } while (n < 0 && errno == EINTR);
  buffer_.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  first_ = 0;
  return n > 0;
}

std::uint8_t EmulatedBoard::byte() {
  if (first_ == buffer_.size() && !fill()) throw Gone{};
  return buffer_[first_++];
}

std::int64_t EmulatedBoard::number(int bytes) {
  std::uint64_t out = 0;
  for (int i = 0; i < bytes; ++i) out |= std::uint64_t{byte()} << (8 * i);
  return static_cast<std::int64_t>(out);
}

// A pipe without a reader raises SIGPIPE, which is nobody's wish: it is kept away for this call.
void EmulatedBoard::put(std::span<const std::uint8_t> bytes) {
  sigset_t broken, before;
  ::sigemptyset(&broken);
  ::sigaddset(&broken, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &broken, &before);
  bool whole = true;
  while (!bytes.empty() && whole) {
    const ssize_t n = ::write(to_, bytes.data(), bytes.size());
    if (n > 0) bytes = bytes.subspan(static_cast<std::size_t>(n));
    whole = n > 0 || errno == EINTR;
  }
  if (!whole) {
    const timespec at_once{};
    (void)::sigtimedwait(&broken, nullptr, &at_once);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (!whole) throw Gone{};
}

void EmulatedBoard::valves() {
  const signals::Tick tick = number(8);
  const auto open = static_cast<std::uint32_t>(number(4));
  const std::uint8_t flags = byte();
  wires_.valves(tick, open, (flags & board::has_current) != 0);
}

void EmulatedBoard::reading() {
  const signals::Tick tick = number(8);
  const signals::Reading r = wires_.read({byte()}, tick);
  const std::uint8_t answer[] = {static_cast<std::uint8_t>(r.counts),
                                 static_cast<std::uint8_t>(r.counts >> 8),
                                 static_cast<std::uint8_t>(r.status)};
  put(answer);
}

bool EmulatedBoard::record() {
  switch (byte()) {
    case record_kind::valves:
      valves();
      return false;
    case record_kind::reading:
      reading();
      return false;
    case record_kind::line:
      for (std::int64_t n = number(2); n > 0; --n) in_.push_back(byte());
      return false;
    case record_kind::waits:
      (void)number(8);
      return true;
    case record_kind::sizes: {
      Sizes sizes{.stack = static_cast<std::uint32_t>(number(4))};
      sizes.memory = static_cast<std::uint32_t>(number(4));
      sizes_ = sizes;
      return false;
    }
    default:
      throw Gone{};
  }
}

// --- its line -----------------------------------------------------------------------------------

void EmulatedBoard::answer_period() {
  std::vector<std::uint8_t> all{static_cast<std::uint8_t>(out_.size()),
                                static_cast<std::uint8_t>(out_.size() >> 8)};
  all.insert(all.end(), out_.begin(), out_.end());
  out_.clear();
  waits_ = false;
  put(all);
}

// The board is let go on only by somebody who waits for it.
std::ptrdiff_t EmulatedBoard::read(std::span<std::uint8_t> out, double seconds) {
  constexpr double period = 0.01;
  while (in_.empty()) {
    if (waits_) {
      if (seconds <= 0) return 0;
      seconds -= period;
      answer_period();
    }
    waits_ = record();
  }
  const std::size_t n = std::min(out.size(), in_.size());
  std::copy_n(in_.begin(), n, out.begin());
  in_.erase(in_.begin(), in_.begin() + static_cast<std::ptrdiff_t>(n));
  return static_cast<std::ptrdiff_t>(n);
}

BoardLine EmulatedBoard::line() {
  const auto write = [this](std::span<const std::uint8_t> bytes) {
    if (gone_ || out_.size() + bytes.size() >= board::ends) return false;
    out_.insert(out_.end(), bytes.begin(), bytes.end());
    return true;
  };
  const auto read = [this](std::span<std::uint8_t> out, double seconds) -> std::ptrdiff_t {
    try {
      return gone_ ? -1 : this->read(out, seconds);
    } catch (const Gone&) {
      gone_ = true;
      return -1;
    }
  };
  return {write, read};
}

}  // namespace sinew::plant
