// tune/optimizer/module/methods.h - interface of the module with pagmo: an optimiser that returns a
// generation of points in the unit cube and is given the cost of each.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sinew::tune {

// CMA-ES, for one goal; NSGA-II, for several.
enum class MethodKind : int { cmaes, nsga2 };

// Parameters of a method.
struct MethodParameters {
  MethodKind kind = MethodKind::cmaes;
  std::size_t dimensions = 0;   // coordinates of a point, above 0
  std::size_t costs = 1;        // costs of a point; cmaes: 1
  std::size_t population = 16;  // points of a generation, at least 5; nsga2: a multiple of 4
  std::uint64_t seed = 1;
  double step = 0.3;  // cmaes: initial standard deviation, as a share of each range
};

}  // namespace sinew::tune

extern "C" {

// Functions return false if pagmo failed; error_text() then returns the error.
struct SinewMethods {
  void* (*make)(const sinew::tune::MethodParameters* parameters);
  bool (*begin)(void* method, const double* points, const double* costs);  // the first generation
  // Writes a generation; `count` is 0 if the method has converged.
  bool (*ask)(void* method, double* points, std::size_t* count);
  bool (*tell)(void* method, const double* costs);  // costs of the points that ask() wrote
  const char* (*error_text)(void* method);
  void (*end)(void* method);
};

const SinewMethods* sinew_methods_1();  // the number is the version of the structs

}  // extern "C"
