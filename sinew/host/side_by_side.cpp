#include "sinew/host/side_by_side.h"

#include <algorithm>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

namespace sinew::host {

int threads_of(int requested) {
  return requested > 0 ? requested
                       : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work, Tally* done,
                  int threads) {
  std::vector<std::exception_ptr> failed(count);
  std::atomic<std::size_t> begun = 0;
  const std::atomic<bool>* const stop = Stoppable::flag();
  const auto some = [&] {
    const Stoppable stoppable(stop);
    for (std::size_t i = begun++; i < count; i = begun++) {
      const std::size_t k = count - 1 - i;
      try {
        if (is_stopped()) throw Stopped();
        work(k);
      } catch (...) {
        failed[k] = std::current_exception();
      }
      if (done) ++*done;
    }
  };
  {
    std::vector<std::jthread> others;
    const auto wanted = std::min(static_cast<std::size_t>(threads_of(threads)), count);
    for (std::size_t t = 1; t < wanted; ++t) others.emplace_back(some);
    some();
  }
  for (const std::exception_ptr& error : failed)
    if (error) std::rethrow_exception(error);
}

namespace {
thread_local const std::atomic<bool>* current = nullptr;
}  // namespace

Stoppable::Stoppable(const std::atomic<bool>* stop) : before_(std::exchange(current, stop)) {}
Stoppable::~Stoppable() { current = before_; }
const std::atomic<bool>* Stoppable::flag() { return current; }

}  // namespace sinew::host
