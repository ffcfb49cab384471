// Estimates, intervals and undetermined parameters, compared with closed forms and by counting.
#include "sinew/identify/contest/least_squares.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>

#include "sinew/host/side_by_side.h"
#include "sinew/identify/contest/fit.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify::least_squares_test {
namespace {

const Parameter line_parameters[] = {{.name = "a", .unit = "N", .scale = 1},
                                     {.name = "b", .unit = "N/m", .scale = 1}};

struct Line {
  std::vector<double> x, y;

  explicit Line(unsigned seed, double noise = 0.1, std::size_t n = 20) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise);
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(static_cast<double>(i) / static_cast<double>(n));
      y.push_back(1.5 - 2 * x.back() + normal(random));
    }
  }

  Residuals residuals() const {
    return [this](std::span<const double> p, std::span<double> r) {
      for (std::size_t i = 0; i < x.size(); ++i) r[i] = p[0] + p[1] * x[i] - y[i];
      return true;
    };
  }
};

// A fit to averages with their weights and variances is that to all readings, with its intervals.
TEST(LeastSquares, AnAverageWeighsAsItsReadings) {
  const Line all(4, 0.3, 60);
  const std::size_t ends[] = {0, 5, 25, 60};
  Line grouped = all, few(0, 0, 3);
  SolverOptions options;
  for (std::size_t g = 0; g < 3; ++g) {
    const auto n = static_cast<double>(ends[g + 1] - ends[g]);
    double mean = 0, squares = 0;
    for (std::size_t i = ends[g]; i < ends[g + 1]; ++i) {
      grouped.x[i] = few.x[g];
      mean += all.y[i] / n;
      squares += all.y[i] * all.y[i] / n;
    }
    few.y[g] = mean;
    options.weights.push_back(n);
    options.variances.push_back(squares - mean * mean);
  }
  const Solution raw = least_squares(grouped.residuals(), 60, line_parameters);
  const Solution averaged = least_squares(few.residuals(), 3, line_parameters, options);
  EXPECT_EQ(averaged.freedom, raw.freedom);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(averaged.values[i], raw.values[i], 1e-7);
    EXPECT_NEAR(averaged.estimates[i].standard_error, raw.estimates[i].standard_error, 1e-7);
  }
}

TEST(LeastSquares, AStraightLineHasItsClosedForm) {
  const Line line(3);
  const Solution s = least_squares(line.residuals(), line.x.size(), line_parameters);
  const auto n = static_cast<double>(line.x.size());
  double mx = 0, my = 0, xx = 0, xy = 0, rr = 0;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    mx += line.x[i] / n;
    my += line.y[i] / n;
  }
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    xx += (line.x[i] - mx) * (line.x[i] - mx);
    xy += (line.x[i] - mx) * (line.y[i] - my);
  }
  const double b = xy / xx, a = my - b * mx;
  for (std::size_t i = 0; i < line.x.size(); ++i) rr += std::pow(a + b * line.x[i] - line.y[i], 2);
  const double s2 = rr / (n - 2);
  EXPECT_TRUE(s.converged);
  EXPECT_NEAR(s.values[0], a, 1e-8);
  EXPECT_NEAR(s.values[1], b, 1e-8);
  EXPECT_NEAR(s["b"].standard_error, std::sqrt(s2 / xx), 1e-8);
  EXPECT_NEAR(s["a"].standard_error, std::sqrt(s2 * (1 / n + mx * mx / xx)), 1e-8);
  EXPECT_EQ(s.freedom, 18);
  EXPECT_NEAR(s["b"].high - s["b"].value, 2.10092 * s["b"].standard_error, 1e-4);
}

TEST(LeastSquares, IntervalsCoverTheTruthAsOftenAsTheySay) {
  int covered = 0;
  double bias = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Line line(seed);
    const Solution s = least_squares(line.residuals(), line.x.size(), line_parameters);
    covered += s["b"].low <= -2 && -2 <= s["b"].high;
    bias += (s["b"].value + 2) / 200;
  }
  EXPECT_GE(covered, 180);
  EXPECT_LE(covered, 198);
  EXPECT_LT(std::abs(bias), 0.02);
}

TEST(LeastSquares, AProductDoesNotDetermineItsFactors) {
  const Line line(5);
  const Residuals product = [&line](std::span<const double> p, std::span<double> r) {
    for (std::size_t i = 0; i < line.x.size(); ++i)
      r[i] = p[0] * p[1] * line.x[i] + p[2] - line.y[i];
    return true;
  };
  const Parameter parameters[] = {{.name = "arm", .unit = "m", .start = 1},
                                  {.name = "gain", .unit = "1", .start = -1},
                                  {.name = "offset", .unit = "N"}};
  const Solution s = least_squares(product, line.x.size(), parameters);
  EXPECT_NEAR(s.values[0] * s.values[1], -2, 0.2);
  EXPECT_FALSE(s["arm"].identifiable);
  EXPECT_FALSE(s["gain"].identifiable);
  EXPECT_TRUE(s["offset"].identifiable);
  ASSERT_EQ(s.undetermined.size(), 1u);
  EXPECT_NE(s.undetermined[0].find("arm"), std::string::npos) << s.undetermined[0];
}

