#include "sinew/identify/contest/profile.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace sinew::identify::profile_test {
namespace {

// The problem of a + b x at 21 places with noise.
FitProblem line(double a, double b, double noise = 0.1) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, noise);
  std::vector<double> x, y;
  for (int i = 0; i <= 20; ++i) {
    x.push_back(0.1 * i);
    y.push_back(a + b * x.back() + normal(random));
  }
  FitProblem out{.count = x.size(),
                 .parameters = {{.name = "a", .unit = "1", .start = 1},
                                {.name = "b", .unit = "1", .start = 1}}};
  out.residuals = [x, y](std::span<const double> p, std::span<double> r) {
    for (std::size_t i = 0; i < x.size(); ++i) r[i] = p[0] + p[1] * x[i] - y[i];
    return true;
  };
  return out;
}

Solution solved(const FitProblem& p) {
  return least_squares(p.residuals, p.count, p.parameters, p.options);
}

// For a straight line the profile has a closed form: S(x) = S + ((x - value)/error)^2 s^2.
TEST(Profiles, OfALinearLawAreParabolas) {
  const FitProblem problem = line(0.3, 0.2);
  const Solution s = solved(problem);
  const auto profiles = profiles_of(problem, s);
  ASSERT_EQ(profiles.size(), 2u);
  const double best = s.rms * s.rms * static_cast<double>(problem.count);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(profiles[i].has_value());
    EXPECT_FALSE(profiles[i]->near_zero);
    for (std::size_t k = 0; k < Profile::factors.size(); ++k) {
      const double off = (Profile::factors[k] - 1) * s.values[i] / s.estimates[i].standard_error;
      const double loss = best + off * off * s.standard_deviation * s.standard_deviation;
      EXPECT_NEAR(profiles[i]->error[k], std::min(std::sqrt(loss / best), Profile::most), 1e-6);
    }
    const bool holds_half = s.estimates[i].low <= 0.5 * s.values[i];
    const bool holds_twice = s.estimates[i].high >= 2 * s.values[i];
    EXPECT_EQ(profiles[i]->pinned, !holds_half && !holds_twice);
  }
}

// Averages with their weights and variances give the errors of all readings.
TEST(Profiles, OfAveragesAreThoseOfTheirReadings) {
  constexpr std::size_t each = 12;
  const FitProblem exact = line(0.3, 0.2, 0.01);
  FitProblem averages = exact, all = exact;
  std::mt19937 random(2);
  std::normal_distribution<double> normal(0, 0.2);
  std::vector<double> off, mean(exact.count);
  for (std::size_t i = 0; i < exact.count; ++i) {
    double squares = 0;
    for (std::size_t k = 0; k < each; ++k) {
      off.push_back(normal(random));
      mean[i] += off.back() / each;
      squares += off.back() * off.back() / each;
    }
    averages.options.weights.push_back(each);
    averages.options.variances.push_back(squares - mean[i] * mean[i]);
  }
  averages.residuals = [exact, mean](std::span<const double> p, std::span<double> r) {
    exact.residuals(p, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= mean[i];
    return true;
  };
  all.count = off.size();
  all.residuals = [exact, off](std::span<const double> p, std::span<double> r) {
    std::vector<double> few(exact.count);
    exact.residuals(p, few);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = few[i / each] - off[i];
    return true;
  };
  const auto of_averages = profiles_of(averages, solved(averages));
  const auto of_all = profiles_of(all, solved(all));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(of_averages[i]->pinned, of_all[i]->pinned);
    for (std::size_t k = 0; k < Profile::factors.size(); ++k)
      EXPECT_NEAR(of_averages[i]->error[k], of_all[i]->error[k], 1e-6);
  }
}

TEST(Profiles, OfWeakDataPinNothing) {
  const FitProblem problem = line(0.3, 0.2, 2);
  for (const auto& profile : profiles_of(problem, solved(problem))) EXPECT_FALSE(profile->pinned);
}

