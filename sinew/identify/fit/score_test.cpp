#include "sinew/identify/fit/score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace sinew::identify {
namespace {

// Some residuals of rows at five lengths, in no order.
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

TEST(ErrorBy, PartsHaveEachRowOnce) {
  const SomeRows rows;
  const ErrorBy by = error_by("length", "m", rows.residuals, rows.part, rows.length, 100);
  ASSERT_EQ(by.parts.size(), 5u);
  std::size_t points = 0;
  for (const PartError& p : by.parts) points += p.score.points;
  EXPECT_EQ(points, rows.residuals.size());
}

// n rms^2 = sum over parts n_i rms_i^2, and the worst of all is the worst of a part.
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

}  // namespace
}  // namespace sinew::identify
