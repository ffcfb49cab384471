// Points between bounds: their distribution, and their independence of the number of points.
#include "sinew/tune/sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "sinew/config/diagnostics.h"

namespace sinew::tune::sample_test {
namespace {

using Kind = Sample::Kind;

Sample sample(Kind kind, std::size_t ranges, std::size_t points, std::uint64_t seed = 1) {
  return {kind, std::vector<Range>(ranges, parse_range("k=0:1")), points, seed};
}

// Returns the number of points in each of `parts` equal parts of a range.
std::vector<int> counts(const std::vector<double>& u, std::size_t d, std::size_t range, int parts) {
  std::vector<int> out(static_cast<std::size_t>(parts));
  for (std::size_t i = range; i < u.size(); i += d) ++out[static_cast<std::size_t>(u[i] * parts)];
  return out;
}

class EachKind : public ::testing::TestWithParam<Kind> {};

TEST_P(EachKind, LiesInTheUnitCubeAndIsTheSameAgain) {
  for (const std::uint64_t seed : {0, 1, 7}) {
    const std::vector<double> u = shares(sample(GetParam(), 5, 300, seed));
    ASSERT_EQ(u.size(), 1500U);
    for (const double x : u) {
      EXPECT_GE(x, 0);
      EXPECT_LT(x, 1);
    }
    EXPECT_EQ(u, shares(sample(GetParam(), 5, 300, seed)));
    EXPECT_NE(u, shares(sample(GetParam(), 5, 300, seed + 1)));
  }
}

// Ranges are not correlated: the correlation of independent ones is 1/sqrt(n), here 0.022.
TEST_P(EachKind, RangesDoNotFollowEachOther) {
  const std::size_t d = 6, n = 2048;
  const std::vector<double> u = shares(sample(GetParam(), d, n));
  for (std::size_t a = 0; a < d; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += (u[i * d + a] - 0.5) * (u[i * d + b] - 0.5);
      EXPECT_LT(std::abs(12 * sum / static_cast<double>(n)), 4 * 0.022) << a << " " << b;
    }
}

INSTANTIATE_TEST_SUITE_P(Sample, EachKind,
                         ::testing::Values(Kind::random, Kind::latin, Kind::sobol));

TEST(Sample, FirstPointsStayWhenMoreAreRequested) {
  for (const Kind kind : {Kind::random, Kind::sobol}) {
    const std::vector<double> few = shares(sample(kind, 3, 100)),
                              more = shares(sample(kind, 3, 777));
    EXPECT_TRUE(std::equal(few.begin(), few.end(), more.begin()));
  }
}

// The property of a Latin hypercube: each of n parts of every range has a point.
TEST(Sample, LatinHasEachPartOnce) {
  for (const int n : {1, 2, 17, 500}) {
    const std::vector<double> u = shares(sample(Kind::latin, 4, static_cast<std::size_t>(n)));
    for (std::size_t range = 0; range < 4; ++range)
      EXPECT_EQ(counts(u, 4, range, n), std::vector<int>(static_cast<std::size_t>(n), 1));
  }
}

// The property of a digital net, which a shift of its digits preserves for every seed: each of 2^m
// parts of a range has one of 2^m points, and so has each box of 2^a by 2^(m-a) parts of the first
// two ranges.
TEST(Sample, SobolFillsRangesAndTheFirstTwoTogether) {
  constexpr int m = 8, n = 1 << m;
  for (const std::uint64_t seed : {0, 1, 12345}) {
    const std::size_t d = 40;
    const std::vector<double> u = shares(sample(Kind::sobol, d, n, seed));
    for (std::size_t range = 0; range < d; ++range)
      EXPECT_EQ(counts(u, d, range, n), std::vector<int>(n, 1)) << range;
    for (int a = 0; a <= m; ++a) {
      std::set<std::pair<int, int>> boxes;
      for (std::size_t i = 0; i < n; ++i)
        boxes.emplace(static_cast<int>(u[i * d] * (1 << a)),
                      static_cast<int>(u[i * d + 1] * (1 << (m - a))));
      EXPECT_EQ(boxes.size(), static_cast<std::size_t>(n)) << a;
    }
  }
}

// The mean of prod (1 + (u - 1/2)/2) is 1. For d = 6, independent points have an error of
// 0.36/sqrt(n).
TEST(Sample, SobolIntegratesCloserThanIndependentPoints) {
  const std::size_t d = 6, n = 1024;
  const auto error = [&](Kind kind, std::uint64_t seed) {
    const std::vector<double> u = shares(sample(kind, d, n, seed));
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double product = 1;
      for (std::size_t r = 0; r < d; ++r) product *= 1 + 0.5 * (u[i * d + r] - 0.5);
      sum += product;
    }
    return sum / static_cast<double>(n) - 1;
  };
  double random = 0, sobol = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    random += std::pow(error(Kind::random, seed), 2) / 20;
    sobol += std::pow(error(Kind::sobol, seed), 2) / 20;
  }
  EXPECT_NEAR(std::sqrt(random), 0.36 / 32, 0.5 * 0.36 / 32);
  EXPECT_LT(std::sqrt(sobol), 0.1 * std::sqrt(random));
}

