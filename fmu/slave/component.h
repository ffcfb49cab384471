// fmu/slave/component.h - object of an importer's handle: an instance with its name and the
// importer's log. The C functions of both versions of the interface call Calls.
#pragma once

#include <cstddef>
#include <cstring>
#include <exception>
#include <optional>
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

// --- functions of both versions ---

// Bodies of the functions that both versions of the interface have, with the handle as the first
// argument. `function` is the name of the C function that calls. Each returns error, and logs the
// reason, for wrong arguments.
template <class HeldInstance>
struct Calls {
  using Status = typename HeldInstance::Status;

  // Calls `work(held)`. Returns error if it throws, and logs the reason, or if there is no
  // instance.
  template <class Work>
  static Status call(void* c, const char* function, const Work& work) noexcept {
    if (!c) return Status::error;
    auto& held = *static_cast<HeldInstance*>(c);
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
  // Returns an error for a function that the model does not support.
  static Status refuse(void* c, const char* why,
                       const char* function = __builtin_FUNCTION()) noexcept {
    return call(c, function, [&](HeldInstance&) { throw std::runtime_error(why); });
  }
  // Handles getters and setters of what no model has: ok if nothing is requested.
  static Status none(void* c, std::size_t count, const char* why,
                     const char* function = __builtin_FUNCTION()) noexcept {
    return count == 0 ? Status::ok : refuse(c, why, function);
  }

  // Turns the log of the importer on or off.
  static Status set_logging(void* c, bool on, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance& s) { s.logging = on; });
  }
  // Sets the start of the run [s], and its end if one is defined.
  static Status set_start(void* c, double start, bool stop_defined, double stop,
                          const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance& s) {
      s.instance.set_start(start, stop_defined ? std::optional(stop) : std::nullopt);
    });
  }
  // Begins the phase in which start values are set.
  static Status enter_initialization(void* c, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [](HeldInstance& s) { s.instance.enter_initialization(); });
  }
  // Ends that phase; the model stands at its start.
  static Status exit_initialization(void* c, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [](HeldInstance& s) {
      s.instance.exit_initialization();
      s.log(Status::ok, "the model has begun");
    });
  }
  // Ends the run.
  static Status terminate(void* c, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [](HeldInstance& s) {
      s.instance.terminate();
      s.log(Status::ok, "the run is terminated");
    });
  }
  // Goes back to before the initialization.
  static Status reset(void* c, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [](HeldInstance& s) { s.instance.reset(); });
  }

  // Reads values by their references; `count` is the length of the importer's array.
  template <class T>
  static Status get(void* c, Variable::Type type, const unsigned int* references, std::size_t n,
                    T* values, std::size_t count, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance& s) {
      check_arrays(references, n, values, count);
      for (std::size_t k = 0; k < n; ++k) {
        const double value = s.instance.get(references[k], type);
        values[k] = static_cast<T>(type == Variable::Type::boolean ? value != 0 : value);
      }
    });
  }
  // Sets the values in order; an error leaves the earlier ones set.
  template <class T>
  static Status set(void* c, Variable::Type type, const unsigned int* references, std::size_t n,
                    const T* values, std::size_t count,
                    const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance& s) {
      check_arrays(references, n, values, count);
      for (std::size_t k = 0; k < n; ++k) {
        const auto value = static_cast<double>(values[k]);
        s.instance.set(references[k], type,
                       type == Variable::Type::boolean ? (value != 0 ? 1.0 : 0.0) : value);
      }
    });
  }

  // Makes a step. Returns ok if it was completed or reached exactly the end of the model, discard
  // if the model had ended before, and `short_of` if the end of the model shortened it.
  static Status step(HeldInstance& held, double from, double length, Status short_of,
                     const char* function) {
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

  // Saves the model; the importer owns `*state` until it frees it.
  static Status get_state(void* c, void** state, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance& s) { hand_over(state, s.instance.save()); });
  }
  // Restores the model from a saved state.
  static Status set_state(void* c, const void* state, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance& s) { s.instance.restore(bytes_of(state)); });
  }
  // Frees a saved state; null is allowed.
  static Status free(void* c, void** state, const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance&) {
      if (!state) return;
      delete static_cast<Saved*>(*state);
      *state = nullptr;
    });
  }
  // Writes the length of a saved state [bytes].
  static Status state_size(void* c, const void* state, std::size_t* size,
                           const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance&) {
      if (!size) throw std::runtime_error("found no place for the size");
      *size = bytes_of(state).size();
    });
  }
  // Copies a saved state into `size` bytes at `out`.
  static Status serialize(void* c, const void* state, void* out, std::size_t size,
                          const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance&) {
      const Saved& bytes = bytes_of(state);
      if (!out || size < bytes.size())
        throw std::runtime_error("found room for " + std::to_string(size) + " bytes; expected " +
                                 std::to_string(bytes.size()));
      std::memcpy(out, bytes.data(), bytes.size());
    });
  }
  // Makes a saved state from bytes.
  static Status deserialize(void* c, const void* bytes, std::size_t size, void** state,
                            const char* function = __builtin_FUNCTION()) {
    return call(c, function, [&](HeldInstance&) {
      if (!bytes) throw std::runtime_error("found no bytes of a state");
      const auto* begin = static_cast<const std::byte*>(bytes);
      hand_over(state, Saved(begin, begin + size));
    });
  }

 private:
  static void check_arrays(const unsigned int* references, std::size_t n, const void* values,
                           std::size_t count) {
    if (count != n) throw std::runtime_error("found another count of values than of references");
    if (n > 0 && (!references || !values)) throw std::runtime_error("found no array of values");
  }
};

// Makes an instance of the model that the folder of resources describes, and returns its handle.
// Throws std::exception if the arguments are invalid; `token_name` is the interface's name for the
// token, `version` that of the library.
template <class HeldInstance, class Models, class Importer>
void* make_instance(const char* name, const char* token, const char* token_name,
                    const char* resources, const char* version, Importer importer, bool logging) {
  if (!name || !*name) throw std::runtime_error("found no name of the instance");
  if (!token) throw std::runtime_error(std::string("found no ") + token_name);
  const auto description = Description::read(resource_folder(resources));
  return new HeldInstance{Instance<Models>(description, token, version), std::move(importer),
                          logging};
}

// Logs the reason why no instance was created, and returns null.
template <class Importer>
void* refuse_instance(const char* function, const Importer& importer,
                      const std::string& why) noexcept {
  try {
    importer.log(Importer::Status::error, error_category, std::string(function) + ": " + why);
  } catch (...) {  // out of memory for the message
  }
  return nullptr;
}

}  // namespace sinew::fmu
