// cli/emergency.h - the space bar as a wish to stop, while a board drives a machine.
#pragma once

#include <functional>
#include <thread>

namespace sinew::cli {

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

}  // namespace sinew::cli
