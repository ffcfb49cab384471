// python/binding/used.h - one thread at a time at what is changed without Python's lock.
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>

namespace sinew::python {

class Used {
 public:
  // The thing is in use as long as this lives. Throws std::runtime_error, which calls it `what`,
  // where another thread, or a signal's handler within a call, has it.
  class Now {
   public:
    Now(Used& used, const char* what) : used_(used) {
      if (used_.now_.exchange(true, std::memory_order_acquire))
        throw std::runtime_error(std::string(what) +
                                 ": another thread is at it; expected one thread at a time; try a "
                                 "copy for each thread (copy.copy)");
    }
    Now(const Now&) = delete;
    Now& operator=(const Now&) = delete;
    ~Now() { used_.now_.store(false, std::memory_order_release); }

   private:
    Used& used_;
  };

 private:
  std::atomic<bool> now_{false};
};

}  // namespace sinew::python
