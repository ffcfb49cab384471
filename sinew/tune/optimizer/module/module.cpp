// The module with pagmo in it.
//
// A method of pagmo advances a population by a generation and evaluates its points one by one
// meanwhile. The points of a generation do not depend on their own costs, so a generation is run
// twice from the same state: once with arbitrary costs to record its points, and once with the
// costs that were found in between.
#include <algorithm>
#include <exception>
#include <memory>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sinew/tune/optimizer/module/methods.h"

namespace {

using sinew::tune::MethodKind;
using sinew::tune::MethodParameters;

using Point = pagmo::vector_double;

// The points of a generation in the order of their evaluation.
struct Generation {
  std::vector<Point> points, costs;
  std::size_t next = 0;
  bool noting = true;
};

struct Costs {
  std::shared_ptr<Generation> generation;
  std::size_t dimensions = 1, costs = 1;

  std::pair<Point, Point> get_bounds() const {
    return {Point(dimensions, 0.0), Point(dimensions, 1.0)};
  }
  Point::size_type get_nobj() const { return costs; }

  Point fitness(const Point& x) const {
    Generation& g = *generation;
    if (g.noting) {
      g.points.push_back(x);
      return Point(costs, 0.0);
    }
    if (g.next >= g.points.size() || g.points[g.next] != x)
      throw std::logic_error("pagmo evaluates other points than it proposed");
    return g.costs[g.next++];
  }
};

class Method {
 public:
  explicit Method(const MethodParameters& parameters)
      : parameters_(parameters), generation_(std::make_shared<Generation>()) {
    const auto seed = static_cast<unsigned>(parameters.seed ^ (parameters.seed >> 32));
    if (parameters.kind == MethodKind::nsga2)
      algorithm_.emplace<pagmo::nsga2>(1U, 0.95, 10.,
                                       1. / static_cast<double>(parameters.dimensions), 20., seed);
    else
      // -1: Hansen's values. The tolerance of costs is off, since costs may be equal far from the
      // best point, and points beyond the ranges are not allowed.
      algorithm_.emplace<pagmo::cmaes>(1U, -1., -1., -1., -1., parameters.step, 0., 1e-6, true,
                                       true, seed);
    population_ = pagmo::population(
        pagmo::problem(Costs{generation_, parameters.dimensions, parameters.costs}), 0, seed);
  }

  void begin(const double* points, const double* costs) {
    for (std::size_t i = 0; i < parameters_.population; ++i)
      population_.push_back(point(points, i), cost(costs, i));
  }

  std::size_t ask(double* points) {
    *generation_ = {};
    auto copy = algorithm_;
    std::visit([&](auto& algorithm) { algorithm.evolve(population_); }, copy);
    for (const Point& x : generation_->points) points = std::ranges::copy(x, points).out;
    return generation_->points.size();
  }

  void tell(const double* costs) {
    for (std::size_t i = 0; i < generation_->points.size(); ++i)
      generation_->costs.push_back(cost(costs, i));
    generation_->noting = false;
    std::visit([&](auto& algorithm) { population_ = algorithm.evolve(population_); }, algorithm_);
  }

  std::string error_text;

 private:
  Point point(const double* all, std::size_t i) const {
    return {all + i * parameters_.dimensions, all + (i + 1) * parameters_.dimensions};
  }
  Point cost(const double* all, std::size_t i) const {
    return {all + i * parameters_.costs, all + (i + 1) * parameters_.costs};
  }

  MethodParameters parameters_;
  std::shared_ptr<Generation> generation_;
  std::variant<pagmo::cmaes, pagmo::nsga2> algorithm_;
  pagmo::population population_;
};

// Catches all exceptions, since the caller may be built by another compiler.
template <class Work>
bool guarded(void* method, const Work& work) {
  auto& own = *static_cast<Method*>(method);
  try {
    work(own);
    return true;
  } catch (const std::exception& e) {
    own.error_text = e.what();
    return false;
  }
}

void* make(const MethodParameters* parameters) try {
  return new Method(*parameters);
} catch (const std::exception&) {
  return nullptr;
}

bool begin(void* method, const double* points, const double* costs) {
  return guarded(method, [&](Method& m) { m.begin(points, costs); });
}

bool ask(void* method, double* points, std::size_t* count) {
  return guarded(method, [&](Method& m) { *count = m.ask(points); });
}

bool tell(void* method, const double* costs) {
  return guarded(method, [&](Method& m) { m.tell(costs); });
}

const char* error_text(void* method) { return static_cast<Method*>(method)->error_text.c_str(); }

void end(void* method) { delete static_cast<Method*>(method); }

constexpr SinewMethods methods{make, begin, ask, tell, error_text, end};

}  // namespace

extern "C" const SinewMethods* sinew_methods_1() { return &methods; }
