// fmu/slave/component.h - what stands behind an importer's handle: an instance with its name and
// the importer's log. C functions of either version of the interface go through guarded().
#pragma once

#include <cstddef>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "fmu/slave/instance.h"

namespace sinew::fmu {

// The two categories that modelDescription.xml names.
inline constexpr const char* error_category = "logStatusError";
inline constexpr const char* event_category = "logEvents";

// `Importer` has log(status, category, message) and, of the version's Status, the same enumerators.
template <class Models, class Importer>
struct Held {
  using Status = typename Importer::Status;

  Instance<Models> instance;
  Importer importer;
  bool logging = false;
  bool ended = false;  // a step came to the end of what the model has

  void log(Status status, const std::string& message) const {
    if (logging || status != Status::ok)
      importer.log(status, status == Status::ok ? event_category : error_category, message);
  }
};

// Calls `work(held)`, which may throw. Answers error, and tells the importer why, where it does or
// where there is no instance.
template <class HeldInstance, class Work>
typename HeldInstance::Status guarded(void* component, const char* function,
                                      const Work& work) noexcept {
  using Status = typename HeldInstance::Status;
  if (!component) return Status::error;
  auto& held = *static_cast<HeldInstance*>(component);
  try {
    if constexpr (std::is_void_v<decltype(work(held))>) {
      work(held);
      return Status::ok;
    } else {
      return work(held);
    }
  } catch (const std::exception& e) {
    try {
      held.log(Status::error, std::string(function) + ": " + e.what());
    } catch (...) {  // no memory for the message
    }
    return Status::error;
  }
}

// Reads values by their references. `convert` makes of the number what the caller's array holds.
template <class HeldInstance, class T, class Convert>
void get_values(HeldInstance& held, Variable::Type type, const unsigned int* references,
                std::size_t count, T* values, const Convert& convert) {
  if (count > 0 && (!references || !values)) throw std::runtime_error("found no array of values");
  for (std::size_t k = 0; k < count; ++k)
    values[k] = convert(held.instance.get(references[k], type));
}

// Sets all values or, where one of them is wrong, those before it.
template <class HeldInstance, class T>
void set_values(HeldInstance& held, Variable::Type type, const unsigned int* references,
                std::size_t count, const T* values) {
  if (count > 0 && (!references || !values)) throw std::runtime_error("found no array of values");
  for (std::size_t k = 0; k < count; ++k) {
    const double value =
        type == Variable::Type::boolean ? (values[k] ? 1.0 : 0.0) : static_cast<double>(values[k]);
    held.instance.set(references[k], type, value);
  }
}

// --- saved states: an importer's handle is a vector of bytes ---

using Saved = std::vector<std::byte>;

// Returns what the handle holds. Throws where there is none.
inline const Saved& bytes_of(const void* state) {
  if (!state) throw std::runtime_error("found no state");
  return *static_cast<const Saved*>(state);
}

// Puts the bytes behind the handle: a new one where it holds none yet.
inline void hand_over(void** state, Saved bytes) {
  if (!state) throw std::runtime_error("found no place for the state");
  if (*state)
    *static_cast<Saved*>(*state) = std::move(bytes);
  else
    *state = new Saved(std::move(bytes));
}

inline void free_state(void** state) {
  if (!state) return;
  delete static_cast<Saved*>(*state);
  *state = nullptr;
}

// Copies a state into an importer's room of so many bytes, and out of it.
inline void copy_out(const void* state, void* out, std::size_t size) {
  const Saved& bytes = bytes_of(state);
  if (!out || size < bytes.size())
    throw std::runtime_error("found room for " + std::to_string(size) + " bytes; expected " +
                             std::to_string(bytes.size()));
  std::memcpy(out, bytes.data(), bytes.size());
}
inline void copy_in(const void* bytes, std::size_t size, void** state) {
  if (!bytes) throw std::runtime_error("found no bytes of a state");
  const auto* begin = static_cast<const std::byte*>(bytes);
  hand_over(state, Saved(begin, begin + size));
}

}  // namespace sinew::fmu
