// fmu/slave/fmi2.h - declarations of FMI 2.0 for co-simulation: types and statuses of the
// standard's sections 2.1 and 4.2 with the same values. Importers are compiled with their own.
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

// Enumerations of the standard, in its order.
enum class Status { ok, warning, discard, error, fatal, pending };
enum class Type { model_exchange, co_simulation };
enum class StatusKind { do_step, pending, last_successful_time, terminated };

// Functions that an importer provides to a slave.
struct Callbacks {
  void (*logger)(Environment, String instance, Status, String category, String format, ...);
  void* (*allocate)(std::size_t, std::size_t);
  void (*free)(void*);
  void (*step_finished)(Environment, Status);
  Environment environment;
};

}  // namespace sinew::fmu::fmi2
