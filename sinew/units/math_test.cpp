// The accuracy stated in math.h, on seeded random arguments against long double, and the
// identities that the physics relies on.

#include "sinew/units/math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sinew::units::math_test {
namespace {

constexpr int samples = 200000;

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11) * 0x1p-53);
  }

 private:
  std::mt19937_64 bits_;
};

double relative(double value, long double truth) {
  return static_cast<double>(std::fabs((value - truth) / truth));
}

TEST(Math, SineAndCosineAreGoodTo18e16) {
  Random random(1);
  for (double range : {0.8, 10.0, 1e3, 1e6}) {
    for (int i = 0; i < samples / 4; ++i) {
      const double x = random.between(-range, range);
      const SinCos y = sin_cos(x);
      const long double lx = x;
      ASSERT_NEAR(static_cast<double>(y.sin - std::sin(lx)), 0, 1.8e-16) << x;
      ASSERT_NEAR(static_cast<double>(y.cos - std::cos(lx)), 0, 1.8e-16) << x;
    }
  }
}

TEST(Math, SineAndCosineHoldWhereTheQuadrantChanges) {
  Random random(2);
  for (int k = -4000; k <= 4000; ++k) {
    const double edge = (k + 0.5) * (std::numbers::pi / 2);
    for (double x : {edge, std::nextafter(edge, -1e9), edge + random.between(-1e-6, 1e-6)}) {
      const long double lx = x;
      ASSERT_NEAR(static_cast<double>(sin_cos(x).sin - std::sin(lx)), 0, 1.8e-16) << x;
      ASSERT_NEAR(static_cast<double>(sin_cos(x).cos - std::cos(lx)), 0, 1.8e-16) << x;
    }
  }
}

TEST(Math, SineIsOddAndCosineEvenToTheBit) {
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const double x = random.between(0, 100);
    EXPECT_EQ(sin_cos(-x).sin, -sin_cos(x).sin);
    EXPECT_EQ(sin_cos(-x).cos, sin_cos(x).cos);
  }
  EXPECT_EQ(sin_cos(0.0).sin, 0.0);
  EXPECT_EQ(sin_cos(0.0).cos, 1.0);
}

TEST(Math, LogarithmIsGoodTo35e16) {
  Random random(4);
  for (int i = 0; i < samples; ++i) {
    const double x = std::exp(random.between(-700, 700));
    ASSERT_LT(relative(log(x), std::log(static_cast<long double>(x))), 3.5e-16) << x;

    const double near_one = random.between(0.6, 1.9);
    ASSERT_LT(relative(log(near_one), std::log(static_cast<long double>(near_one))), 3.5e-16)
        << near_one;
  }
  EXPECT_EQ(log(1.0), 0.0);
}

TEST(Math, ExponentialIsGoodTo2e16) {
  Random random(5);
  for (int i = 0; i < samples; ++i) {
    for (double range : {1.0, 700.0}) {
      const double x = random.between(-range, range);
      ASSERT_LT(relative(exp(x), std::exp(static_cast<long double>(x))), 2e-16) << x;
    }
  }
  EXPECT_EQ(exp(0.0), 1.0);
}

TEST(Math, PowerLosesInProportionToTheLogarithmOfItsResult) {
  Random random(6);
  for (int i = 0; i < samples; ++i) {
    const double base = std::exp(random.between(-30, 30));
    const double exponent = random.between(-2.3, 2.3);
    const double result = power(base, exponent);
    const double bound = 2e-16 + 4e-16 * std::abs(std::log(result));
    ASSERT_LT(relative(result, std::pow(static_cast<long double>(base), exponent)), bound)
        << base << " ^ " << exponent;
  }
}

TEST(Math, PowerOfAGasIsGoodTo1e15) {
  Random random(7);
  for (int i = 0; i < samples; ++i) {
    const double ratio = random.between(0.5, 10);
    const double exponent = random.between(1.0 / 7.0, 1.4);
    const auto truth = std::pow(static_cast<long double>(ratio), exponent);
    ASSERT_LT(relative(power(ratio, exponent), truth), 1.1e-15);
  }
}

// All functions are constexpr, with the bits of the running program.
TEST(Math, CompilerAndProgramAgree) {
  constexpr double at_compile_time =
      sin_cos(1.25).sin + log(7.5) + exp(-2.5) + power(3.0, 1.0 / 7.0);
  volatile double a = 1.25, b = 7.5, c = -2.5, d = 3.0;
  EXPECT_EQ(sin_cos(a).sin + log(b) + exp(c) + power(d, 1.0 / 7.0), at_compile_time);
}

}  // namespace
}  // namespace sinew::units::math_test
