// The cut of a step: on the far side of the discontinuity, close to it, and found in few samples.
#include "sinew/world/kernel/cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace sinew::plant::cut_test {
namespace {

constexpr double within = 1e-11;

struct Found {
  double at = 0, last_beyond = 0;
  int calls = 0;
};

template <class Gap>
Found find(double h, Gap gap) {
  Found f{.last_beyond = h};
  f.at = cut(h, gap(0), gap(h), within, [&](double x) {
    ++f.calls;
    const double g = gap(x);
    if (g > 0) f.last_beyond = x;
    return g;
  });
  return f;
}

TEST(Cut, EndsJustBeyondTheBreak) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.001, 0.999), bend(-0.9, 0.9), size(-6, 6);
  int calls = 0;
  for (int i = 0; i < 2000; ++i) {
    const double h = 5e-4, root = share(random) * h, c = bend(random) / h;
    const double scale = std::pow(10, size(random));
    const auto gap = [&](double x) { return scale * (x - root) * (1 + c * (x - root)); };
    const Found f = find(h, gap);
    EXPECT_GT(f.at, root);
    EXPECT_LE(f.at, root + within);
    EXPECT_EQ(f.at, f.last_beyond);
    EXPECT_LE(f.calls, 13) << root << " " << c;
    calls += f.calls;
  }
  EXPECT_LE(calls, 6 * 2000);  // each is a piece of the step
}

// A load that just reversed begins with a gap of zero, and reverses again within the step.
TEST(Cut, LeavesAStartOnTheEdge) {
  const double h = 1e-3;
  for (const double root : {1e-7, 3e-4, 9.99e-4}) {
    const Found f = find(h, [&](double x) { return x * (x - root); });
    EXPECT_GT(f.at, root);
    EXPECT_LE(f.at, root + within);
  }
}

// Finds the first of two discontinuities; a step with a corner in it.
TEST(Cut, FindsWhicheverBreaksFirst) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.01, 0.99), size(-3, 3);
  for (int i = 0; i < 500; ++i) {
    const double h = 1e-3, a = share(random) * h, b = share(random) * h;
    const double slope = std::pow(10, size(random));
    const auto gap = [&](double x) { return std::fmax(x - a, slope * (x - b)); };
    const Found f = find(h, gap);
    EXPECT_GT(f.at, std::fmin(a, b));
    EXPECT_LE(f.at, std::fmin(a, b) + within);
  }
}

// A diverged state has NaN as its gap: the search ends, and at an instant of the step.
TEST(Cut, EndsWhereNothingIsANumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double at = cut(1e-3, -1.0, 1.0, within, [&](double) { return none; });
  EXPECT_GT(at, 0);
  EXPECT_LE(at, 1e-3);
}

}  // namespace
}  // namespace sinew::plant::cut_test
