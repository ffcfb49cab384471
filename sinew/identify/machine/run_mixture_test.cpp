// Intervals of normal distributions that are limited by boxes.
#include "sinew/identify/machine/run_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::identify::run_mixture_test {
namespace {

constexpr double width = 1.959963984540054;

// Returns the intervals of two parameters whose values are in the middle of the distribution.
std::vector<RunCell> middle(std::span<const RunPiece> pieces, double value = 0.5) {
  return middle_of_pieces(pieces, std::vector<double>{value, value}, width);
}

// Two parameters whose difference is determined to 0.01 and whose sum to 1.
RunPiece bound_pair(double low, double high, double cost = 0) {
  RunPiece out{.middle = {0, 0}, .spread = Matrix(2, 2), .cost = cost};
  out.spread(0, 0) = 0.01;
  out.spread(0, 1) = out.spread(1, 1) = 0.5;
  out.box = {{}, {low, high}};
  return out;
}

TEST(RunMixture, WithoutABoxItIsTheNormalDistribution) {
  const RunPiece piece = bound_pair(-unbounded, unbounded);
  const std::vector<RunCell> all = middle({&piece, 1});
  EXPECT_NEAR(all[1].high, width * 0.5, 1e-12);
  EXPECT_NEAR(all[0].low, -width * std::hypot(0.01, 0.5), 1e-12);
}

// The half above zero has the quantiles of |x|, and a correlated parameter follows.
TEST(RunMixture, ABoxCutsWhatIsBoundToTheNumberToo) {
  const RunPiece piece = bound_pair(0, unbounded);
  const std::vector<RunCell> all = middle({&piece, 1});
  for (const RunCell& one : all) {
    EXPECT_NEAR(one.low, 0.5 * 0.0313, 0.02);
    EXPECT_NEAR(one.high, 0.5 * 2.2414, 0.06);
  }
}

// A value at the end of its box is in its interval, which is no wider for that: 95 % of |x| from 0.
TEST(RunMixture, AValueAtTheEndOfItsBoxBelongsToTheInterval) {
  const RunPiece piece = bound_pair(0, unbounded);
  const RunCell cell = middle({&piece, 1}, 0)[1];
  EXPECT_NEAR(cell.low, 0, 1e-3);
  EXPECT_NEAR(cell.high, 0.5 * width, 0.05);
}

// Adjacent boxes of the same distribution are equivalent to one without the wall.
TEST(RunMixture, PiecesThatFitTogetherAreTheWhole) {
  const RunPiece pieces[] = {bound_pair(-unbounded, 0.2), bound_pair(0.2, unbounded)};
  const std::vector<RunCell> all = middle(pieces);
  EXPECT_NEAR(all[1].low, -width * 0.5, 0.05);
  EXPECT_NEAR(all[1].high, width * 0.5, 0.05);
}

TEST(RunMixture, APieceThatFitsBadlyHasNoWeight) {
  RunPiece far = bound_pair(10, 11, 20);
  far.middle = {10.5, 10.5};
  const RunPiece pieces[] = {bound_pair(-unbounded, 10), far};
  EXPECT_NEAR(middle(pieces)[1].high, width * 0.5, 0.05);
  RunPiece near = far;
  near.cost = 0;
  const RunPiece two[] = {bound_pair(-unbounded, 10), near};
  EXPECT_GT(middle(two)[1].high, 10);
}

// A box far out in the tail contains the parameters anyway.
TEST(RunMixture, ABoxInTheTailHoldsTheNumber) {
  const RunPiece piece = bound_pair(6, 7);
  const RunCell cell = middle({&piece, 1}, 6.05)[1];
  EXPECT_GE(cell.low, 6);
  EXPECT_LT(cell.high, 6.3);
}

}  // namespace
}  // namespace sinew::identify::run_mixture_test
