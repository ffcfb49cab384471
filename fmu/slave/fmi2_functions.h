// fmu/slave/fmi2_functions.h - functions of FMI 2.0 for co-simulation, exported by a module. A
// source that defines `sinew::fmu::Models` includes this file once.
//
// All functions that the standard declares for co-simulation exist, since importers resolve every
// one. Text variables, directional derivatives and derivatives of outputs are not supported, and
// calls for them return an error with a message. A step is complete when doStep returns, so no step
// is ever pending.
#pragma once

#include <optional>

#include "fmu/slave/component.h"
#include "fmu/slave/fmi2.h"

namespace sinew::fmu::fmi2 {

// Logger of the importer.
struct Importer {
  using Status = fmi2::Status;
  Callbacks callbacks{};
  std::string name;

  // Writes to the importer's log, if it has one.
  void log(Status status, const char* category, const std::string& message) const {
    if (callbacks.logger)
      callbacks.logger(callbacks.environment, name.c_str(), status, category, "%s",
                       message.c_str());
  }
};

using Slave = Held<Models, Importer>;
using Variable = sinew::fmu::Variable;

// Returns the status of `work(slave)`; returns error and logs the reason if it throws
// (component.h).
template <class Work>
Status call(Component c, const char* function, const Work& work) noexcept {
  return guarded<Slave>(c, function, work);
}

// Returns an error for a function that the model does not support.
inline Status refuse(Component c, const char* function, const char* why) noexcept {
  return call(c, function, [&](Slave&) { throw std::runtime_error(why); });
}

// Creates an instance; returns nullptr and logs the reason if the arguments are invalid.
inline Component instantiate(String name, Type type, String guid, String resources,
                             const Callbacks* callbacks, bool logging) noexcept {
  Importer importer;
  if (callbacks) importer.callbacks = *callbacks;
  try {
    if (!name || !*name) throw std::runtime_error("found no name of the instance");
    importer.name = name;
    if (type != Type::co_simulation)
      throw std::runtime_error("found another type; expected co-simulation, the one that there is");
    if (!guid) throw std::runtime_error("found no GUID");
    const auto description = Description::read(resource_folder(resources));
    return new Slave{Instance<Models>(description, guid, SINEW_VERSION), importer, logging};
  } catch (const std::exception& e) {
    try {
      importer.log(Status::error, error_category, std::string("fmi2Instantiate: ") + e.what());
    } catch (...) {  // out of memory for the message
    }
    return nullptr;
  }
}

// Returns the status that FMI 2.0 requires if a slave does not have the requested status.
inline Status no_status(Component c, const char* function, const char* why) noexcept {
  return call(c, function, [&](Slave&) -> Status { throw Discarded(why); });
}

}  // namespace sinew::fmu::fmi2

#pragma GCC visibility push(default)
extern "C" {

using namespace sinew::fmu::fmi2;

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }

Status fmi2SetDebugLogging(Component c, Boolean on, std::size_t, const String*) {
  return call(c, __func__, [&](Slave& s) { s.logging = on != 0; });
}

Component fmi2Instantiate(String name, Type type, String guid, String resources,
                          const Callbacks* callbacks, Boolean, Boolean logging) {
  return instantiate(name, type, guid, resources, callbacks, logging != 0);
}
void fmi2FreeInstance(Component c) { delete static_cast<Slave*>(c); }

// --- phases ---

Status fmi2SetupExperiment(Component c, Boolean, Real, Real start, Boolean stop_defined,
                           Real stop) {
  return call(c, __func__, [&](Slave& s) {
    s.instance.set_start(start, stop_defined ? std::optional(stop) : std::nullopt);
  });
}
Status fmi2EnterInitializationMode(Component c) {
  return call(c, __func__, [](Slave& s) { s.instance.enter_initialization(); });
}
Status fmi2ExitInitializationMode(Component c) {
  return call(c, __func__, [](Slave& s) {
    s.instance.exit_initialization();
    s.log(Status::ok, "the model has begun");
  });
}
Status fmi2Terminate(Component c) {
  return call(c, __func__, [](Slave& s) {
    s.instance.terminate();
    s.log(Status::ok, "the run is terminated");
  });
}
Status fmi2Reset(Component c) {
  return call(c, __func__, [](Slave& s) { s.instance.reset(); });
}

// --- values ---

Status fmi2GetReal(Component c, const Reference* at, std::size_t n, Real* values) {
  return call(c, __func__, [&](Slave& s) {
    sinew::fmu::get_values(s, Variable::Type::real, at, n, values, [](double v) { return v; });
  });
}
Status fmi2GetInteger(Component c, const Reference* at, std::size_t n, Integer* values) {
  return call(c, __func__, [&](Slave& s) {
    sinew::fmu::get_values(s, Variable::Type::integer, at, n, values,
                           [](double v) { return static_cast<Integer>(v); });
  });
}
Status fmi2GetBoolean(Component c, const Reference* at, std::size_t n, Boolean* values) {
  return call(c, __func__, [&](Slave& s) {
    sinew::fmu::get_values(s, Variable::Type::boolean, at, n, values,
                           [](double v) { return static_cast<Boolean>(v != 0); });
  });
}
Status fmi2GetString(Component c, const Reference*, std::size_t n, String*) {
  return n == 0 ? Status::ok : refuse(c, __func__, "this model has no text variables");
}
Status fmi2SetReal(Component c, const Reference* at, std::size_t n, const Real* values) {
  return call(c, __func__,
              [&](Slave& s) { sinew::fmu::set_values(s, Variable::Type::real, at, n, values); });
}
Status fmi2SetInteger(Component c, const Reference* at, std::size_t n, const Integer* values) {
  return call(c, __func__,
              [&](Slave& s) { sinew::fmu::set_values(s, Variable::Type::integer, at, n, values); });
}
Status fmi2SetBoolean(Component c, const Reference* at, std::size_t n, const Boolean* values) {
  return call(c, __func__,
              [&](Slave& s) { sinew::fmu::set_values(s, Variable::Type::boolean, at, n, values); });
}
Status fmi2SetString(Component c, const Reference*, std::size_t n, const String*) {
  return n == 0 ? Status::ok : refuse(c, __func__, "this model has no text variables");
}

