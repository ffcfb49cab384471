// fmu/slave/fmi2_functions.h - the functions of FMI 2.0 for co-simulation, which a module exports:
// included once, by a source that has said what `sinew::fmu::Models` is.
//
// All that the standard declares for co-simulation is there, since importers look for every one.
// Not provided, and answered with an error in words: text variables (there are none), directional
// derivatives, derivatives of outputs; a step is done when doStep returns, so that nothing is ever
// pending.
#pragma once

#include "fmu/slave/component.h"
#include "fmu/slave/fmi2.h"

namespace sinew::fmu::fmi2 {

struct Importer {
  using Status = fmi2::Status;
  Callbacks callbacks{};
  std::string name;

  void log(Status status, const char* category, const std::string& message) const {
    if (callbacks.logger)
      callbacks.logger(callbacks.environment, name.c_str(), status, category, "%s",
                       message.c_str());
  }
};

using Slave = Held<Models, Importer>;
using Variable = sinew::fmu::Variable;

template <class Work>
Status call(Component c, const char* function, const Work& work) noexcept {
  return guarded<Slave>(c, function, work);
}

inline Status refuse(Component c, const char* function, const char* why) noexcept {
  return call(c, function, [&](Slave&) { throw std::runtime_error(why); });
}

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
    return new Slave{Instance<Models>(description, guid), importer, logging};
  } catch (const std::exception& e) {
    try {
      importer.log(Status::error, error_category, std::string("fmi2Instantiate: ") + e.what());
    } catch (...) {  // no memory for the message
    }
    return nullptr;
  }
}

inline Status do_step(Slave& slave, Real from, Real length) {
  using Step = Instance<Models>::Step;
  switch (slave.instance.step(from, length)) {
    case Step::done:
      return Status::ok;
    case Step::ended:
      // The step that comes to the end is done; the one after it is not.
      if (!slave.ended && slave.instance.time() > from) {
        slave.ended = true;
        return Status::ok;
      }
      slave.ended = true;
      slave.log(Status::discard, "fmi2DoStep: the run has come to its end");
      return Status::discard;
    case Step::failed:
      break;
  }
  slave.log(Status::error, std::string("fmi2DoStep: ") + slave.instance.trouble());
  return Status::error;
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

Status fmi2SetupExperiment(Component c, Boolean, Real, Real start, Boolean, Real) {
  return call(c, __func__, [&](Slave& s) { s.instance.set_start(start); });
}
Status fmi2EnterInitializationMode(Component c) {
  return call(c, __func__, [](Slave& s) { s.instance.enter_initialization(); });
}
Status fmi2ExitInitializationMode(Component c) {
  return call(c, __func__, [](Slave& s) { s.instance.exit_initialization(); });
}
Status fmi2Terminate(Component c) {
  return call(c, __func__, [](Slave& s) { s.instance.terminate(); });
}
Status fmi2Reset(Component c) {
  return call(c, __func__, [](Slave& s) {
    s.instance.reset();
    s.ended = false;
  });
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
  return call(c, __func__, [&](Slave& s) {
    s.instance.restore(sinew::fmu::bytes_of(state));
    s.ended = s.instance.ended();
  });
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
  return call(c, __func__, [&](Slave& s) { return do_step(s, from, length); });
}
Status fmi2CancelStep(Component c) {
  return refuse(c, __func__, "a step is done when fmi2DoStep returns: there is none to cancel");
}

// The first derivative of an input that has one, such as a muscle's length, is its rate.
Status fmi2SetRealInputDerivatives(Component c, const Reference* at, std::size_t n,
                                   const Integer* orders, const Real* values) {
  return call(c, __func__, [&](Slave& s) {
    if (n > 0 && (!at || !orders || !values)) throw std::runtime_error("found no array of values");
    for (std::size_t k = 0; k < n; ++k) {
      const Variable& v = s.instance.variable(at[k], Variable::Type::real);
      if (orders[k] != 1 || v.rate == 0)
        throw std::runtime_error(v.name + ": found a derivative of order " +
                                 std::to_string(orders[k]) +
                                 "; expected the first, of an input that has one");
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

// --- what became of the last step ---

Status fmi2GetStatus(Component c, StatusKind, Status*) {
  return refuse(c, __func__, "no step of this model is ever pending");
}
Status fmi2GetRealStatus(Component c, StatusKind kind, Real* value) {
  return call(c, __func__, [&](Slave& s) {
    if (kind != StatusKind::last_successful_time || !value)
      throw std::runtime_error("expected fmi2LastSuccessfulTime and a place for it");
    *value = s.instance.time();
  });
}
Status fmi2GetIntegerStatus(Component c, StatusKind, Integer*) {
  return refuse(c, __func__, "this model has no status that is a whole number");
}
Status fmi2GetBooleanStatus(Component c, StatusKind kind, Boolean* value) {
  return call(c, __func__, [&](Slave& s) {
    if (kind != StatusKind::terminated || !value)
      throw std::runtime_error("expected fmi2Terminated and a place for it");
    *value = s.ended ? 1 : 0;
  });
}
Status fmi2GetStringStatus(Component c, StatusKind, String*) {
  return refuse(c, __func__, "no step of this model is ever pending");
}

}  // extern "C"
#pragma GCC visibility pop
