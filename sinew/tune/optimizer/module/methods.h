// tune/optimizer/module/methods.h - what the module with pagmo in it offers: an optimiser that is
// asked for a generation of points in the unit cube and told what each of them costs.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

// MethodAsked in the words of C, for the module.
struct SinewMethodAsked {
  int nsga2;               // 1: NSGA-II; 0: CMA-ES
  std::size_t dimensions;  // of a point
  std::size_t costs;       // of a point; CMA-ES takes one
  std::size_t population;  // points of a generation
  std::uint64_t seed;
  double step;  // CMA-ES: the standard deviation it begins with, as a share of each range
};

// Functions return false where pagmo failed; then words() says why.
struct SinewMethods {
  void* (*make)(const SinewMethodAsked* asked);
  bool (*begin)(void* method, const double* points, const double* costs);  // the first generation
  // Writes a generation; `count` is 0 where the method has converged.
  bool (*ask)(void* method, double* points, std::size_t* count);
  bool (*tell)(void* method, const double* costs);  // of the points that were asked for
  const char* (*words)(void* method);
  void (*end)(void* method);
};

const SinewMethods* sinew_methods_1();  // the number is the version of the structs

}  // extern "C"
