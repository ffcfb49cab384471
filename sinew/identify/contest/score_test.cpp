#include "sinew/identify/contest/score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sinew::identify::score_test {
namespace {

// Residuals of rows at five lengths, in random order.
struct SomeRows {
  std::vector<double> residuals, length;
  std::vector<int> part;

  SomeRows() {
    std::mt19937 random(7);
    for (int i = 0; i < 113; ++i) {
      part.push_back(static_cast<int>(random() % 5));
      length.push_back(0.2 + 0.01 * part.back());
      residuals.push_back(0.01 * static_cast<double>(random() % 1000) - 5);
    }
  }
};

// A further residual of the same kind is within the half-width with the stated probability; for few
// residuals it is the largest one.
TEST(HalfWidth, HoldsAFurtherResidualAsOftenAsItPromises) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0, 2);
  int in_68 = 0, in_95 = 0;
  constexpr int tries = 4000;
  for (int i = 0; i < tries; ++i) {
    std::vector<double> residuals;
    for (int k = 0; k < 39; ++k) residuals.push_back(normal(random));
    const double next = std::abs(normal(random));
    in_68 += next <= half_width_of(residuals, 0.68);
    in_95 += next <= half_width_of(residuals, 0.95);
  }
  EXPECT_NEAR(in_95, 0.95 * tries, 4 * std::sqrt(0.95 * 0.05 * tries));
  EXPECT_NEAR(in_68, 28.0 / 40 * tries, 4 * std::sqrt(0.68 * 0.32 * tries));  // 28 of 40 ranks
  EXPECT_EQ(half_width_of(std::vector<double>{-3, 1, 2}, 0.95), 3);
  EXPECT_EQ(half_width_of(std::vector<double>{-3}, 0.1), 3);
}

TEST(HalfWidth, ABandNeedsNineteenResiduals) {
  std::vector<double> residuals;
  for (int i = 1; i < 19; ++i) residuals.push_back(i);
  EXPECT_FALSE(band_of(residuals));
  residuals.push_back(-19);
  const auto band = band_of(residuals, "at rest");
  ASSERT_TRUE(band);
  EXPECT_EQ(band->half_95, 19);
  EXPECT_EQ(band->half_68, 14);  // ceil(0.68 * 20)
  EXPECT_EQ(band->where, "at rest");
}

TEST(ErrorBy, PartsHaveEachRowOnce) {
  const SomeRows rows;
  const ErrorBy by = error_by("length", "m", rows.residuals, rows.part, rows.length, 100);
  ASSERT_EQ(by.parts.size(), 5u);
  std::size_t points = 0;
  for (const PartError& p : by.parts) points += p.score.points;
  EXPECT_EQ(points, rows.residuals.size());
}

// n rms^2 = sum over parts n_i rms_i^2, and the maximum is that of a part.
TEST(ErrorBy, SquaresOfThePartsAddToThoseOfTheWhole) {
  const SomeRows rows;
  const Score whole = score(rows.residuals, 100);
  const ErrorBy by = error_by("length", "m", rows.residuals, rows.part, rows.length, 100);
  double squares = 0, worst = 0;
  for (const PartError& p : by.parts) {
    squares += static_cast<double>(p.score.points) * p.score.rmse * p.score.rmse;
    worst = std::max(worst, p.score.max);
  }
  EXPECT_NEAR(squares, static_cast<double>(whole.points) * whole.rmse * whole.rmse, 1e-9 * squares);
  EXPECT_EQ(worst, whole.max);
}

TEST(ErrorBy, APartIsWhereItsRowsAre) {
  const SomeRows rows;
  const ErrorBy by = error_by("length", "m", rows.residuals, rows.part, rows.length, 100);
  for (std::size_t i = 0; i < by.parts.size(); ++i)
    EXPECT_NEAR(by.parts[i].value, 0.2 + 0.01 * static_cast<double>(i), 1e-12);
}

TEST(ErrorBy, OfNoRowsThereIsNoPart) {
  EXPECT_TRUE(error_by("length", "m", {}, {}, {}, 100).parts.empty());
}

// A prediction 2 y + 1 for y = 0, 1, 2, 3 is perfectly correlated, with large errors.
TEST(Score, ComparesWithHowMuchTheMeasuredValuesVary) {
  const std::vector<double> measured{0, 1, 2, 3}, residuals{1, 2, 3, 4};
  const Score s = score(residuals, 3, measured);
  EXPECT_NEAR(s.rmse, std::sqrt(30.0 / 4), 1e-12);
  EXPECT_NEAR(s.nrmse, std::sqrt(30.0 / 4) / 3, 1e-12);
  EXPECT_NEAR(s.correlation, 1, 1e-12);
  EXPECT_NEAR(s.explained, 1 - 30.0 / 5, 1e-12);
  EXPECT_TRUE(std::isnan(score(residuals, 3, std::vector<double>(4, 2)).nrmse));
  EXPECT_TRUE(std::isnan(score(residuals, 3).correlation));
}

}  // namespace
}  // namespace sinew::identify::score_test
