#include "sinew/port/hardware/emulator.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sinew/control/board/lock_step.h"
#include "sinew/host/temporary_folder.h"
#include "sinew/port/hardware/remote_board.h"

namespace sinew::plant {

namespace {

std::string pipe_at(const std::string& path) {
  if (::mkfifo(path.c_str(), 0600) != 0) throw BoardError(path + ": " + std::strerror(errno));
  return path;
}

void set_blocking(int file) { ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK); }

// Runs in the child process and does not return. The child ends when this program ends for any
// reason.
[[noreturn]] void run_child(char* const* arguments, pid_t parent, int line, int its_line, int why) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  // Ctrl-C must reach only the program: it ends the run and vents the board, which must still
  // exist.
  ::setpgid(0, 0);
  // A failing emulator prints its registers, which are of no use to a user.
  const int nothing = ::open("/dev/null", O_RDWR);
  for (const int file : {0, 1, 2}) ::dup2(nothing, file);
  if (line >= 0) ::dup2(line, its_line);
  ::execvp(arguments[0], arguments);
  const int error = errno;
  (void)!::write(why, &error, sizeof error);
  ::_exit(127);
}

// Starts the child and waits until it runs the emulator.
pid_t start_child(char* const* arguments, int line, int its_line) {
  int why[2];
  if (::pipe2(why, O_CLOEXEC) != 0)
    throw BoardError(std::string("no pipe: ") + std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) run_child(arguments, parent, line, its_line, why[1]);
  int error = child < 0 ? errno : 0;
  ::close(why[1]);
  ssize_t n = 0;
  while (child > 0 && (n = ::read(why[0], &error, sizeof error)) < 0 && errno == EINTR) {}
  ::close(why[0]);
  if (error == 0) return child;
  if (child > 0) ::waitpid(child, nullptr, 0);
  throw BoardError(std::string("qemu-system-arm cannot be started: ") + std::strerror(error) +
                   "; Debian: apt install qemu-system-arm");
}

// Checks by a mark in the image that the program is of the required kind.
void require_kind(const std::string& image, bool in_lock_step) {
  std::ifstream in(image, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto is = [&](const char* kind) { return bytes.find(kind) != bytes.npos; };
  if (is(in_lock_step ? board::lock_step_image : board::application_image)) return;
  if (is(in_lock_step ? board::application_image : board::lock_step_image))
    throw BoardError(fmt::format("{}: found the program {}; expected {}", image,
                                 in_lock_step
                                     ? "for an emulated serial line, application-mps2_an386.elf"
                                     : "for lock step, lock-step.elf",
                                 in_lock_step ? "lock-step.elf" : "application-mps2_an386.elf"));
  throw BoardError(image +
                   ": found no program of firmware/ for mps2-an386, or one of an older version");
}

}  // namespace

// --- its process --------------------------------------------------------------------------------

Emulator::Emulator(const std::string& image, Wires wires, int line) : wires_(std::move(wires)) {
  if (!std::filesystem::is_regular_file(image))
    throw BoardError(image + ": there is no such program for the emulator");
  require_kind(image, line < 0);
  folder_ = host::make_temporary_folder("sinew-board");
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

// An emulator with a serial line also has a clock: 8 ns per instruction, as a processor
// of some 150 MHz takes.
void Emulator::start(const std::string& image, int line) {
  constexpr int its_line = 3;  // number of the socket in the emulator
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

  process_ = start_child(arguments.data(), line, its_line);
}

// The board opens both pipes before it sends anything. Opening a pipe for writing fails until it
// has a reader.
void Emulator::open_pipes() {
  from_ = ::open(from_path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  for (int i = 0; i < 1'000 && to_ < 0; ++i) {  // 10 ms each
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
  if (first_ == buffer_.size() && !fill()) throw Closed{};
  return buffer_[first_++];
}

std::int64_t Emulator::number(int bytes) {
  std::uint64_t out = 0;
  for (int i = 0; i < bytes; ++i) out |= std::uint64_t{byte()} << (8 * i);
  return static_cast<std::int64_t>(out);
}

// A pipe without a reader raises SIGPIPE, which would end the program: it is blocked for this call.
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
  if (!whole) throw Closed{};
}

void Emulator::valves() {
  const signals::Tick tick = number(8);
  const auto open = static_cast<std::uint32_t>(number(4));
  const std::uint8_t flags = byte();
  wires_.valves(tick, open, (flags & board::has_current) != 0);
}

// Sends a failure instead of a reading, if there is one. The board then requests the same reading
// again or, after a reset, does not.
bool Emulator::send_failure(signals::Tick tick) {
  const BoardFailure failure = wires_.failure ? wires_.failure(tick) : BoardFailure{};
  if (failure.what == BoardFailure::What::none) return false;
  const bool stalls = failure.what == BoardFailure::What::stall;
  const std::uint8_t reply[] = {static_cast<std::uint8_t>(failure.ticks),
                                static_cast<std::uint8_t>(failure.ticks >> 8),
                                stalls ? board::failure::stalls : board::failure::resets};
  put(reply);
  return true;
}

void Emulator::reading() {
  const signals::Tick tick = number(8);
  const signals::Channel channel{byte()};
  if (send_failure(tick)) return;
  const signals::Reading r = wires_.read(channel, tick);
  const std::uint8_t reply[] = {static_cast<std::uint8_t>(r.counts),
                                static_cast<std::uint8_t>(r.counts >> 8),
                                static_cast<std::uint8_t>(r.status)};
  put(reply);
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
