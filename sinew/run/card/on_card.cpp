#include "sinew/run/card/on_card.h"

#include <algorithm>
#include <array>
#include <span>

#include "sinew/card/walk.h"
#include "sinew/run/card/kernel.h"

namespace sinew::run {
namespace {

// Memory on the card with a copy of these values.
template <class T>
class Copied {
 public:
  Copied(const card::Program& program, std::span<const T> values)
      : buffer_(program, std::max<std::size_t>(values.size_bytes(), sizeof(T))) {
    buffer_.write(std::as_bytes(values));
  }

  // Returns its address on the card.
  T* address() {
    T* out = nullptr;
    std::memcpy(&out, buffer_.parameter(), sizeof out);
    return out;
  }
  void read(std::span<T> values) const { buffer_.read(std::as_writable_bytes(values)); }

 private:
  card::Buffer buffer_;
};

}  // namespace

// Half of what it can compute at the same time is nearly as fast, and each run needs memory of the
// computer.
std::size_t Card::runs() const {
  return static_cast<std::size_t>(std::max(1, properties_.multiprocessors)) * kernel_threads *
         kernel_blocks / 2;
}

card::Program& Card::program() {
  if (!program_) program_.emplace(properties_.number, card::walk_ptx(), "walk");
  return *program_;
}

std::size_t Card::memory() {
  constexpr std::size_t most = std::size_t{2} << 30;  // it is needed in the computer too
  const std::lock_guard lock(mutex_);
  return std::min(most, program().free_memory() / 2);  // half: other programs may take some
}

void Card::launch(const Batched& batched) {
  const std::lock_guard lock(mutex_);
  card::Program& on = program();
  Copied<Walk> walks(on, batched.walks);
  Copied<control::Command> commands(on, batched.commands);
  Copied<std::uint16_t> wanted(on, batched.wanted);
  Copied<std::uint64_t> sample(on, batched.sample);
  Copied<std::uint32_t> edge(on, batched.edge);

  Launch launch{commands.address(),
                {wanted.address(), static_cast<std::int32_t>(batched.wanted.size()),
                 batched.samples, batched.edges, static_cast<std::int64_t>(batched.walks.size()),
                 sample.address(), edge.address()}};
  Walk* first = walks.address();
  std::array<void*, 2> parameters = {&first, &launch};
  const std::size_t blocks = (batched.walks.size() + kernel_threads - 1) / kernel_threads;
  on.launch(static_cast<unsigned>(blocks), kernel_threads, parameters);
  on.wait();
  walks.read(batched.walks);
  sample.read(batched.sample);
  edge.read(batched.edge);
}

}  // namespace sinew::run