// --- saved states ---

Status fmi2GetFMUstate(Component c, State* state) {
  return call(c, __func__, [&](Slave& s) { sinew::fmu::hand_over(state, s.instance.save()); });
}
Status fmi2SetFMUstate(Component c, State state) {
  return call(c, __func__, [&](Slave& s) { s.instance.restore(sinew::fmu::bytes_of(state)); });
}
Status fmi2FreeFMUstate(Component c, State* state) {
  return call(c, __func__, [&](Slave&) { sinew::fmu::free_state(state); });
}
Status fmi2SerializedFMUstateSize(Component c, State state, std::size_t* size) {
  return call(c, __func__, [&](Slave&) {
    if (!size) throw std::runtime_error("found no place for the size");
    *size = sinew::fmu::bytes_of(state).size();
  });
}
Status fmi2SerializeFMUstate(Component c, State state, Byte* out, std::size_t size) {
  return call(c, __func__, [&](Slave&) { sinew::fmu::copy_out(state, out, size); });
}
Status fmi2DeSerializeFMUstate(Component c, const Byte* bytes, std::size_t size, State* state) {
  return call(c, __func__, [&](Slave&) { sinew::fmu::copy_in(bytes, size, state); });
}

// --- steps ---

Status fmi2DoStep(Component c, Real from, Real length, Boolean) {
  return call(c, __func__, [&](Slave& s) {
    return sinew::fmu::do_step(s, "fmi2DoStep", from, length, Status::discard);
  });
}
Status fmi2CancelStep(Component c) {
  return refuse(c, __func__, "a step is done when fmi2DoStep returns: no step can be cancelled");
}

// The first derivative of a muscle's length or a joint's angle is its rate. Derivatives that the
// model does not use (of rates, of pressures, of higher order) are ignored.
Status fmi2SetRealInputDerivatives(Component c, const Reference* at, std::size_t n,
                                   const Integer* orders, const Real* values) {
  return call(c, __func__, [&](Slave& s) {
    if (n > 0 && (!at || !orders || !values)) throw std::runtime_error("found no array of values");
    for (std::size_t k = 0; k < n; ++k) {
      const Variable& v = s.instance.variable(at[k], Variable::Type::real);
      if (v.causality != Variable::Causality::input || orders[k] < 1)
        throw std::runtime_error(v.name + ": found a derivative of order " +
                                 std::to_string(orders[k]) +
                                 "; expected order 1 or more, of an input");
      if (orders[k] == 1 && v.rate > 0)
        s.instance.set(static_cast<std::size_t>(v.rate), Variable::Type::real, values[k]);
    }
  });
}
Status fmi2GetRealOutputDerivatives(Component c, const Reference*, std::size_t n, const Integer*,
                                    Real*) {
  return n == 0 ? Status::ok : refuse(c, __func__, "this model gives no derivatives of outputs");
}
Status fmi2GetDirectionalDerivative(Component c, const Reference*, std::size_t, const Reference*,
                                    std::size_t, const Real*, Real*) {
  return refuse(c, __func__, "this model gives no directional derivatives");
}

// --- status of the last step ---

Status fmi2GetStatus(Component c, StatusKind, Status*) {
  return no_status(c, __func__, "no step of this model is ever pending");
}
Status fmi2GetRealStatus(Component c, StatusKind kind, Real* value) {
  if (kind != StatusKind::last_successful_time)
    return no_status(c, __func__, "expected fmi2LastSuccessfulTime");
  return call(c, __func__, [&](Slave& s) {
    if (!value) throw std::runtime_error("found no place for the time");
    *value = s.instance.time();
  });
}
Status fmi2GetIntegerStatus(Component c, StatusKind, Integer*) {
  return no_status(c, __func__, "this model has no status that is a whole number");
}
Status fmi2GetBooleanStatus(Component c, StatusKind kind, Boolean* value) {
  if (kind != StatusKind::terminated) return no_status(c, __func__, "expected fmi2Terminated");
  return call(c, __func__, [&](Slave& s) {
    if (!value) throw std::runtime_error("found no place for the value");
    *value = s.instance.ended() ? 1 : 0;
  });
}
Status fmi2GetStringStatus(Component c, StatusKind, String*) {
  return no_status(c, __func__, "no step of this model is ever pending");
}

}  // extern "C"
#pragma GCC visibility pop
