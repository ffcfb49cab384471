// fmu/slave/saved.h - plain structs as bytes, one after the other. An importer may compare saved
// states, and must not see this process's memory in them: whoever makes a struct makes all of it.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace sinew::fmu {

// Puts the value's bytes behind the others.
template <class T>
void append(std::vector<std::byte>& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

// Takes the value off the front. Throws std::runtime_error where there are too few bytes.
template <class T>
T take(std::span<const std::byte>& from) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (from.size() < sizeof(T)) throw std::runtime_error("a saved state is cut off");
  alignas(T) std::byte bytes[sizeof(T)];
  std::memcpy(bytes, from.data(), sizeof(T));
  from = from.subspan(sizeof(T));
  T out;
  std::memcpy(&out, bytes, sizeof(T));
  return out;
}

}  // namespace sinew::fmu
