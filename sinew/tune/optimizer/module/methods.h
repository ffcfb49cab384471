// tune/optimizer/module/methods.h - interface of the module with pagmo: an optimiser that returns a
// generation of points in the unit cube and is given the cost of each.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// MethodParameters in C, for the module.
struct SinewMethodParameters {
  int nsga2;               // 1: NSGA-II; 0: CMA-ES
  std::size_t dimensions;  // coordinates of a point
  std::size_t costs;       // costs of a point; CMA-ES: 1
  std::size_t population;  // points of a generation
  std::uint64_t seed;
  double step;  // CMA-ES: initial standard deviation, as a share of each range
};

// Functions return false if pagmo failed; error_text() then returns the error.
struct SinewMethods {
  void* (*make)(const SinewMethodParameters* parameters);
  bool (*begin)(void* method, const double* points, const double* costs);  // the first generation
  // Writes a generation; `count` is 0 if the method has converged.
  bool (*ask)(void* method, double* points, std::size_t* count);
  bool (*tell)(void* method, const double* costs);  // costs of the points that ask() wrote
  const char* (*error_text)(void* method);
  void (*end)(void* method);
};

const SinewMethods* sinew_methods_1();  // the number is the version of the structs

}  // extern "C"