TEST(LeastSquares, OutliersDoNotMoveARobustFit) {
  Line line(7);
  for (const std::size_t i : {2u, 9u, 15u}) line.y[i] += 30;
  const Solution plain = least_squares(line.residuals(), line.x.size(), line_parameters);
  const Solution robust =
      least_squares(line.residuals(), line.x.size(), line_parameters, {.outlier = 0.3});
  EXPECT_GT(std::abs(plain.values[0] - 1.5), 1);
  EXPECT_NEAR(robust.values[0], 1.5, 0.15);
  EXPECT_NEAR(robust.values[1], -2, 0.3);
  EXPECT_LT(robust.standard_deviation, 0.3);
}

TEST(LeastSquares, DerivativesInClosedFormLeadToTheSameSolution) {
  for (const double outlier : {0.0, 0.3}) {
    Line line(7);
    for (const std::size_t i : {2u, 9u, 15u}) line.y[i] += 30;
    SolverOptions options{.outlier = outlier};
    const Solution differences =
        least_squares(line.residuals(), line.x.size(), line_parameters, options);
    options.slopes = [&](std::span<const double> p, std::span<double> r, std::span<double> by) {
      for (std::size_t i = 0; i < r.size(); ++i) by[i] = 1, by[r.size() + i] = line.x[i];
      return line.residuals()(p, r);
    };
    const Solution closed =
        least_squares(line.residuals(), line.x.size(), line_parameters, options);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(closed.values[k], differences.values[k], 1e-8);
      EXPECT_NEAR(closed.estimates[k].standard_error, differences.estimates[k].standard_error,
                  1e-8);
    }
    EXPECT_EQ(closed.steps, differences.steps);
  }
}

TEST(LeastSquares, ASearchThatIsStoppedEndsAtItsNextTrial) {
  const Line line(3);
  std::atomic<bool> stop = false;
  int trials = 0;
  const Residuals residuals = [&](std::span<const double> p, std::span<double> r) {
    stop = ++trials == 4;
    return line.residuals()(p, r);
  };
  const host::Stoppable stoppable(&stop);
  EXPECT_THROW(least_squares(residuals, line.x.size(), line_parameters), host::Stopped);
  EXPECT_EQ(trials, 4);
  EXPECT_THROW(host::side_by_side(3, [](std::size_t) {}), host::Stopped);
}

TEST(LeastSquares, ABoundHoldsAndIsReported) {
  const Line line(9);
  Parameter parameters[] = {line_parameters[0], line_parameters[1]};
  parameters[1].low = -1;
  const Solution s = least_squares(line.residuals(), line.x.size(), parameters);
  EXPECT_NEAR(s.values[1], -1, 1e-6);
  EXPECT_TRUE(s["b"].at_bound);
  EXPECT_FALSE(s["b"].identifiable);
  EXPECT_EQ(s.freedom, 19);
}

TEST(LeastSquares, NoiseThatRemembersWidensTheIntervals) {
  // x_i = 0.8 x_{i-1} + e: the variance of a mean grows by (1 + 0.8)/(1 - 0.8) = 9.
  double inflation = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Line line(seed, 0.1, 2000);
    for (std::size_t i = 0; i < line.x.size(); ++i) line.y[i] -= 1.5 - 2 * line.x[i];
    for (std::size_t i = 1; i < line.x.size(); ++i) line.y[i] += 0.8 * line.y[i - 1];
    inflation +=
        least_squares(line.residuals(), line.x.size(), line_parameters, {.correlated = true})
            .inflation /
        20;
  }
  EXPECT_NEAR(inflation, 9, 1.5);
}

TEST(LeastSquares, FewerPointsThanParametersAreRefused) {
  const Line line(1, 0.1, 1);
  EXPECT_THROW(least_squares(line.residuals(), 1, line_parameters), Refusal);
}

TEST(LeastSquares, QuantilesOfStudentsT) {
  for (const auto& [freedom, t] : {std::pair{1, 12.7062},
                                   {5, 2.57058},
                                   {6, 2.44691},
                                   {10, 2.22814},
                                   {30, 2.04227},
                                   {120, 1.97993},
                                   {100000, 1.95999}})
    EXPECT_NEAR(t_quantile(freedom), t, 2e-3) << freedom;
}

TEST(Choice, TheSimplestModelThatIsNearlyBest) {
  Report report{.subject = "test"};
  const auto add = [&](const char* name, std::size_t parameters, double error, double held_out) {
    Fit fit{.model = name};
    fit.parameters.resize(parameters);
    fit.fit.rmse_percent = error;
    fit.held_out = Score{.rmse_percent = held_out};
    report.fits.push_back(fit);
  };
  add("constant", 1, 5, 5);
  add("linear", 2, 2, 2.1);
  add("quadratic", 3, 1.9, 2.0);
  add("wild", 9, 0.1, 7);
  choose(report);
  EXPECT_EQ(report.best().model, "linear");
  report.fits[1].refused = "not to be had";
  choose(report);
  EXPECT_EQ(report.best().model, "quadratic");
  for (Fit& fit : report.fits) fit.refused = "not to be had";
  EXPECT_THROW(choose(report), Refusal);
}

}  // namespace
}  // namespace sinew::identify::least_squares_test
