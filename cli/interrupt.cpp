#include "cli/interrupt.h"

#include <time.h>

#include <cstdint>

namespace sinew::cli {

namespace {

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

// A window that closes sends several signals, and an impatient person as well: they wait.
void on_interrupt_of_machine(int which) {
  std::int64_t none = 0;
  const std::int64_t now = seconds();
  interrupted = true;
  if (since.compare_exchange_strong(none, now) || now - none < patience) return;
  ::signal(which, SIG_DFL);
  ::raise(which);
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

const std::atomic<bool>& Interrupt::asked() const { return interrupted; }

void Interrupt::ask() { interrupted = true; }

void survive_file_limits() { signal(SIGXFSZ, SIG_IGN); }

}  // namespace sinew::cli
