// python/binding/used.h - guard for objects that are changed without Python's lock: one thread at a
// time.
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>

namespace sinew::python {

class Used {
 public:
  // Marks the object as used during the lifetime of this guard. Throws std::runtime_error, which
  // calls the object `what`, if another thread, or a signal handler within a call, uses it.
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
