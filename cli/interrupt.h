// cli/interrupt.h - Ctrl-C, SIGTERM and a terminal that closes as a wish, while something is to be
// brought to an end first.
#pragma once

#include <signal.h>

#include <atomic>

namespace sinew::cli {

// While it lives, the first of these signals only sets asked(); a second one ends the program as if
// nobody had listened.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const std::atomic<bool>& asked() const;
  void ask();  // as a signal would

 private:
  struct sigaction before_[3]{};
};

// A file that may not grow further is an error of write(), which is told, and not this program's
// death.
void survive_file_limits();

}  // namespace sinew::cli
