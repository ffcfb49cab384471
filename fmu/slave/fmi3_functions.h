// fmu/slave/fmi3_functions.h - functions of FMI 3.0, exported by a module. A source that defines
// `sinew::fmu::Models` includes this file once.
//
// All functions that the standard declares exist. Co-simulation is supported; model exchange,
// scheduled execution, clocks, events, arrays, binary and text variables, derivatives and
// intermediate updates are not, and return an error with a message. Reals are Float64, whole
// numbers Int32.
#pragma once

#include <cstdint>
#include <optional>

#include "fmu/slave/component.h"

namespace sinew::fmu::fmi3 {

// Statuses of the standard, in its order.
enum class Status { ok, warning, discard, error, fatal };

using Instance = void*;
using Environment = void*;
using State = void*;
using Reference = std::uint32_t;
using String = const char*;
using Binary = const std::uint8_t*;
using Log = void (*)(Environment, Status, String category, String message);

// Logger of the importer.
struct Importer {
  using Status = fmi3::Status;
  Environment environment = nullptr;
  Log write = nullptr;

  // Writes to the importer's log, if it has one.
  void log(Status status, const char* category, const std::string& message) const {
    if (write) write(environment, status, category, message.c_str());
  }
};

using Slave = Held<Models, Importer>;
using Variable = sinew::fmu::Variable;

// Returns the status of `work(slave)`; returns error and logs the reason if it throws
// (component.h).
template <class Work>
Status call(Instance c, const char* function, const Work& work) noexcept {
  return guarded<Slave>(c, function, work);
}

// Returns an error for a function that the model does not support.
inline Status refuse(Instance c, const char* function, const char* why) noexcept {
  return call(c, function, [&](Slave&) { throw std::runtime_error(why); });
}

inline constexpr const char* no_such_type = "this model has no variables of that type";
inline constexpr const char* no_clocks = "this model has no clocks";
inline constexpr const char* no_exchange =
    "this model is for co-simulation, not for model exchange";

// Logs the reason why no instance was created, and returns null.
inline Instance refuse_instance(const char* function, Environment environment, Log write,
                                const std::string& why) noexcept {
  try {
    Importer{environment, write}.log(Status::error, error_category,
                                     std::string(function) + ": " + why);
  } catch (...) {  // out of memory for the message
  }
  return nullptr;
}

// Handles getters and setters of a type that no variable has: ok if no values are requested.
inline Status none(Instance c, const char* function, std::size_t count) noexcept {
  return count == 0 ? Status::ok : refuse(c, function, no_such_type);
}

}  // namespace sinew::fmu::fmi3

