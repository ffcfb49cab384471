#include "sinew/identify/contest/contest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "sinew/identify/contest/bounds.h"

namespace sinew::identify::contest_test {
namespace {

// Returns a law of powers of x up to `degree`.
Candidate polynomial(const std::vector<double>& x, int degree) {
  Candidate out{.model = "degree " + std::to_string(degree)};
  for (int k = 0; k <= degree; ++k)
    out.parameters.push_back({.name = std::string(1, static_cast<char>('a' + k)), .unit = "1"});
  out.predict = [x](std::span<const double> p, std::span<double> y) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      y[i] = 0;
      for (std::size_t k = p.size(); k-- > 0;) y[i] = y[i] * x[i] + p[k];
    }
    return true;
  };
  return out;
}

struct Line {
  std::vector<double> x, y;
};

// 1 + 2 x with noise of 0.05.
Line line(int rows) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.05);
  Line out;
  for (int i = 0; i < rows; ++i) {
    out.x.push_back(0.1 * i);
    out.y.push_back(1 + 2 * out.x.back() + noise(random));
  }
  return out;
}

Report report_of(const Line& data) {
  return {.full_scale = 1, .rows = {.x = "x", .x_unit = "1", .at = data.x, .measured = data.y}};
}

// Leave-one-out has a closed form: the residual over 1 - leverage, which is 1 - 1/n for a mean.
TEST(Contest, LeavesEachRowOutOnce) {
  const Line data = line(10);
  Report report = report_of(data);
  fit_candidates({polynomial(data.x, 0)}, {.measured = data.y, .splits = each_row_held_out(10)},
                 report);
  const Fit& fit = report.fits[0];
  EXPECT_NEAR(fit.held_out->rmse, fit.fit.rmse / (1 - 0.1), 1e-7);
  EXPECT_FALSE(fit.cross_validated.has_value());
  EXPECT_FALSE(fit.band.has_value());  // ten rows give no 95 % band
}

TEST(Contest, TheSimplestLawThatPredictsIsChosenAndPinned) {
  const Line data = line(60);
  Report report = report_of(data);
  Trial trial{.measured = data.y, .splits = each_row_held_out(60)};
  trial.cross_validates = true;
  fit_candidates({polynomial(data.x, 0), polynomial(data.x, 1), polynomial(data.x, 2)}, trial,
                 report);
  conclude(report);
  EXPECT_EQ(report.best().model, "degree 1");
  EXPECT_TRUE(not_pinned(report).empty());
  EXPECT_NEAR(report.best().band->half_68, 0.05, 0.02);
  const std::vector<std::string> not_shown = does_not_show(report);
  ASSERT_EQ(not_shown.size(), 3u);
  EXPECT_EQ(not_shown[0],
            "whether degree 1 is the true law, as degree 2 misses at most a tenth more");
  EXPECT_EQ(not_shown[1], "what happens outside the x that was measured, 0 to 5.9");
}

// Rows that are not fitted are predicted too, and a split that leaves out no fitted row uses the
// whole fit.
TEST(Contest, ScoresRowsOfItsOwnThatNoFitSees) {
  const Line data = line(20);
  Trial trial{.measured = data.y};
  Split split;
  for (std::size_t i = 0; i < 20; ++i) (i < 12 ? split.fitted : split.held_out).push_back(i);
  trial.rows = split.fitted;
  trial.splits = {split};
  Report report = report_of(data);
  fit_candidates({polynomial(data.x, 1)}, trial, report);
  const Fit& fit = report.fits[0];
  EXPECT_EQ(fit.fit.points, 12u);
  EXPECT_EQ(fit.residuals.size(), 20u);
  double squares = 0;
  for (std::size_t i = 12; i < 20; ++i) squares += fit.residuals[i] * fit.residuals[i];
  EXPECT_DOUBLE_EQ(fit.held_out->rmse, std::sqrt(squares / 8));
}

TEST(Contest, RefusesAndFreezesWithAReason) {
  const Line data = line(12);
  Candidate known = polynomial(data.x, 1), bound = known, silent = known;
  known.refused = "it takes four pressures";
  bound.parameters[1].high = 1.5;
  silent.predict = [](std::span<const double>, std::span<double>) { return false; };
  Report report = report_of(data);
  fit_candidates({known, bound, silent}, {.measured = data.y}, report);
  EXPECT_EQ(report.fits[0].refused, "it takes four pressures");
  EXPECT_EQ(report.fits[1].not_chosen, "b at the bound of its range");
  EXPECT_NE(report.fits[2].refused.find("no value at its start values"), std::string::npos);
  conclude(report);
  EXPECT_EQ(not_pinned(report), std::vector<std::string>{"b"});
  const std::vector<std::string> not_shown = does_not_show(report);
  EXPECT_EQ(not_shown[1],
            "how large errors are where nothing was measured, as no row was left out");
}

