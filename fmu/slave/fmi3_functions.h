// fmu/slave/fmi3_functions.h - functions of FMI 3.0, exported by a module. A source that defines
// `sinew::fmu::Models` includes this file once.
//
// All functions that the standard declares exist. Co-simulation is supported; model exchange,
// scheduled execution, clocks, events, arrays, binary and text variables, derivatives and
// intermediate updates are not, and return an error with a message. Reals are Float64, whole
// numbers Int32.
#pragma once

#include <cstdint>

#include "fmu/slave/component.h"

namespace sinew::fmu::fmi3 {

// Statuses of the standard, in its order.
enum class Status { ok, warning, discard, error, fatal };

using Instance = void*;
using Environment = void*;
using State = void*;
using Reference = std::uint32_t;
using String = const char*;
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
using Functions = Calls<Slave>;
using Variable = sinew::fmu::Variable;
using Type = Variable::Type;

inline constexpr const char* no_such_type = "this model has no variables of that type";
inline constexpr const char* no_clocks = "this model has no clocks";
inline constexpr const char* no_event_mode = "this model has no event mode";
inline constexpr const char* no_structure = "this model has no structural parameters";
inline constexpr const char* no_exchange =
    "this model is for co-simulation, not for model exchange";

// Returns an error for a function that the model does not support.
inline Status refuse(Instance c, const char* why,
                     const char* function = __builtin_FUNCTION()) noexcept {
  return Functions::refuse(c, why, function);
}
// Handles getters and setters of a type that no variable has: ok if no values are requested.
inline Status none(Instance c, std::size_t count,
                   const char* function = __builtin_FUNCTION()) noexcept {
  return Functions::none(c, count, no_such_type, function);
}

}  // namespace sinew::fmu::fmi3

