// python/binding/used.h - guard for objects that are changed without Python's lock: one thread at a
// time.
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>
#include <utility>

#include "python/binding/bind.h"

namespace sinew::python {

// Object that only one thread at a time may use.
template <class Object>
class Guarded {
 public:
  // Makes the object from the arguments; `what` names it in messages.
  template <class... Arguments>
  explicit Guarded(const char* what, Arguments&&... arguments)
      : what_(what), object_(std::forward<Arguments>(arguments)...) {}

  // Access to the object during the lifetime of this guard. Throws std::runtime_error if another
  // thread, or a signal handler within a call, uses it.
  class Use {
   public:
    explicit Use(Guarded& guarded) : guarded_(guarded) {
      if (guarded_.used_.exchange(true, std::memory_order_acquire))
        throw std::runtime_error(std::string(guarded_.what_) +
                                 ": another thread is at it; expected one thread at a time; try a "
                                 "copy for each thread (copy.copy)");
    }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use() { guarded_.used_.store(false, std::memory_order_release); }

    Object* operator->() const { return &guarded_.object_; }
    Object& operator*() const { return guarded_.object_; }

   private:
    Guarded& guarded_;
  };

 private:
  const char* what_;
  Object object_;
  std::atomic<bool> used_{false};
};

// Adds save(), restore() and copies to a class of guarded objects. `other` names, in a docstring,
// the object whose save is refused.
template <class Class, class Save, class Restore, class Copy>
void bind_states(Class& c, Save save, Restore restore, Copy copy, const std::string& other) {
  c.def("save", save, "Returns everything that the future depends on, as bytes.")
      .def("restore", restore, py::arg("saved"),
           ("Goes back, or on, to where it was saved, bit for bit. Raises ValueError, and changes\n"
            "nothing, for bytes that are no save, or of " +
            other + ".")
               .c_str())
      .def("copy", copy, "Returns another one that stands at the same instant.")
      .def("__copy__", copy)
      .def(
          "__deepcopy__",
          [copy](typename Class::type& object, const py::dict&) { return copy(object); },
          py::arg("memo"));
}

}  // namespace sinew::python