// The slope is 2. A guessed bound of 1.5 is widened, and the fit is that without bounds. At 0.5 the
// wider bound of 1 is too small as well: the slope is frozen there, and the law takes part with one
// parameter less. A bound towards zero stays.
TEST(Contest, WidensAGuessedBoundOnceAndThenFreezesTheParameter) {
  const Line data = line(12);
  const auto with_slope = [&](double low, double high) {
    Candidate out = polynomial(data.x, 1);
    out.parameters[1] = {
        .name = "b", .unit = "1", .start = low, .low = low, .high = high, .may_widen = true};
    return out;
  };
  Report report = report_of(data);
  Trial trial{.measured = data.y, .splits = each_row_held_out(12)};
  trial.cross_validates = true;
  fit_candidates({polynomial(data.x, 1), with_slope(0, 1.5), with_slope(0, 0.5), with_slope(3, 4)},
                 trial, report);
  const auto slope = [&](std::size_t k) { return report.fits[k].parameters[1]; };
  EXPECT_NEAR(slope(1).value, slope(0).value, 1e-6);
  EXPECT_TRUE(slope(1).free);
  EXPECT_EQ(slope(2).value, 1);
  EXPECT_FALSE(slope(2).free);
  EXPECT_EQ(slope(2).known, "frozen at its bound");
  EXPECT_TRUE(slope(2).at_bound);
  EXPECT_EQ(report.fits[2].not_chosen, "");
  EXPECT_GT(report.fits[2].cross_validated->rmse, report.fits[1].cross_validated->rmse);
  EXPECT_EQ(report.fits[3].not_chosen, "b at the bound of its range");
  conclude(report);
  EXPECT_LT(report.chosen, 2u);
}

// A parameter with a prior keeps the prior: its bound stays.
TEST(Contest, WidensNoBoundOfAParameterWithAPrior) {
  const Line data = line(12);
  Candidate known = polynomial(data.x, 1);
  known.parameters[1] = {.name = "b", .unit = "1", .start = 0.4, .high = 0.5, .may_widen = true};
  known.constraints = Constraints({.prior = {"b=0.4 ± 10"}});
  Report report = report_of(data);
  fit_candidates({known}, {.measured = data.y}, report);
  const Estimate& slope = report.fits[0].parameters[1];
  EXPECT_NEAR(slope.value, 0.5, 1e-9);
  EXPECT_TRUE(slope.at_bound);
  EXPECT_TRUE(slope.free);
  EXPECT_TRUE(slope.known.starts_with("prior 0.4 +- 10")) << slope.known;
}

// Each bound is widened once by itself, in whatever order the parameters come to theirs.
TEST(Contest, WidensEachBoundOnce) {
  const Line data = line(12);
  Candidate both = polynomial(data.x, 1);
  both.parameters[0] = {.name = "a", .unit = "1", .high = 0.7, .may_widen = true};
  both.parameters[1] = {.name = "b", .unit = "1", .high = 1.5, .may_widen = true};
  Report report = report_of(data);
  fit_candidates({polynomial(data.x, 1), both}, {.measured = data.y}, report);
  for (const std::size_t i : {0u, 1u}) {
    const Estimate &free = report.fits[0].parameters[i], &found = report.fits[1].parameters[i];
    EXPECT_NEAR(found.value, free.value, 1e-6) << i;
    EXPECT_TRUE(found.free) << i;
  }
}

// `b` is pushed to 10, `a` steps to 1 where b is above 0.6, and `c` follows a. When b has been
// frozen at 0.8 and a has been widened, c comes to its bound of 0.7, which is widened in its turn.
TEST(Contest, WidensABoundThatIsReachedAfterAnotherParameterWasFrozen) {
  FitProblem chain{.count = 4};
  chain.residuals = [](std::span<const double> p, std::span<double> r) {
    r[0] = p[0] - 10, r[1] = p[1] - 1 / (1 + std::exp(50 * (0.6 - p[0]))), r[2] = p[2] - p[1],
    r[3] = 0;
    return true;
  };
  for (const auto& [name, high] : {std::pair("b", 0.4), std::pair("a", 0.6), std::pair("c", 0.7)})
    chain.parameters.push_back({.name = name, .unit = "1", .high = high, .may_widen = true});
  const Solution found = least_squares_within(chain);
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_NEAR(found.values[i], i == 0 ? 0.8 : 1, 1e-3) << i;
    EXPECT_EQ(found.estimates[i].free, i > 0) << i;
    EXPECT_EQ(found.estimates[i].at_bound, i == 0) << i;
  }
  EXPECT_EQ(found.estimates[0].known, "frozen at its bound");
  EXPECT_EQ(chain.parameters[2].high, 1.4);
}

TEST(Contest, WarnsOfASearchThatHasNotSettled) {
  const Line data = line(12);
  Candidate hasty = polynomial(data.x, 1);
  hasty.options.most_steps = 0;
  Report report = report_of(data);
  fit_candidates({hasty}, {.measured = data.y}, report);
  conclude(report);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("before it had settled"), std::string::npos);
}

}  // namespace
}  // namespace sinew::identify::contest_test
