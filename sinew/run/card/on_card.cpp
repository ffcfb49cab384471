#include "sinew/run/card/on_card.h"

#include <algorithm>
#include <array>
#include <span>

#include "sinew/card/walk.h"
#include "sinew/run/card/kernel.h"

namespace sinew::run {
namespace {

// Memory on the card for as many values.
template <class T>
class OnCard {
 public:
  OnCard(const card::Program& program, std::size_t count)
      : buffer_(program, std::max<std::size_t>(count, 1) * sizeof(T)) {}
  // Copies the values to the card.
  OnCard(const card::Program& program, std::span<const T> values) : OnCard(program, values.size()) {
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

// Runs a batch with the program of a card.
void launch_with(card::Program& program, const Batched& batched) {
  OnCard<Walk> walks(program, batched.walks);
  OnCard<control::Command> commands(program, batched.commands);
  OnCard<std::uint16_t> wanted(program, batched.wanted);
  OnCard<std::uint64_t> sample(program, batched.sample.size());
  OnCard<std::uint32_t> edge(program, batched.edge.size());

  Launch launch{commands.address(),
                {wanted.address(), static_cast<std::int32_t>(batched.wanted.size()),
                 batched.samples, batched.edges, static_cast<std::int64_t>(batched.walks.size()),
                 sample.address(), edge.address()}};
  Walk* first = walks.address();
  std::array<void*, 2> parameters = {&first, &launch};
  const std::size_t blocks = (batched.walks.size() + kernel_threads - 1) / kernel_threads;
  program.launch(static_cast<unsigned>(blocks), kernel_threads, parameters);
  program.wait();
  walks.read(batched.walks);
  sample.read(batched.sample);
  edge.read(batched.edge);
}

}  // namespace

// This is half of the runs that the card can compute at the same time: more are hardly faster, and
// each needs memory of the computer too.
std::size_t Card::runs() const {
  return static_cast<std::size_t>(std::max(1, properties_.multiprocessors)) * kernel_threads *
         kernel_blocks / 2;
}

card::Program& Card::program() {
  if (!program_) program_.emplace(properties_.number, card::walk_ptx(), "walk");
  return *program_;
}

std::size_t Card::memory() {
  constexpr std::size_t most = std::size_t{2} << 30;  // the computer needs as much
  const std::lock_guard lock(mutex_);
  return std::min(most, program().free_memory() / 2);  // half: other programs may take some
}

void Card::launch(const Batched& batched) {
  const std::lock_guard lock(mutex_);
  try {
    launch_with(program(), batched);
  } catch (...) {
    program_.reset();  // a failed launch ends its context
    has_failed_ = true;
    throw;
  }
}

}  // namespace sinew::run
