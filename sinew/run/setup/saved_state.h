// run/setup/saved_state.h - a state as bytes, which another process can restore: a header with its
// format, a hash of the model that it belongs to and a checksum, followed by the state itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sinew::run {

// Kind of a saved state: the name of its format, and words for its source and its model in
// messages.
struct SavedKind {
  const char* format;  // "sinew.save/1", at most 15 letters
  const char* source;  // "Simulation::save"
  const char* model;   // "experiment"
};

inline constexpr std::size_t saved_header_size = 32;  // [bytes]

// Returns the state with its header. `model` is a hash of everything that the state depends on.
std::vector<std::byte> sealed(const SavedKind& kind, std::uint64_t model,
                              std::span<const std::byte> state);

// Returns the state in the bytes of sealed(), of `size` bytes. Throws std::invalid_argument if they
// are no such bytes, incomplete or corrupted, or belong to another model or version.
std::span<const std::byte> unsealed(const SavedKind& kind, std::uint64_t model, std::size_t size,
                                    std::span<const std::byte> saved);

}  // namespace sinew::run
