// The methods on functions with known optima; their points depend on seed and costs alone.
#include "sinew/tune/optimizer/tuning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sinew/tune/sample.h"

namespace sinew::tune::method_test {
namespace {

using Function = std::function<std::vector<double>(const double*)>;

struct Progress {
  std::vector<std::vector<double>> generations;  // points
  std::vector<std::vector<double>> costs;
  bool converged = false;
};

Progress progress(const MethodParameters& parameters, const Function& f, int generations) {
  Progress out;
  OptimizerMethod method(parameters);
  std::vector<double> points =
      sobol_shares(parameters.dimensions, parameters.population, parameters.seed);
  for (int g = 0; g < generations && !out.converged; ++g) {
    if (g > 0) points = method.ask();
    out.converged = points.empty();
    if (out.converged) break;
    std::vector<double> costs;
    for (std::size_t i = 0; i < parameters.population; ++i) {
      const std::vector<double> one = f(&points[i * parameters.dimensions]);
      costs.insert(costs.end(), one.begin(), one.end());
    }
    g == 0 ? method.begin(points, costs) : method.tell(costs);
    out.generations.push_back(points);
    out.costs.push_back(costs);
  }
  return out;
}

// Rosenbrock's valley over [-2, 2]^n, 0 at 1.
std::vector<double> rosenbrock(const double* u, std::size_t n) {
  double sum = 0;
  const auto x = [&](std::size_t i) { return 4 * u[i] - 2; };
  for (std::size_t i = 0; i + 1 < n; ++i)
    sum += 100 * std::pow(x(i + 1) - x(i) * x(i), 2) + std::pow(1 - x(i), 2);
  return {sum};
}

TEST(Method, CmaesFollowsABentValley) {
  const MethodParameters parameters{.dimensions = 5, .population = 16, .seed = 3};
  const Progress c = progress(
      parameters, [](const double* u) { return rosenbrock(u, 5); }, 400);
  EXPECT_LT(*std::ranges::min_element(c.costs.back()), 1e-8);
  EXPECT_NEAR(c.generations.back()[0], 0.75, 1e-4);
}

TEST(Method, CmaesEndsWhereItsPointsAreOne) {
  const MethodParameters parameters{.dimensions = 2, .population = 16, .seed = 3};
  const Progress c = progress(
      parameters, [](const double* u) { return rosenbrock(u, 2); }, 1000);
  EXPECT_TRUE(c.converged);
  EXPECT_LT(c.costs.size(), 300U);
}

// ZDT1 (Zitzler, Deb, Thiele 2000): its front is f2 = 1 - sqrt(f1), at 0 in all coordinates but the
// first.
TEST(Method, Nsga2SpreadsAlongAKnownFront) {
  const std::size_t n = 6;
  const auto zdt1 = [&](const double* u) {
    double rest = 0;
    for (std::size_t i = 1; i < n; ++i) rest += u[i];
    const double g = 1 + 9 * rest / double(n - 1);
    return std::vector<double>{u[0], g * (1 - std::sqrt(u[0] / g))};
  };
  const MethodParameters parameters{
      .kind = MethodKind::nsga2, .dimensions = n, .costs = 2, .population = 40, .seed = 2};
  const Progress c = progress(parameters, zdt1, 150);
  double most = 0, low = 1, high = 0;
  for (std::size_t i = 0; i < parameters.population; ++i) {
    const double f1 = c.costs.back()[2 * i], f2 = c.costs.back()[2 * i + 1];
    most = std::max(most, f2 - (1 - std::sqrt(f1)));
    low = std::min(low, f1), high = std::max(high, f1);
  }
  EXPECT_LT(most, 0.2);
  EXPECT_LT(low, 0.05);
  EXPECT_GT(high, 0.9);
}

TEST(Method, StaysInsideItsRanges) {
  for (const MethodKind kind : {MethodKind::cmaes, MethodKind::nsga2}) {
    const std::size_t goals = kind == MethodKind::cmaes ? 1 : 2;
    const MethodParameters parameters{
        .kind = kind, .dimensions = 3, .costs = goals, .population = 16, .seed = 5};
    // The optimum is in a corner.
    const auto f = [&](const double* u) { return std::vector(goals, u[0] - u[1] + u[2]); };
    const Progress c = progress(parameters, f, 60);
    for (const auto& points : c.generations)
      for (const double u : points) EXPECT_TRUE(u >= 0 && u <= 1) << u;
    EXPECT_LT(*std::ranges::min_element(c.costs.back()), -0.99);
  }
}

TEST(Method, TheSameSeedAndCostsGiveTheSamePoints) {
  for (const MethodKind kind : {MethodKind::cmaes, MethodKind::nsga2}) {
    const std::size_t goals = kind == MethodKind::cmaes ? 1 : 2;
    MethodParameters parameters{
        .kind = kind, .dimensions = 4, .costs = goals, .population = 16, .seed = 11};
    const auto f = [&](const double* u) { return std::vector(goals, rosenbrock(u, 4)[0]); };
    const Progress a = progress(parameters, f, 20), b = progress(parameters, f, 20);
    EXPECT_EQ(a.generations, b.generations);
    parameters.seed = 12;
    EXPECT_NE(progress(parameters, f, 20).generations, a.generations);
  }
}

TEST(Method, WhatPagmoRefusesIsReported) {
  OptimizerMethod method({.kind = MethodKind::nsga2, .dimensions = 2, .costs = 2, .population = 6});
  method.begin(std::vector<double>(12, 0.5), std::vector<double>(12, 1.0));
  EXPECT_THROW((void)method.ask(), std::runtime_error) << "no multiple of 4";
}

}  // namespace
}  // namespace sinew::tune::method_test
