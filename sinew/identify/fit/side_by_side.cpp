#include "sinew/identify/fit/side_by_side.h"

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace sinew::identify {

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& attempt, Tally* done) {
  std::vector<std::exception_ptr> failed(count);
  std::atomic<std::size_t> begun = 0;
  const auto work = [&] {
    for (std::size_t i = begun++; i < count; i = begun++) {
      const std::size_t k = count - 1 - i;
      try {
        attempt(k);
      } catch (...) {
        failed[k] = std::current_exception();
      }
      if (done) ++*done;
    }
  };
  {
    std::vector<std::jthread> others;
    const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
    for (std::size_t t = 1; t < std::min(cores, count); ++t) others.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& error : failed)
    if (error) std::rethrow_exception(error);
}

}  // namespace sinew::identify
