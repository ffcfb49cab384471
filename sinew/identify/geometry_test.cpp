// A braid's lengths and diameters give back its thread and turns.
#include "sinew/identify/geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/actuator/braid.h"
#include "sinew/identify/refusal.h"

namespace sinew::identify {
namespace {

constexpr actuator::Braid truth{.thread_length = 0.1071372, .turns = 2.3125};

Measured pairs(unsigned seed, double noise, int count, double thickness = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  Measured m{.file = "mesh.csv", .columns = {{"length", "m", {}}, {"diameter", "m", {}}}};
  for (int i = 0; i < count; ++i) {
    const double length = 0.065 + 0.03 * i / (count - 1);
    m.columns[0].values.push_back(length);
    m.columns[1].values.push_back(diameter(truth, length) + thickness + normal(random));
    m.lines.push_back(i + 2);
  }
  return m;
}

TEST(Geometry, without_noise_the_braid_comes_back) {
  for (const double thickness : {0.0, 4e-4}) {
    const GeometryResult g = identify_geometry(pairs(1, 0, 5, thickness), thickness);
    EXPECT_NEAR(g.braid.thread_length, truth.thread_length, 1e-9);
    EXPECT_NEAR(g.braid.turns, truth.turns, 1e-7);
  }
}

TEST(Geometry, intervals_cover_the_truth) {
  int covered = 0;
  double bias = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const GeometryResult g = identify_geometry(pairs(seed, 5e-5, 10));
    const Estimate& turns = g.report.best().parameters[1];
    covered += turns.low <= truth.turns && truth.turns <= turns.high;
    bias += (turns.value / truth.turns - 1) / 200;
  }
  EXPECT_GE(covered, 180);
  EXPECT_LE(covered, 198);
  EXPECT_LT(std::abs(bias), 0.01);
}

TEST(Geometry, one_length_and_swapped_columns_are_refused) {
  Measured one = pairs(1, 0, 5);
  for (double& x : one.columns[0].values) x = 0.08;
  EXPECT_THROW(identify_geometry(one), Refusal);

  Measured rising = pairs(1, 0, 5);
  std::reverse(rising.columns[1].values.begin(), rising.columns[1].values.end());
  EXPECT_THROW(identify_geometry(rising), Refusal);
}

}  // namespace
}  // namespace sinew::identify