#pragma GCC visibility push(default)
extern "C" {

using namespace sinew::fmu::fmi3;
using Size = std::size_t;
using At = const Reference*;

const char* fmi3GetVersion() { return "3.0"; }

Status fmi3SetDebugLogging(Instance c, bool on, Size, const String*) {
  return call(c, __func__, [&](Slave& s) { s.logging = on; });
}

Instance fmi3InstantiateCoSimulation(String name, String token, String resources, bool,
                                     bool logging, bool, bool, At, Size, Environment environment,
                                     Log write, void*) {
  try {
    if (!name || !*name) throw std::runtime_error("found no name of the instance");
    if (!token) throw std::runtime_error("found no instantiation token");
    const auto description = sinew::fmu::Description::read(sinew::fmu::resource_folder(resources));
    return new Slave{sinew::fmu::Instance<sinew::fmu::Models>(description, token, SINEW_VERSION),
                     {environment, write},
                     logging};
  } catch (const std::exception& e) {
    return refuse_instance(__func__, environment, write, e.what());
  }
}
Instance fmi3InstantiateModelExchange(String, String, String, bool, bool, Environment environment,
                                      Log write) {
  return refuse_instance(__func__, environment, write, no_exchange);
}
Instance fmi3InstantiateScheduledExecution(String, String, String, bool, bool,
                                           Environment environment, Log write, void*, void*,
                                           void*) {
  return refuse_instance(__func__, environment, write,
                         "this model is for co-simulation, not for scheduled execution");
}
void fmi3FreeInstance(Instance c) { delete static_cast<Slave*>(c); }

// --- phases ---

Status fmi3EnterInitializationMode(Instance c, bool, double, double start, bool stop_defined,
                                   double stop) {
  return call(c, __func__, [&](Slave& s) {
    s.instance.set_start(start, stop_defined ? std::optional(stop) : std::nullopt);
    s.instance.enter_initialization();
  });
}
Status fmi3ExitInitializationMode(Instance c) {
  return call(c, __func__, [](Slave& s) {
    s.instance.exit_initialization();
    s.log(Status::ok, "the model has begun");
  });
}
Status fmi3EnterEventMode(Instance c) {
  return refuse(c, __func__, "this model has no event mode");
}
Status fmi3EnterStepMode(Instance c) { return refuse(c, __func__, "this model has no event mode"); }
Status fmi3EnterConfigurationMode(Instance c) {
  return refuse(c, __func__, "this model has no structural parameters");
}
Status fmi3ExitConfigurationMode(Instance c) {
  return refuse(c, __func__, "this model has no structural parameters");
}
Status fmi3Terminate(Instance c) {
  return call(c, __func__, [](Slave& s) {
    s.instance.terminate();
    s.log(Status::ok, "the run is terminated");
  });
}
Status fmi3Reset(Instance c) {
  return call(c, __func__, [](Slave& s) { s.instance.reset(); });
}

// --- values; there are no arrays, so the number of values equals that of references ---

Status fmi3GetFloat64(Instance c, At at, Size n, double* values, Size count) {
  return call(c, __func__, [&](Slave& s) {
    if (count != n) throw std::runtime_error("found another count of values than of references");
    sinew::fmu::get_values(s, Variable::Type::real, at, n, values, [](double v) { return v; });
  });
}
Status fmi3SetFloat64(Instance c, At at, Size n, const double* values, Size count) {
  return call(c, __func__, [&](Slave& s) {
    if (count != n) throw std::runtime_error("found another count of values than of references");
    sinew::fmu::set_values(s, Variable::Type::real, at, n, values);
  });
}
Status fmi3GetInt32(Instance c, At at, Size n, std::int32_t* values, Size count) {
  return call(c, __func__, [&](Slave& s) {
    if (count != n) throw std::runtime_error("found another count of values than of references");
    sinew::fmu::get_values(s, Variable::Type::integer, at, n, values,
                           [](double v) { return static_cast<std::int32_t>(v); });
  });
}
Status fmi3SetInt32(Instance c, At at, Size n, const std::int32_t* values, Size count) {
  return call(c, __func__, [&](Slave& s) {
    if (count != n) throw std::runtime_error("found another count of values than of references");
    sinew::fmu::set_values(s, Variable::Type::integer, at, n, values);
  });
}
Status fmi3GetBoolean(Instance c, At at, Size n, bool* values, Size count) {
  return call(c, __func__, [&](Slave& s) {
    if (count != n) throw std::runtime_error("found another count of values than of references");
    sinew::fmu::get_values(s, Variable::Type::boolean, at, n, values,
                           [](double v) { return v != 0; });
  });
}
Status fmi3SetBoolean(Instance c, At at, Size n, const bool* values, Size count) {
  return call(c, __func__, [&](Slave& s) {
    if (count != n) throw std::runtime_error("found another count of values than of references");
    sinew::fmu::set_values(s, Variable::Type::boolean, at, n, values);
  });
}

Status fmi3GetFloat32(Instance c, At, Size n, float*, Size) { return none(c, __func__, n); }
Status fmi3GetInt8(Instance c, At, Size n, std::int8_t*, Size) { return none(c, __func__, n); }
Status fmi3GetUInt8(Instance c, At, Size n, std::uint8_t*, Size) { return none(c, __func__, n); }
Status fmi3GetInt16(Instance c, At, Size n, std::int16_t*, Size) { return none(c, __func__, n); }
Status fmi3GetUInt16(Instance c, At, Size n, std::uint16_t*, Size) { return none(c, __func__, n); }
Status fmi3GetUInt32(Instance c, At, Size n, std::uint32_t*, Size) { return none(c, __func__, n); }
Status fmi3GetInt64(Instance c, At, Size n, std::int64_t*, Size) { return none(c, __func__, n); }
Status fmi3GetUInt64(Instance c, At, Size n, std::uint64_t*, Size) { return none(c, __func__, n); }
Status fmi3GetString(Instance c, At, Size n, String*, Size) { return none(c, __func__, n); }
Status fmi3GetBinary(Instance c, At, Size n, Size*, Binary*, Size) { return none(c, __func__, n); }
Status fmi3GetClock(Instance c, At, Size n, bool*) { return none(c, __func__, n); }
Status fmi3SetFloat32(Instance c, At, Size n, const float*, Size) { return none(c, __func__, n); }
Status fmi3SetInt8(Instance c, At, Size n, const std::int8_t*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetUInt8(Instance c, At, Size n, const std::uint8_t*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetInt16(Instance c, At, Size n, const std::int16_t*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetUInt16(Instance c, At, Size n, const std::uint16_t*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetUInt32(Instance c, At, Size n, const std::uint32_t*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetInt64(Instance c, At, Size n, const std::int64_t*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetUInt64(Instance c, At, Size n, const std::uint64_t*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetString(Instance c, At, Size n, const String*, Size) { return none(c, __func__, n); }
Status fmi3SetBinary(Instance c, At, Size n, const Size*, const Binary*, Size) {
  return none(c, __func__, n);
}
Status fmi3SetClock(Instance c, At, Size n, const bool*) { return none(c, __func__, n); }

// --- direct feedthrough of outputs ---

Status fmi3GetNumberOfVariableDependencies(Instance c, Reference at, Size* count) {
  return call(c, __func__, [&](Slave& s) {
    if (!count) throw std::runtime_error("found no place for the count");
    *count = s.instance.variable(at).follows.size();
  });
}
Status fmi3GetVariableDependencies(Instance c, Reference at, Size* of, Reference* references,
                                   Size* in, int* kinds, Size count) {
  return call(c, __func__, [&](Slave& s) {
    constexpr int dependent = 5;
    const std::vector<int>& follows = s.instance.variable(at).follows;
    if (count != follows.size() || (count > 0 && (!of || !references || !in || !kinds)))
      throw std::runtime_error("expected room for " + std::to_string(follows.size()) +
                               " dependencies");
    for (Size k = 0; k < count; ++k) {
      of[k] = in[k] = 0;
      references[k] = static_cast<Reference>(follows[k]);
      kinds[k] = dependent;
    }
  });
}

// --- saved states ---

Status fmi3GetFMUState(Instance c, State* state) {
  return call(c, __func__, [&](Slave& s) { sinew::fmu::hand_over(state, s.instance.save()); });
}
Status fmi3SetFMUState(Instance c, State state) {
  return call(c, __func__, [&](Slave& s) { s.instance.restore(sinew::fmu::bytes_of(state)); });
}
Status fmi3FreeFMUState(Instance c, State* state) {
  return call(c, __func__, [&](Slave&) { sinew::fmu::free_state(state); });
}
Status fmi3SerializedFMUStateSize(Instance c, State state, Size* size) {
  return call(c, __func__, [&](Slave&) {
    if (!size) throw std::runtime_error("found no place for the size");
    *size = sinew::fmu::bytes_of(state).size();
  });
}
Status fmi3SerializeFMUState(Instance c, State state, std::uint8_t* out, Size size) {
  return call(c, __func__, [&](Slave&) { sinew::fmu::copy_out(state, out, size); });
}
Status fmi3DeserializeFMUState(Instance c, const std::uint8_t* bytes, Size size, State* state) {
  return call(c, __func__, [&](Slave&) { sinew::fmu::copy_in(bytes, size, state); });
}

// --- steps ---

Status fmi3DoStep(Instance c, double from, double length, bool, bool* event_needed, bool* ended,
                  bool* early, double* last_time) {
  return call(c, __func__, [&](Slave& s) {
    const Status out = sinew::fmu::do_step(s, "fmi3DoStep", from, length, Status::ok);
    if (event_needed) *event_needed = false;
    if (ended) *ended = s.instance.ended();
    if (early) *early = false;
    if (last_time) *last_time = s.instance.time();
    return out;
  });
}

// --- functions that are not supported ---

Status fmi3GetDirectionalDerivative(Instance c, At, Size, At, Size, const double*, Size, double*,
                                    Size) {
  return refuse(c, __func__, "this model gives no directional derivatives");
}
Status fmi3GetAdjointDerivative(Instance c, At, Size, At, Size, const double*, Size, double*,
                                Size) {
  return refuse(c, __func__, "this model gives no adjoint derivatives");
}
Status fmi3GetOutputDerivatives(Instance c, At, Size n, const std::int32_t*, double*, Size) {
  return n == 0 ? Status::ok : refuse(c, __func__, "this model gives no derivatives of outputs");
}
Status fmi3GetIntervalDecimal(Instance c, At, Size, double*, int*) {
  return refuse(c, __func__, no_clocks);
}
Status fmi3GetIntervalFraction(Instance c, At, Size, std::uint64_t*, std::uint64_t*, int*) {
  return refuse(c, __func__, no_clocks);
}
Status fmi3GetShiftDecimal(Instance c, At, Size, double*) { return refuse(c, __func__, no_clocks); }
Status fmi3GetShiftFraction(Instance c, At, Size, std::uint64_t*, std::uint64_t*) {
  return refuse(c, __func__, no_clocks);
}
Status fmi3SetIntervalDecimal(Instance c, At, Size, const double*) {
  return refuse(c, __func__, no_clocks);
}
Status fmi3SetIntervalFraction(Instance c, At, Size, const std::uint64_t*, const std::uint64_t*) {
  return refuse(c, __func__, no_clocks);
}
Status fmi3SetShiftDecimal(Instance c, At, Size, const double*) {
  return refuse(c, __func__, no_clocks);
}
Status fmi3SetShiftFraction(Instance c, At, Size, const std::uint64_t*, const std::uint64_t*) {
  return refuse(c, __func__, no_clocks);
}
Status fmi3EvaluateDiscreteStates(Instance c) {
  return refuse(c, __func__, "this model has no event mode");
}
Status fmi3UpdateDiscreteStates(Instance c, bool*, bool*, bool*, bool*, bool*, double*) {
  return refuse(c, __func__, "this model has no event mode");
}
Status fmi3EnterContinuousTimeMode(Instance c) { return refuse(c, __func__, no_exchange); }
Status fmi3CompletedIntegratorStep(Instance c, bool, bool*, bool*) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3SetTime(Instance c, double) { return refuse(c, __func__, no_exchange); }
Status fmi3SetContinuousStates(Instance c, const double*, Size) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3GetContinuousStateDerivatives(Instance c, double*, Size) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3GetEventIndicators(Instance c, double*, Size) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3GetContinuousStates(Instance c, double*, Size) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3GetNominalsOfContinuousStates(Instance c, double*, Size) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3GetNumberOfEventIndicators(Instance c, Size*) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3GetNumberOfContinuousStates(Instance c, Size*) {
  return refuse(c, __func__, no_exchange);
}
Status fmi3ActivateModelPartition(Instance c, Reference, double) {
  return refuse(c, __func__, no_clocks);
}

}  // extern "C"
#pragma GCC visibility pop
