// Constraints: frozen and tied parameters compared with closed forms, a prior compared with a
// measurement of its weight, and invalid constraints.
#include "sinew/identify/contest/constraint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "sinew/config/diagnostics.h"

namespace sinew::identify::wish_test {
namespace {

const Parameter two[] = {{.name = "a", .unit = "N", .low = -100, .high = 100, .scale = 1},
                         {.name = "b of x.csv", .unit = "N/m", .scale = 1}};

// y = 1.5 - 2 x with noise.
struct Data {
  std::vector<double> x, y;

  explicit Data(unsigned seed, double noise = 0.1, int n = 40) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise);
    for (int i = 0; i < n; ++i) {
      x.push_back(0.1 + static_cast<double>(i) / n);
      y.push_back(1.5 - 2 * x.back() + normal(random));
    }
  }

  Solution solve(const Constraints& constraints) const {
    const auto residuals = [this](std::span<const double> p, std::span<double> r) {
      for (std::size_t i = 0; i < x.size(); ++i) r[i] = p[0] + p[1] * x[i] - y[i];
      return true;
    };
    return least_squares(residuals, x.size(), two, constraints);
  }

  double sum(const std::function<double(double, double)>& of) const {
    double out = 0;
    for (std::size_t i = 0; i < x.size(); ++i) out += of(x[i], y[i]);
    return out;
  }
};

std::string told(const std::function<void()>& ask) {
  try {
    ask();
  } catch (const config::Error& e) {
    return e.what();
  }
  return "nothing";
}

std::string checked(const ConstraintTexts& texts) {
  return told([&] { Constraints(texts).check(two); });
}

TEST(Constraint, AFrozenParameterLeavesTheClosedFormOfTheOther) {
  const Data data(1);
  const Solution s = data.solve(Constraints({.freeze = {"a=1.5 N"}}));
  const double xx = data.sum([](double x, double) { return x * x; });
  const double b = data.sum([](double x, double y) { return x * (y - 1.5); }) / xx;
  EXPECT_EQ(s.values[0], 1.5);
  EXPECT_NEAR(s.values[1], b, 1e-8);
  EXPECT_EQ(s.freedom, 39);
  EXPECT_FALSE(s.estimates[0].free);
  EXPECT_EQ(s.estimates[0].known, "frozen");
  EXPECT_EQ(s.estimates[0].low, s.estimates[0].high);
  const double rr = data.sum([&](double x, double y) { return std::pow(1.5 + b * x - y, 2); });
  EXPECT_NEAR(s.estimates[1].standard_error, std::sqrt(rr / 39 / xx), 1e-8);
  EXPECT_EQ(s.covariance[0], 0);
  EXPECT_EQ(free_count(s.estimates), 1u);
}

TEST(Constraint, TiedParametersAreOne) {
  const Parameter pair[] = {{.name = "a", .unit = "N"}, {.name = "b", .unit = "N"}};
  const Data data(2);
  const auto residuals = [&](std::span<const double> p, std::span<double> r) {
    for (std::size_t i = 0; i < data.x.size(); ++i) r[i] = p[0] + p[1] * data.x[i] - data.y[i];
    return true;
  };
  const Solution s = least_squares(residuals, data.x.size(), pair, Constraints({.tie = {"b=a"}}));
  const double a = data.sum([](double x, double y) { return (1 + x) * y; }) /
                   data.sum([](double x, double) { return (1 + x) * (1 + x); });
  EXPECT_NEAR(s.values[0], a, 1e-8);
  EXPECT_EQ(s.values[0], s.values[1]);
  EXPECT_EQ(s.estimates[1].known, "tied to a");
  EXPECT_EQ(s.covariance[1], s.covariance[0]);
  EXPECT_EQ(free_count(s.estimates), 1u);
}

// Equals one more point that measures a, with the standard deviation of the prior.
TEST(Constraint, APriorWeighsAsAMeasurementOfItsDeviation) {
  const Data data(3);
  const Solution s = data.solve(Constraints({.prior = {"a=1.7±0.02 N"}}));
  const double alone = data.solve({}).standard_deviation;  // for the data without the prior
  const double n = 40, w = alone * alone / (0.02 * 0.02), s2 = std::pow(s.standard_deviation, 2);
  const double mx = data.sum([](double x, double) { return x; }),
               my = data.sum([](double, double y) { return y; }),
               xx = data.sum([](double x, double) { return x * x; }),
               xy = data.sum([](double x, double y) { return x * y; });
  const double determinant = (n + w) * xx - mx * mx;
  EXPECT_NEAR(s.values[0], ((my + w * 1.7) * xx - mx * xy) / determinant, 1e-7);
  EXPECT_NEAR(s.values[1], ((n + w) * xy - mx * (my + w * 1.7)) / determinant, 1e-7);
  EXPECT_NEAR(s.estimates[0].standard_error, std::sqrt(s2 * xx / determinant), 1e-7);
  EXPECT_EQ(s.residuals.size(), 40u);
  EXPECT_TRUE(s.estimates[0].free);
}

