// fmu/slave/saved.h - serialization of plain structs. An importer may compare saved states, so they
// must not contain uninitialized memory: all members of a struct and its padding must be set.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace sinew::fmu {

// Appends the bytes of the value.
template <class T>
void append(std::vector<std::byte>& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

// Removes a value from the front and returns it. Throws std::runtime_error if there are too
// few bytes.
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
