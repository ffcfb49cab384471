// fmu/slave/component.h - object of an importer's handle: an instance with its name and the
// importer's log. The C functions of both versions of the interface use guarded().
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

// Log categories in modelDescription.xml.
inline constexpr const char* error_category = "logStatusError";
inline constexpr const char* discard_category = "logStatusDiscard";
inline constexpr const char* event_category = "logEvents";

// `Importer` has log(status, category, message) and a Status with the enumerators of its version.
template <class Models, class Importer>
struct Held {
  using Status = typename Importer::Status;

  Instance<Models> instance;
  Importer importer;
  bool logging = false;

  // Logs a message; messages without trouble only if logging is on.
  void log(Status status, const std::string& message) const {
    if (status == Status::ok && !logging) return;
    const char* category = status == Status::ok ? event_category : error_category;
    importer.log(status, status == Status::discard ? discard_category : category, message);
  }
};

// Logs the reason of a status and returns the status.
template <class HeldInstance>
typename HeldInstance::Status logged(const HeldInstance& held, typename HeldInstance::Status status,
                                     const char* function, const char* why) noexcept {
  try {
    held.log(status, std::string(function) + ": " + why);
  } catch (...) {  // out of memory for the message
  }
  return status;
}

// Calls `work(held)`. Returns error if it throws, and logs the reason, or if there is no instance.
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
  } catch (const Discarded& e) {
    return logged(held, Status::discard, function, e.what());
  } catch (const std::exception& e) {
    return logged(held, Status::error, function, e.what());
  }
}

// Makes a step. Returns ok if it was completed or reached exactly the end of the model, discard if
// the model had ended before, and `short_of` if the end of the model shortened it.
template <class HeldInstance>
typename HeldInstance::Status do_step(HeldInstance& held, const char* function, double from,
                                      double length, typename HeldInstance::Status short_of) {
  using Status = typename HeldInstance::Status;
  auto& instance = held.instance;
  const bool before = instance.ended();
  const auto became = instance.step(from, length);
  using Step = decltype(became);
  if (became == Step::failed) return logged(held, Status::error, function, instance.trouble());
  if (instance.ended() && !before) held.log(Status::ok, "the model has come to its end");
  if (became == Step::done) return Status::ok;
  if (before)
    return logged(held, Status::discard, function, "the model had come to its end before");
  return short_of == Status::ok
             ? Status::ok
             : logged(held, short_of, function, "the model has come to its end within the step");
}

// Reads values by their references. `convert` returns the element of the caller's array.
template <class HeldInstance, class T, class Convert>
void get_values(HeldInstance& held, Variable::Type type, const unsigned int* references,
                std::size_t count, T* values, const Convert& convert) {
  if (count > 0 && (!references || !values)) throw std::runtime_error("found no array of values");
  for (std::size_t k = 0; k < count; ++k)
    values[k] = convert(held.instance.get(references[k], type));
}

// Sets the values in order; an error leaves the earlier ones set.
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

// --- saved states: the handle is a vector of bytes ---

using Saved = std::vector<std::byte>;

// Returns the bytes of the handle. Throws if it is null.
inline const Saved& bytes_of(const void* state) {
  if (!state) throw std::runtime_error("found no state");
  return *static_cast<const Saved*>(state);
}

// Stores the bytes in the handle; allocates a new vector if it is null.
inline void hand_over(void** state, Saved bytes) {
  if (!state) throw std::runtime_error("found no place for the state");
  if (*state)
    *static_cast<Saved*>(*state) = std::move(bytes);
  else
    *state = new Saved(std::move(bytes));
}

// Frees the state and sets the handle to null; does nothing if it is null.
inline void free_state(void** state) {
  if (!state) return;
  delete static_cast<Saved*>(*state);
  *state = nullptr;
}

// Copy a state into the importer's buffer of `size` bytes, and from it.
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
