// host/realtime.h - for as long as it lives the calling thread comes before all others and its
// memory stays where it is, as far as this user may ask for that.
#pragma once

#include <string>
#include <vector>

namespace sinew::host {

// Above a kernel's threads of interrupts (50), below those that keep the kernel itself alive.
inline constexpr int priority = 80;

// Puts the thread first when it is made, and back when it ends.
class RealTime {
 public:
  // Take memory before: what comes later is not locked. Never throws: what is not permitted is
  // left out.
  RealTime() noexcept;
  ~RealTime();
  RealTime(const RealTime&) = delete;
  RealTime& operator=(const RealTime&) = delete;

  bool first() const noexcept { return first_; }    // SCHED_FIFO
  bool locked() const noexcept { return locked_; }  // what it has of memory

 private:
  bool first_ = false, locked_ = false;
};

// What was not permitted, and what to do about it; empty where all was.
std::vector<std::string> problems(const RealTime& real_time);

}  // namespace sinew::host
