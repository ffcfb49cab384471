// tune/optimizer/method.h - an optimiser that is asked for a generation of points and told what
// each of them costs.
//
//   cmaes  CMA-ES (Hansen 2006) for one goal: a normal distribution that follows where points are
//          good
//   nsga2  NSGA-II (Deb et al. 2002) for several: a population that spreads along their front
//
// Both are pagmo's, which is in a module of its own that is opened here and nowhere else. The same
// seed and the same costs give the same points, so a study goes on from its rows: nothing else of
// a method is kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

struct SinewMethods;

namespace sinew::tune {

// CMA-ES, for one goal; NSGA-II, for several.
enum class MethodKind { cmaes, nsga2 };

// Holds what a method of search is made with.
struct MethodAsked {
  MethodKind kind = MethodKind::cmaes;
  std::size_t dimensions = 0;   // of a point, above 0
  std::size_t costs = 1;        // of a point; cmaes: 1
  std::size_t population = 16;  // at least 5; nsga2: a multiple of 4
  std::uint64_t seed = 1;
  double step = 0.3;  // cmaes: the standard deviation it begins with, a share of each range
};

// A search that is asked for points and told what they cost, generation by generation.
class OptimizerMethod {
 public:
  // Throws std::runtime_error where the program was built without pagmo.
  explicit OptimizerMethod(const MethodAsked& asked);

  // The first generation's points, one after the other, and their costs. Throws std::runtime_error,
  // as the others do.
  void begin(const std::vector<double>& points, const std::vector<double>& costs);

  // Returns the next generation's points, each in [0, 1]; none where the method has converged.
  std::vector<double> ask();

  // Tells what the points cost that were asked for last.
  void tell(const std::vector<double>& costs);

 private:
  void check(bool success) const;

  MethodAsked asked_;
  const SinewMethods* methods_;
  std::unique_ptr<void, void (*)(void*)> method_;
};

}  // namespace sinew::tune