TEST(Range, ScalesKeepTheirEnds) {
  const Range linear = parse_range("k = 2:6 mm"), log = parse_range("k=0.01:1 %/count log"),
              whole = parse_range("seed=1:4 whole");
  EXPECT_EQ(linear.at(0).text, "2 mm");
  EXPECT_EQ(linear.at(0.25).text, "3 mm");
  EXPECT_EQ(log.at(0).text, "0.01 %/count");
  EXPECT_EQ(log.at(0.5).text, "0.1 %/count");
  EXPECT_EQ(log.axis.heading(), "k [%/count]");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<int> seen(5);
  for (int i = 0; i < 4000; ++i) {
    const double u = any(random);
    ++seen[static_cast<std::size_t>(std::stoi(whole.at(u).text))];
  }
  // A quarter for each number: 1000 with a standard deviation of 27.
  for (int k = 1; k <= 4; ++k) EXPECT_NEAR(seen[static_cast<std::size_t>(k)], 1000, 5 * 27);
}

TEST(Range, ReportsWhatIsWrong) {
  const auto of = [](const char* text) -> std::string {
    try {
      parse_range(text);
    } catch (const config::Error& e) {
      return e.what();
    }
    return "";
  };
  using std::string;
  EXPECT_NE(of("k").find("expected KEY=from:to and the unit"), string::npos);
  EXPECT_NE(of("k=1,2 mm").find("expected KEY=from:to and the unit"), string::npos);
  EXPECT_NE(of("k=1:2:3 mm").find("expected KEY=from:to and the unit"), string::npos);
  for (const char* text : {"k=1:1 mm", "k=2:1 mm", "k=-1:-2 mm", "k=2:1 mm log", "k=4:1 whole"})
    EXPECT_NE(of(text).find("a low end below the high end"), string::npos) << text;
  EXPECT_NE(of("k=1 in:2 mm").find("one unit"), string::npos);
  EXPECT_NE(of("k=-1:2 mm log").find("ends above 0"), string::npos);
  EXPECT_NE(of("k=1:2.5 whole").find("whole ends"), string::npos);
}

// share_of() is the inverse of at().
TEST(Range, SharesComeBackFromTheirNumbers) {
  for (const char* text : {"a=2:5 m", "a=-5:2 m", "a=0.02:0.4 m log"}) {
    const Range range = parse_range(text);
    for (const double share : {0.0, 0.1, 0.5, 0.93})
      EXPECT_NEAR(range.share_of(*range.at(share).number), share, 1e-9) << text;
    EXPECT_LT(range.share_of(*range.at(-0.2).number), 0) << text;
    EXPECT_GT(range.share_of(*range.at(1.2).number), 1) << text;
  }
  const Range whole = parse_range("n=1:6 whole");
  for (double n = 1; n <= 6; ++n) EXPECT_EQ(*whole.at(whole.share_of(n)).number, n);
  EXPECT_TRUE(whole.share_of(0) < 0 || whole.share_of(0) > 1);
  EXPECT_TRUE(whole.share_of(7) < 0 || whole.share_of(7) > 1);
}

}  // namespace
}  // namespace sinew::tune::sample_test
