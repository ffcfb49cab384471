#include "sinew/plant/hardware/emulator.h"

#include <fcntl.h>
#include <fmt/format.h>
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
#include "sinew/plant/hardware/remote_board.h"

extern char** environ;

namespace sinew::plant {

namespace {

std::string pipe_at(const std::string& path) {
  if (::mkfifo(path.c_str(), 0600) != 0) throw BoardError(path + ": " + std::strerror(errno));
  return path;
}

void set_blocking(int file) { ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK); }

}  // namespace

// --- its process --------------------------------------------------------------------------------

Emulator::Emulator(const std::string& image, Wires wires, int line) : wires_(std::move(wires)) {
  if (!std::filesystem::is_regular_file(image))
    throw BoardError(image + ": there is no such program for the emulator");
  std::string folder = std::filesystem::temp_directory_path() / "sinew-board-XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) throw BoardError(folder + ": " + std::strerror(errno));
  folder_ = folder;
  try {
    from_path_ = pipe_at(folder_ + "/from-board");
    to_path_ = pipe_at(folder_ + "/to-board");
    start(image, line);
    open_pipes();
  } catch (...) {
    quit();
    throw;
  }
}

// With a line there is a clock too: 8 ns for an instruction, as a processor of some 150 MHz has.
void Emulator::start(const std::string& image, int line) {
  constexpr int its_line = 3;  // the emulator's number for it
  std::vector<std::string> words{
      "qemu-system-arm", "-M",   "mps2-an386", "-display", "none",
      "-monitor",        "none", "-kernel",    image,      "-semihosting-config"};
  words.push_back("enable=on,target=native,arg=board,arg=" + from_path_ + ",arg=" + to_path_);
  if (line < 0)
    words.insert(words.end(), {"-serial", "none"});
  else
    words.insert(words.end(),
                 {"-icount", "shift=3,sleep=on", "-chardev",
                  fmt::format("socket,id=line,fd={}", its_line), "-serial", "chardev:line"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  // A Ctrl-C is this program's: it ends the run and vents the board, which has to be there then.
  posix_spawnattr_t own_group;
  ::posix_spawnattr_init(&own_group);
  ::posix_spawnattr_setflags(&own_group, POSIX_SPAWN_SETPGROUP);
  // Where it fails it prints its registers, which say nothing to a user.
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  for (const int file : {0, 1, 2})
    ::posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_RDWR, 0);
  if (line >= 0) ::posix_spawn_file_actions_adddup2(&files, line, its_line);
  const int error =
      ::posix_spawnp(&process_, arguments[0], &files, &own_group, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&own_group);
  if (error == 0) return;
  process_ = -1;
  throw BoardError(std::string("qemu-system-arm cannot be started: ") + std::strerror(error) +
                   "; Debian: apt install qemu-system-arm");
}

// The board opens both pipes before it says anything; whoever opens one to write waits for a
// reader.
void Emulator::open_pipes() {
  from_ = ::open(from_path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  for (int i = 0; i < 1'000 && to_ < 0; ++i) {  // of 10 ms
    to_ = ::open(to_path_.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (to_ >= 0) break;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == process_) {
      process_ = -1;
      throw BoardError("the emulator has ended at once: is the file a program for mps2-an386?");
    }
    ::usleep(10'000);
  }
  if (from_ < 0 || to_ < 0)
    throw BoardError(
        "the program in the emulator does not open its pipes: is it one of firmware/, for "
        "mps2-an386?");
  set_blocking(from_);
  set_blocking(to_);
}

void Emulator::kill() noexcept {
  if (process_ > 0) ::kill(process_, SIGKILL);
}

void Emulator::quit() noexcept {
  for (int* file : {&from_, &to_}) {
    if (*file >= 0) ::close(*file);
    *file = -1;
  }
  kill();
  if (process_ > 0) ::waitpid(process_, nullptr, 0);
  process_ = -1;
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  folder_.clear();
}

// --- its pipes ----------------------------------------------------------------------------------

bool Emulator::fill() {
  buffer_.resize(4'096);
  ssize_t n = 0;
  do {
    n = ::read(from_, buffer_.data(), buffer_.size());
  } while (n < 0 && errno == EINTR);
  buffer_.resize(static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
  first_ = 0;
  return n > 0;
}

std::uint8_t Emulator::byte() {
  if (first_ == buffer_.size() && !fill()) throw Gone{};
  return buffer_[first_++];
}

std::int64_t Emulator::number(int bytes) {
  std::uint64_t out = 0;
  for (int i = 0; i < bytes; ++i) out |= std::uint64_t{byte()} << (8 * i);
  return static_cast<std::int64_t>(out);
}

// A pipe without a reader raises SIGPIPE, which is nobody's wish: it is kept away for this call.
void Emulator::put(std::span<const std::uint8_t> bytes) {
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

void Emulator::valves() {
  const signals::Tick tick = number(8);
  const auto open = static_cast<std::uint32_t>(number(4));
  const std::uint8_t flags = byte();
  wires_.valves(tick, open, (flags & board::has_current) != 0);
}

void Emulator::reading() {
  const signals::Tick tick = number(8);
  const signals::Reading r = wires_.read({byte()}, tick);
  const std::uint8_t answer[] = {static_cast<std::uint8_t>(r.counts),
                                 static_cast<std::uint8_t>(r.counts >> 8),
                                 static_cast<std::uint8_t>(r.status)};
  put(answer);
}

std::uint8_t Emulator::next_record() {
  for (;;) {
    const std::uint8_t kind = byte();
    if (kind == board::record::valves)
      valves();
    else if (kind == board::record::reading)
      reading();
    else
      return kind;
  }
}

}  // namespace sinew::plant