// Each factor of a product is arbitrary, as the other compensates.
TEST(Profiles, OfAProductPinNoneOfItsFactors) {
  FitProblem problem = line(1, 3, 1e-3);
  problem.residuals = [linear = problem.residuals](std::span<const double> p, std::span<double> r) {
    return linear(std::array{1.0, p[0] * p[1]}, r);
  };
  for (Parameter& p : problem.parameters) p.low = 0.1, p.high = 100;
  const auto profiles = profiles_of(problem, solved(problem));
  for (const auto& profile : profiles) {
    ASSERT_TRUE(profile.has_value());
    EXPECT_FALSE(profile->pinned);
    for (const double error : profile->error) EXPECT_NEAR(error, 1, 1e-6);
  }
}

// Only data count: a prior is no evidence.
// Values near narrow bounds cannot be halved or doubled: the errors at 0.8 and 1.25 times count.
TEST(Profiles, WithinNarrowBoundsAreJudgedOnTheWay) {
  for (const double noise : {0.01, 20.0}) {
    FitProblem problem = line(3, 1, noise);
    problem.parameters[0] = {
        .name = "a", .unit = "1", .start = 3, .low = 2.65, .high = 3.5, .scale = 90};
    const auto profile = profiles_of(problem, solved(problem))[0];
    ASSERT_TRUE(profile.has_value());
    EXPECT_FALSE(profile->near_zero);  // its range does not contain zero
    EXPECT_TRUE(std::isnan(profile->error.front()) || noise > 1);
    EXPECT_EQ(profile->pinned, noise < 1);
  }
}

TEST(Profiles, CountNoPriors) {
  FitProblem problem = line(0.3, 0.2, 2);
  problem.residuals = [data = problem.residuals](std::span<const double> p, std::span<double> r) {
    r.back() = (p[0] - 0.3) / 1e-3;
    return data(p, r.first(r.size() - 1));
  };
  problem.data = problem.count++;
  EXPECT_FALSE(profiles_of(problem, solved(problem))[0]->pinned);
  problem.data = 0;
  EXPECT_TRUE(profiles_of(problem, solved(problem))[0]->pinned);
}

TEST(Profiles, AreNoneOfFrozenValuesAndOfNoFreedom) {
  FitProblem problem = line(0.3, 0.2);
  problem.constraints =
      Constraints(ConstraintTexts{.freeze = {"a=0.3 SI"}, .prior = {}, .tie = {}});
  const Solution s = least_squares(problem.residuals, problem.count, problem.parameters,
                                   problem.constraints, problem.options);
  const auto profiles = profiles_of(problem, s);
  EXPECT_FALSE(profiles[0].has_value());
  EXPECT_TRUE(profiles[1].has_value());

  FitProblem exact = line(0.3, 0.2);
  exact.residuals = [](std::span<const double> p, std::span<double> r) {
    r[0] = p[0] - 1, r[1] = p[1] - 2;
    return true;
  };
  exact.count = 2;
  EXPECT_FALSE(profiles_of(exact, solved(exact))[0].has_value());
}

// At a bound of 0, as of a friction, only the free side counts. Another bound pins nothing.
TEST(Profiles, AtABoundTheFreeSideCounts) {
  for (const double low : {0.0, 0.5}) {
    FitProblem problem = line(1, low - 0.05, 0.01);
    problem.parameters[1].start = 1;
    problem.parameters[1].low = low;
    const Solution s = solved(problem);
    ASSERT_TRUE(s.estimates[1].at_bound);
    const auto profile = profiles_of(problem, s)[1];
    ASSERT_TRUE(profile.has_value());
    EXPECT_TRUE(std::isnan(profile->error.front()));
    EXPECT_GT(profile->error.back(), 2);
    EXPECT_EQ(profile->pinned, low == 0);
  }
}

}  // namespace
}  // namespace sinew::identify::profile_test
