#include "cli/emergency.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace sinew::cli {

namespace {

// Keys at once and without an echo; signals as ever.
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

SpaceBar::SpaceBar(std::function<void()> stop) {
  // Another program in front has the keyboard: this one would be halted for asking.
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
