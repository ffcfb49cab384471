#include "cli/interrupt.h"

namespace sinew::cli {

namespace {

constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};

// A signal handler may touch this flag at any time, so it outlives every listener.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int) { interrupted = true; }

}  // namespace

Interrupt::Interrupt() {
  interrupted = false;
  struct sigaction listen {};
  listen.sa_handler = on_interrupt;
  listen.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (int i = 0; i < 3; ++i) sigaction(ending_signals[i], &listen, &before_[i]);
}

Interrupt::~Interrupt() {
  for (int i = 0; i < 3; ++i) sigaction(ending_signals[i], &before_[i], nullptr);
}

const std::atomic<bool>& Interrupt::asked() const { return interrupted; }

void Interrupt::ask() { interrupted = true; }

void survive_file_limits() { signal(SIGXFSZ, SIG_IGN); }

}  // namespace sinew::cli
