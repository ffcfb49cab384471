// The linearly implicit step: its order, its stability, and what it conserves.
#include "sinew/air/stiff/quick.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::air::rodas3_test {
namespace {

// x' = -k x^2 + a cos(t), what leaves through the second opening is k x^2.
struct Curved {
  double k = 3, a = 0.7;

  QuickRates<1> operator()(double t, const std::array<double, 1>& x, bool) const {
    QuickRates<1> r;
    r.passed = {a * std::cos(t), k * x[0] * x[0], 0};
    r.mass = {r.passed[0] - r.passed[1]};
    r.mass_by[0][0] = -2 * k * x[0];
    r.passed_by[1][0] = 2 * k * x[0];
    r.passed_by_time = {-a * std::sin(t), 0, 0};
    r.mass_by_time = {-a * std::sin(t)};
    return r;
  }
};

double end_of(int steps) {
  std::array<double, 1> x{1.0};
  for (int i = 0; i < steps; ++i)
    x = rodas3_step<1>(Curved{}, 1.0 * i / steps, x, 1.0 / steps).mass;
  return x[0];
}

TEST(Rodas3, IsOfThirdOrder) {
  const double exact = end_of(20000);
  const double coarse = std::abs(end_of(40) - exact), fine = std::abs(end_of(80) - exact);
  EXPECT_GT(std::log2(coarse / fine), 2.8);
  EXPECT_LT(coarse, 1e-5);
}

// Two chambers that share their air within a microsecond, with a leak: a step of a millisecond
// reaches the shared value.
TEST(Rodas3, TakesStiffBodiesInItsStride) {
  const double share = 1e6, leak = 10;
  const auto rates = [&](double, const std::array<double, 2>& x, bool) {
    const double passes = share * (x[0] - x[1]);
    QuickRates<2> r;
    r.mass = {-passes, passes - leak * x[1]};
    r.passed = {0, 0, leak * x[1]};
    r.mass_by = {{{-share, share}, {share, -share - leak}}};
    r.passed_by[2][1] = leak;
    return r;
  };
  std::array<double, 2> x{2, 1};
  for (int i = 0; i < 100; ++i) x = rodas3_step<2>(rates, 0, x, 1e-3).mass;
  const double expected = 1.5 * std::exp(-0.5 * leak * 0.1);
  EXPECT_NEAR(x[0], expected, 1e-5);
  EXPECT_NEAR(x[1], expected, 1e-5);
}

TEST(Rodas3, ConservesWhatItsRatesConserve) {
  std::array<double, 1> x{1.0};
  for (int i = 0; i < 50; ++i) {
    const QuickStep<1> s = rodas3_step<1>(Curved{}, 0.02 * i, x, 0.02);
    EXPECT_NEAR(s.mass[0] - x[0], s.passed[0] - s.passed[1] - s.passed[2], 1e-15);
    EXPECT_GT(s.error[0], 0);
    x = s.mass;
  }
}

}  // namespace
}  // namespace sinew::air::rodas3_test
