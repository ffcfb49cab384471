// Delayed tension: its limits, its closed form, and its invariants.
#include "sinew/actuator/creep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::creep_test {
namespace {

constexpr double bar = 1e5;
constexpr double inch = 0.0254;

Actuator any_actuator(std::mt19937& random) {
  std::uniform_real_distribution<double> size(0.5, 1.5);
  Actuator a = thesis_actuator();
  a.braid.thread_length *= size(random);
  a.bladder = {.stiffness = 400 * size(random), .rest_length = 3 * inch};
  a.creep = {.share = {0.02 * size(random), 0.03 * size(random)}, .time = {1, 20}};
  return a;
}

double total(const Actuator& a, double length, double p, double late0, double late1) {
  return clamped_tension(a, length, 0, p, thesis_atmosphere) +
         creep_tension(a, a.creep.share[0], length, late0, thesis_atmosphere) +
         creep_tension(a, a.creep.share[1], length, late1, thesis_atmosphere);
}

// In the end the pressure's part of the tension is 1 + sum c_i times its initial value, whatever
// else pulls.
TEST(Creep, EndsAtOnePlusItsShares) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> pressures(0.1 * bar, 7 * bar), lengths(0.6, 0.9);
  for (int i = 0; i < 200; ++i) {
    const Actuator a = any_actuator(random);
    const double l = a.braid.thread_length * lengths(random), p = pressures(random);
    const double slack = clamped_tension(a, l, 0, 0, thesis_atmosphere);
    const double quick = clamped_tension(a, l, 0, p, thesis_atmosphere) - slack;
    EXPECT_NEAR(total(a, l, p, 0, 0), slack + quick, 1e-12 * quick);
    EXPECT_NEAR(total(a, l, p, p, p) - slack, quick * (1 + a.creep.share[0] + a.creep.share[1]),
                1e-9 * quick);
  }
}

TEST(Creep, NoShareIsNone) {
  const Actuator a = thesis_actuator();
  EXPECT_FALSE(has_creep(a.creep));
  EXPECT_EQ(creep_tension(a, 0, 3 * inch, 4 * bar, thesis_atmosphere), 0);
}

// The rate's solution is the exponential in the header.
TEST(Creep, IsExponentialWhereTheEffectivenessIsConstant) {
  Actuator a = thesis_actuator();
  a.effectiveness = {.c0 = 0.9};
  a.creep = {.share = {0.05, 0}, .time = {2.0, 0}};
  const double l = 3.2 * inch, p = 5 * bar, h = 1e-3;
  const double quick = clamped_tension(a, l, 0, p, thesis_atmosphere);
  double late = 0;
  for (int k = 1; k <= 4000; ++k) {
    const double half = late + 0.5 * h * creep_rate(a.creep.time[0], p, late);
    late += h * creep_rate(a.creep.time[0], p, half);
    if (k % 500 != 0) continue;
    const double expected = quick * (1 + 0.05 * (1 - std::exp(-k * h / 2.0)));
    EXPECT_NEAR(total(a, l, p, late, 0), expected, 1e-8 * quick) << k;
  }
}

}  // namespace
}  // namespace sinew::actuator::creep_test
