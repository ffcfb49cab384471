// cli/interrupt.h - Ctrl-C, SIGTERM and a terminal that closes as a wish, while something is to be
// brought to an end first.
#pragma once

#include <signal.h>

#include <array>
#include <atomic>
#include <functional>
#include <thread>

namespace sinew::cli {

// While it lives, the first of these signals only sets asked(). A second one ends the program as if
// nobody had listened; where a machine is driven only after ten seconds, in which it is brought to
// rest, and Ctrl-Z and Ctrl-\ are signals like the others. One of them lives at a time.
class Interrupt {
 public:
  enum class Of { work, machine };

  explicit Interrupt(Of of = Of::work);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const std::atomic<bool>& asked() const;
  void ask();  // as a signal would

 private:
  std::array<struct sigaction, 5> before_{};
  std::size_t count_ = 0;
};

// While it lives, the space bar calls `stop`, and so does a terminal that is gone; nothing where
// stdin is no terminal. The terminal is as it was afterwards.
class SpaceBar {
 public:
  explicit SpaceBar(std::function<void()> stop);
  ~SpaceBar();
  SpaceBar(const SpaceBar&) = delete;
  SpaceBar& operator=(const SpaceBar&) = delete;

  bool listens() const { return thread_.joinable(); }

 private:
  int end_[2] = {-1, -1};  // a pipe that ends the thread
  std::thread thread_;
};

// A file that may not grow further is an error of write(), which is told, and not this program's
// death.
void survive_file_limits();

}  // namespace sinew::cli