TEST(Constraint, APriorThatTheDataContradictOrDoNotNarrowIsReported) {
  const Data data(4);
  EXPECT_NE(data.solve(Constraints({.prior = {"a=30 N ± 0.1 N"}})).estimates[0].known.find("away"),
            std::string::npos);
  EXPECT_EQ(data.solve(Constraints({.prior = {"a=1.5 N +- 0.001 N"}})).estimates[0].known,
            "prior 1.5 +- 0.001, which the data do not narrow");
}

TEST(Constraint, NamesStandForAllOfTheirKind) {
  const Constraints constraints({.freeze = {"b=0.3 SI"}});
  EXPECT_EQ(Data(5).solve(constraints).values[1], 0.3);
  EXPECT_EQ(checked({.freeze = {"b=-2 N/m"}}), "nothing");
  EXPECT_EQ(constraints.of("bx"), nullptr);
}

TEST(Constraint, WhatIsInvalidIsReportedBySettingAndName) {
  EXPECT_EQ(told([] { Constraints({.freeze = {"a"}}); }),
            "freeze: found \"a\"; expected NAME=VALUE");
  EXPECT_EQ(told([] { Constraints({.prior = {"a=3 N"}}); }),
            "prior: found \"a=3 N\"; expected NAME=VALUE±DEVIATION");
  EXPECT_EQ(told([] { Constraints({.freeze = {"a=3 N"}, .tie = {"a=b"}}); }),
            "tie: found \"a=b\"; expected one setting for a parameter");
  EXPECT_EQ(checked({.freeze = {"c=3 N"}}),
            "freeze: found \"c\"; expected a parameter: a or b of x.csv");
  EXPECT_EQ(
      checked({.freeze = {"a=3 m"}}),
      "freeze: found \"3 m\", m (length) for a; expected N (force); try a quantity such as \"1 "
      "N\"");
  EXPECT_EQ(checked({.freeze = {"a=300 N"}}),
            "freeze: found \"300 N\" for a; expected -100 N to 100 N: the range of the parameter");
  EXPECT_NE(checked({.prior = {"a=3 N ± 0 N"}}).find("a standard deviation"), std::string::npos);
  EXPECT_EQ(checked({.tie = {"a=b"}}), "tie: found \"a=b\"; expected another parameter in N");
}

// With frozen and tied parameters and priors, closed-form derivatives match numerical ones.
TEST(Constraints, TakeDerivativesInClosedFormAlong) {
  const std::vector<Parameter> parameters = {{.name = "a", .unit = "1", .start = 1},
                                             {.name = "b", .unit = "1", .start = 1},
                                             {.name = "c", .unit = "1", .start = 1},
                                             {.name = "d", .unit = "1", .start = 1}};
  constexpr std::size_t rows = 12;
  const auto x = [](std::size_t i) { return 0.1 * static_cast<double>(i); };
  const Residuals residuals = [&](std::span<const double> p, std::span<double> r) {
    for (std::size_t i = 0; i < rows; ++i)
      r[i] = p[0] * std::exp(p[1] * x(i)) + p[2] * x(i) + p[3] - 3 - std::sin(5 * x(i));
    return true;
  };
  int called = 0;
  const Slopes slopes = [&](std::span<const double> p, std::span<double> r, std::span<double> by) {
    ++called;
    residuals(p, r);
    for (std::size_t i = 0; i < rows; ++i) {
      by[i] = std::exp(p[1] * x(i));
      by[rows + i] = p[0] * x(i) * by[i];
      by[2 * rows + i] = x(i);
      by[3 * rows + i] = 1;
    }
    return true;
  };
  for (const ConstraintTexts& texts :
       {ConstraintTexts{.freeze = {"b=0.3 SI"}, .prior = {}, .tie = {}},
        ConstraintTexts{.freeze = {"c=0 SI"}, .prior = {}, .tie = {"d=a"}},
        ConstraintTexts{.freeze = {}, .prior = {"b=0.5 SI +- 0.1 SI"}, .tie = {"c=d"}}}) {
    const Constraints constraints(texts);
    const Solution without = least_squares(residuals, rows, parameters, constraints);
    const Solution with =
        least_squares(residuals, rows, parameters, constraints, {.slopes = slopes});
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      EXPECT_NEAR(with.values[i], without.values[i], 1e-6);
      EXPECT_NEAR(with.estimates[i].high, without.estimates[i].high, 1e-5);
    }
  }
  EXPECT_GT(called, 0);
}

}  // namespace
}  // namespace sinew::identify::wish_test
