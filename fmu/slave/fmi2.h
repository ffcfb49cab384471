// fmu/slave/fmi2.h - FMI 2.0 for co-simulation as this project declares it: types and statuses of
// the standard's sections 2.1 and 4.2, by their values. Importers are compiled with their own.
#pragma once

#include <cstddef>

namespace sinew::fmu::fmi2 {

using Component = void*;
using Environment = void*;
using State = void*;
using Reference = unsigned int;
using Real = double;
using Integer = int;
using Boolean = int;
using Byte = char;
using String = const char*;

// The standard's enumerations, in its order.
enum class Status { ok, warning, discard, error, fatal, pending };
enum class Type { model_exchange, co_simulation };
enum class StatusKind { do_step, pending, last_successful_time, terminated };

// Holds what an importer lets a slave call.
struct Callbacks {
  void (*logger)(Environment, String instance, Status, String category, String format, ...);
  void* (*allocate)(std::size_t, std::size_t);
  void (*free)(void*);
  void (*step_finished)(Environment, Status);
  Environment environment;
};

}  // namespace sinew::fmu::fmi2