#pragma GCC visibility push(default)
extern "C" {

using namespace sinew::fmu::fmi3;
using Size = std::size_t;
using At = const Reference*;

const char* fmi3GetVersion() { return "3.0"; }

Status fmi3SetDebugLogging(Instance c, bool on, Size, const String*) {
  return Functions::set_logging(c, on);
}

Instance fmi3InstantiateCoSimulation(String name, String token, String resources, bool,
                                     bool logging, bool, bool, At, Size, Environment environment,
                                     Log write, void*) {
  const Importer importer{environment, write};
  try {
    return sinew::fmu::make_instance<Slave, sinew::fmu::Models>(
        name, token, "instantiation token", resources, SINEW_VERSION, importer, logging);
  } catch (const std::exception& e) {
    return sinew::fmu::refuse_instance(__func__, importer, e.what());
  }
}
Instance fmi3InstantiateModelExchange(String, String, String, bool, bool, Environment environment,
                                      Log write) {
  return sinew::fmu::refuse_instance(__func__, Importer{environment, write}, no_exchange);
}
Instance fmi3InstantiateScheduledExecution(String, String, String, bool, bool,
                                           Environment environment, Log write, void*, void*,
                                           void*) {
  return sinew::fmu::refuse_instance(
      __func__, Importer{environment, write},
      "this model is for co-simulation, not for scheduled execution");
}
void fmi3FreeInstance(Instance c) { delete static_cast<Slave*>(c); }

// --- phases ---

Status fmi3EnterInitializationMode(Instance c, bool, double, double start, bool stop_defined,
                                   double stop) {
  const Status status = Functions::set_start(c, start, stop_defined, stop);
  return status == Status::ok ? Functions::enter_initialization(c) : status;
}
Status fmi3ExitInitializationMode(Instance c) { return Functions::exit_initialization(c); }
Status fmi3EnterEventMode(Instance c) { return refuse(c, no_event_mode); }
Status fmi3EnterStepMode(Instance c) { return refuse(c, no_event_mode); }
Status fmi3EnterConfigurationMode(Instance c) { return refuse(c, no_structure); }
Status fmi3ExitConfigurationMode(Instance c) { return refuse(c, no_structure); }
Status fmi3Terminate(Instance c) { return Functions::terminate(c); }
Status fmi3Reset(Instance c) { return Functions::reset(c); }

// --- values; there are no arrays, so the number of values equals that of references ---

Status fmi3GetFloat64(Instance c, At at, Size n, double* values, Size count) {
  return Functions::get(c, Type::real, at, n, values, count);
}
Status fmi3SetFloat64(Instance c, At at, Size n, const double* values, Size count) {
  return Functions::set(c, Type::real, at, n, values, count);
}
Status fmi3GetInt32(Instance c, At at, Size n, std::int32_t* values, Size count) {
  return Functions::get(c, Type::integer, at, n, values, count);
}
Status fmi3SetInt32(Instance c, At at, Size n, const std::int32_t* values, Size count) {
  return Functions::set(c, Type::integer, at, n, values, count);
}
Status fmi3GetBoolean(Instance c, At at, Size n, bool* values, Size count) {
  return Functions::get(c, Type::boolean, at, n, values, count);
}
Status fmi3SetBoolean(Instance c, At at, Size n, const bool* values, Size count) {
  return Functions::set(c, Type::boolean, at, n, values, count);
}

// Pointers to values of the other types are never used, so they are declared without their types.
Status fmi3GetFloat32(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetInt8(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetUInt8(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetInt16(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetUInt16(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetUInt32(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetInt64(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetUInt64(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetString(Instance c, At, Size n, void*, Size) { return none(c, n); }
Status fmi3GetBinary(Instance c, At, Size n, Size*, void*, Size) { return none(c, n); }
Status fmi3GetClock(Instance c, At, Size n, bool*) { return none(c, n); }
Status fmi3SetFloat32(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetInt8(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetUInt8(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetInt16(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetUInt16(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetUInt32(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetInt64(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetUInt64(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetString(Instance c, At, Size n, const void*, Size) { return none(c, n); }
Status fmi3SetBinary(Instance c, At, Size n, const Size*, const void*, Size) { return none(c, n); }
Status fmi3SetClock(Instance c, At, Size n, const bool*) { return none(c, n); }

// --- direct feedthrough of outputs ---

Status fmi3GetNumberOfVariableDependencies(Instance c, Reference at, Size* count) {
  return Functions::call(c, __func__, [&](Slave& s) {
    if (!count) throw std::runtime_error("found no place for the count");
    *count = s.instance.variable(at).follows.size();
  });
}
Status fmi3GetVariableDependencies(Instance c, Reference at, Size* of, Reference* references,
                                   Size* in, int* kinds, Size count) {
  return Functions::call(c, __func__, [&](Slave& s) {
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

Status fmi3GetFMUState(Instance c, State* state) { return Functions::get_state(c, state); }
Status fmi3SetFMUState(Instance c, State state) { return Functions::set_state(c, state); }
Status fmi3FreeFMUState(Instance c, State* state) { return Functions::free(c, state); }
Status fmi3SerializedFMUStateSize(Instance c, State state, Size* size) {
  return Functions::state_size(c, state, size);
}
Status fmi3SerializeFMUState(Instance c, State state, std::uint8_t* out, Size size) {
  return Functions::serialize(c, state, out, size);
}
Status fmi3DeserializeFMUState(Instance c, const std::uint8_t* bytes, Size size, State* state) {
  return Functions::deserialize(c, bytes, size, state);
}

// --- steps ---

Status fmi3DoStep(Instance c, double from, double length, bool, bool* event_needed, bool* ended,
                  bool* early, double* last_time) {
  return Functions::call(c, __func__, [&](Slave& s) {
    const Status out = Functions::step(s, from, length, Status::ok, "fmi3DoStep");
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
  return refuse(c, "this model gives no directional derivatives");
}
Status fmi3GetAdjointDerivative(Instance c, At, Size, At, Size, const double*, Size, double*,
                                Size) {
  return refuse(c, "this model gives no adjoint derivatives");
}
Status fmi3GetOutputDerivatives(Instance c, At, Size n, const std::int32_t*, double*, Size) {
  return Functions::none(c, n, "this model gives no derivatives of outputs");
}
Status fmi3GetIntervalDecimal(Instance c, At, Size, double*, int*) { return refuse(c, no_clocks); }
Status fmi3GetIntervalFraction(Instance c, At, Size, std::uint64_t*, std::uint64_t*, int*) {
  return refuse(c, no_clocks);
}
Status fmi3GetShiftDecimal(Instance c, At, Size, double*) { return refuse(c, no_clocks); }
Status fmi3GetShiftFraction(Instance c, At, Size, std::uint64_t*, std::uint64_t*) {
  return refuse(c, no_clocks);
}
Status fmi3SetIntervalDecimal(Instance c, At, Size, const double*) { return refuse(c, no_clocks); }
Status fmi3SetIntervalFraction(Instance c, At, Size, const std::uint64_t*, const std::uint64_t*) {
  return refuse(c, no_clocks);
}
Status fmi3SetShiftDecimal(Instance c, At, Size, const double*) { return refuse(c, no_clocks); }
Status fmi3SetShiftFraction(Instance c, At, Size, const std::uint64_t*, const std::uint64_t*) {
  return refuse(c, no_clocks);
}
Status fmi3EvaluateDiscreteStates(Instance c) { return refuse(c, no_event_mode); }
Status fmi3UpdateDiscreteStates(Instance c, bool*, bool*, bool*, bool*, bool*, double*) {
  return refuse(c, no_event_mode);
}
Status fmi3EnterContinuousTimeMode(Instance c) { return refuse(c, no_exchange); }
Status fmi3CompletedIntegratorStep(Instance c, bool, bool*, bool*) {
  return refuse(c, no_exchange);
}
Status fmi3SetTime(Instance c, double) { return refuse(c, no_exchange); }
Status fmi3SetContinuousStates(Instance c, const double*, Size) { return refuse(c, no_exchange); }
Status fmi3GetContinuousStateDerivatives(Instance c, double*, Size) {
  return refuse(c, no_exchange);
}
Status fmi3GetEventIndicators(Instance c, double*, Size) { return refuse(c, no_exchange); }
Status fmi3GetContinuousStates(Instance c, double*, Size) { return refuse(c, no_exchange); }
Status fmi3GetNominalsOfContinuousStates(Instance c, double*, Size) {
  return refuse(c, no_exchange);
}
Status fmi3GetNumberOfEventIndicators(Instance c, Size*) { return refuse(c, no_exchange); }
Status fmi3GetNumberOfContinuousStates(Instance c, Size*) { return refuse(c, no_exchange); }
Status fmi3ActivateModelPartition(Instance c, Reference, double) { return refuse(c, no_clocks); }

}  // extern "C"
#pragma GCC visibility pop
