// cli/interrupt.h - Ctrl-C, SIGTERM, a terminal that closes and the space bar as requests to stop,
// so that work is completed first.
#pragma once

#include <signal.h>

#include <array>
#include <atomic>
#include <functional>
#include <thread>

namespace sinew::cli {

// During its lifetime the first of these signals only sets requested(). A second one ends the
// program by the signal's default; where a machine is driven only after ten seconds, in which the
// machine is stopped, and Ctrl-Z and Ctrl-\ are handled alike. At most one object exists at a time.
class Interrupt {
 public:
  enum class Of { work, machine };

  explicit Interrupt(Of of = Of::work);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const std::atomic<bool>& requested() const;
  void request();  // as a signal would

 private:
  std::array<struct sigaction, 5> before_{};
  std::size_t count_ = 0;
};

// During its lifetime the space bar calls `stop`, and so does a terminal that closes; without
// effect where stdin is no terminal. The terminal's mode is restored.
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

// Makes a file that may not grow further an error of write() instead of the end of this program.
void survive_file_limits();

}  // namespace sinew::cli
