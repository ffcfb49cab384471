// fmu/slave/fmi2_functions.h - functions of FMI 2.0 for co-simulation, exported by a module. A
// source that defines `sinew::fmu::Models` includes this file once.
//
// All functions that the standard declares for co-simulation exist, since importers resolve every
// one. Text variables, directional derivatives and derivatives of outputs are not supported, and
// calls for them return an error with a message. A step is complete when doStep returns, so no step
// is ever pending.
#pragma once

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
using Functions = Calls<Slave>;
using Variable = sinew::fmu::Variable;
using Values = Variable::Type;

// Creates an instance; returns nullptr and logs the reason if the arguments are invalid.
inline Component instantiate(String name, Type type, String guid, String resources,
                             const Callbacks* callbacks, bool logging) noexcept {
  Importer importer;
  if (callbacks) importer.callbacks = *callbacks;
  try {
    if (name) importer.name = name;
    if (type != Type::co_simulation && name && *name)
      throw std::runtime_error("found another type; expected co-simulation, the one that there is");
    return make_instance<Slave, Models>(name, guid, "GUID", resources, SINEW_VERSION, importer,
                                        logging);
  } catch (const std::exception& e) {
    return refuse_instance("fmi2Instantiate", importer, e.what());
  }
}

// Returns the status that FMI 2.0 requires if a slave does not have the requested status.
inline Status no_status(Component c, const char* function, const char* why) noexcept {
  return Functions::call(c, function, [&](Slave&) -> Status { throw Discarded(why); });
}

}  // namespace sinew::fmu::fmi2

#pragma GCC visibility push(default)
extern "C" {

using namespace sinew::fmu::fmi2;

const char* fmi2GetTypesPlatform() { return "default"; }
const char* fmi2GetVersion() { return "2.0"; }

Status fmi2SetDebugLogging(Component c, Boolean on, std::size_t, const String*) {
  return Functions::set_logging(c, on != 0);
}

Component fmi2Instantiate(String name, Type type, String guid, String resources,
                          const Callbacks* callbacks, Boolean, Boolean logging) {
  return instantiate(name, type, guid, resources, callbacks, logging != 0);
}
void fmi2FreeInstance(Component c) { delete static_cast<Slave*>(c); }

// --- phases ---

Status fmi2SetupExperiment(Component c, Boolean, Real, Real start, Boolean stop_defined,
                           Real stop) {
  return Functions::set_start(c, start, stop_defined != 0, stop);
}
Status fmi2EnterInitializationMode(Component c) { return Functions::enter_initialization(c); }
Status fmi2ExitInitializationMode(Component c) { return Functions::exit_initialization(c); }
Status fmi2Terminate(Component c) { return Functions::terminate(c); }
Status fmi2Reset(Component c) { return Functions::reset(c); }

// --- values ---

Status fmi2GetReal(Component c, const Reference* at, std::size_t n, Real* values) {
  return Functions::get(c, Values::real, at, n, values, n);
}
Status fmi2SetReal(Component c, const Reference* at, std::size_t n, const Real* values) {
  return Functions::set(c, Values::real, at, n, values, n);
}
Status fmi2GetInteger(Component c, const Reference* at, std::size_t n, Integer* values) {
  return Functions::get(c, Values::integer, at, n, values, n);
}
Status fmi2SetInteger(Component c, const Reference* at, std::size_t n, const Integer* values) {
  return Functions::set(c, Values::integer, at, n, values, n);
}
Status fmi2GetBoolean(Component c, const Reference* at, std::size_t n, Boolean* values) {
  return Functions::get(c, Values::boolean, at, n, values, n);
}
Status fmi2SetBoolean(Component c, const Reference* at, std::size_t n, const Boolean* values) {
  return Functions::set(c, Values::boolean, at, n, values, n);
}
Status fmi2GetString(Component c, const Reference*, std::size_t n, String*) {
  return Functions::none(c, n, "this model has no text variables");
}
Status fmi2SetString(Component c, const Reference*, std::size_t n, const String*) {
  return Functions::none(c, n, "this model has no text variables");
}

// --- saved states ---

Status fmi2GetFMUstate(Component c, State* state) { return Functions::get_state(c, state); }
Status fmi2SetFMUstate(Component c, State state) { return Functions::set_state(c, state); }
Status fmi2FreeFMUstate(Component c, State* state) { return Functions::free(c, state); }
Status fmi2SerializedFMUstateSize(Component c, State state, std::size_t* size) {
  return Functions::state_size(c, state, size);
}
Status fmi2SerializeFMUstate(Component c, State state, Byte* out, std::size_t size) {
  return Functions::serialize(c, state, out, size);
}
Status fmi2DeSerializeFMUstate(Component c, const Byte* bytes, std::size_t size, State* state) {
  return Functions::deserialize(c, bytes, size, state);
}

// --- steps ---

Status fmi2DoStep(Component c, Real from, Real length, Boolean) {
  return Functions::call(c, __func__, [&](Slave& s) {
    return Functions::step(s, from, length, Status::discard, "fmi2DoStep");
  });
}
Status fmi2CancelStep(Component c) {
  return Functions::refuse(c, "a step is done when fmi2DoStep returns: no step can be cancelled");
}

// The first derivative of a muscle's length or a joint's angle is its rate. Derivatives that the
// model does not use (of rates, of pressures, of higher order) are ignored.
Status fmi2SetRealInputDerivatives(Component c, const Reference* at, std::size_t n,
                                   const Integer* orders, const Real* values) {
  return Functions::call(c, __func__, [&](Slave& s) {
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
  return Functions::none(c, n, "this model gives no derivatives of outputs");
}
Status fmi2GetDirectionalDerivative(Component c, const Reference*, std::size_t, const Reference*,
                                    std::size_t, const Real*, Real*) {
  return Functions::refuse(c, "this model gives no directional derivatives");
}

// --- status of the last step ---

Status fmi2GetStatus(Component c, StatusKind, Status*) {
  return no_status(c, __func__, "no step of this model is ever pending");
}
Status fmi2GetRealStatus(Component c, StatusKind kind, Real* value) {
  if (kind != StatusKind::last_successful_time)
    return no_status(c, __func__, "expected fmi2LastSuccessfulTime");
  return Functions::call(c, __func__, [&](Slave& s) {
    if (!value) throw std::runtime_error("found no place for the time");
    *value = s.instance.time();
  });
}
Status fmi2GetIntegerStatus(Component c, StatusKind, Integer*) {
  return no_status(c, __func__, "this model has no status that is a whole number");
}
Status fmi2GetBooleanStatus(Component c, StatusKind kind, Boolean* value) {
  if (kind != StatusKind::terminated) return no_status(c, __func__, "expected fmi2Terminated");
  return Functions::call(c, __func__, [&](Slave& s) {
    if (!value) throw std::runtime_error("found no place for the value");
    *value = s.instance.ended() ? 1 : 0;
  });
}
Status fmi2GetStringStatus(Component c, StatusKind, String*) {
  return no_status(c, __func__, "no step of this model is ever pending");
}

}  // extern "C"
#pragma GCC visibility pop
