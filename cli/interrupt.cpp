#include <poll.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>

#include "cli/interrupt.h"

namespace sinew::cli {

namespace {

// --- signals ---

constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP};
constexpr std::size_t of_work = 3;
constexpr std::int64_t patience = 10;  // [s]

// A signal handler may touch these at any time, so they outlive every listener.
std::atomic<bool> interrupted{false};
std::atomic<std::int64_t> since{0};  // [s], of the first; 0: none yet
static_assert(std::atomic<bool>::is_always_lock_free &&
              std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec + 1;
}

void on_interrupt(int) { interrupted = true; }

// A window that closes sends several signals, and so does an impatient operator: later ones wait.
void on_interrupt_of_machine(int which) {
  std::int64_t none = 0;
  const std::int64_t now = seconds();
  interrupted = true;
  if (since.compare_exchange_strong(none, now) || now - none < patience) return;
  ::signal(which, SIG_DFL);
  ::raise(which);
}

// --- space bar ---

// Delivers keys at once and without an echo; signals are unchanged.
class KeysAtOnce {
 public:
  KeysAtOnce() {
    if (::tcgetattr(0, &before_) != 0) return;
    termios mode = before_;
    mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    changed_ = ::tcsetattr(0, TCSANOW, &mode) == 0;
  }
  ~KeysAtOnce() {
    if (changed_) ::tcsetattr(0, TCSANOW, &before_);
  }
  KeysAtOnce(const KeysAtOnce&) = delete;
  KeysAtOnce& operator=(const KeysAtOnce&) = delete;

 private:
  termios before_{};
  bool changed_ = false;
};

void listen(int end, const std::function<void()>& stop) {
  const KeysAtOnce keys;
  pollfd both[] = {{0, POLLIN, 0}, {end, POLLIN, 0}};
  for (;;) {
    if (::poll(both, 2, -1) < 0) continue;
    if (both[1].revents != 0) return;
    char key = 0;
    if (::read(0, &key, 1) != 1) return stop();  // the terminal is gone, with or without SIGHUP
    if (key == ' ') stop();
  }
}

}  // namespace

Interrupt::Interrupt(Of of) {
  interrupted = false;
  since = 0;
  const bool machine = of == Of::machine;
  count_ = machine ? before_.size() : of_work;
  struct sigaction listen {};
  listen.sa_handler = machine ? on_interrupt_of_machine : on_interrupt;
  listen.sa_flags = SA_RESTART | (machine ? 0 : static_cast<int>(SA_RESETHAND));
  for (std::size_t i = 0; i < count_; ++i) sigaction(ending_signals[i], &listen, &before_[i]);
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < count_; ++i) sigaction(ending_signals[i], &before_[i], nullptr);
}

const std::atomic<bool>& Interrupt::requested() const { return interrupted; }

void Interrupt::request() { interrupted = true; }

void survive_file_limits() { signal(SIGXFSZ, SIG_IGN); }

SpaceBar::SpaceBar(std::function<void()> stop) {
  // In the background this program would be halted for reading the keyboard.
  if (::isatty(0) == 0 || ::tcgetpgrp(0) != ::getpgrp() || ::pipe(end_) != 0) return;
  thread_ = std::thread([end = end_[0], stop = std::move(stop)] { listen(end, stop); });
}

SpaceBar::~SpaceBar() {
  if (!thread_.joinable()) return;
  ::close(end_[1]);
  thread_.join();
  ::close(end_[0]);
}

}  // namespace sinew::cli
