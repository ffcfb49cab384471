// Sensor problems are found in a column: clipping, typing errors, no change.
#include "sinew/identify/data/quality.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sinew/identify/contest/refusal.h"

namespace sinew::identify::quality_test {
namespace {

bool says(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(Quality, ASensorAtItsEndRepeatsItselfAndNoiseDoesNot) {
  std::vector<double> noisy, clipped;
  unsigned state = 1;
  for (int i = 0; i < 500; ++i) {
    state = state * 1664525u + 1013904223u;
    noisy.push_back(i * 0.1 + static_cast<double>(state >> 16) / 65536.0);
    clipped.push_back(std::min(noisy.back(), 29.4));
  }
  EXPECT_FALSE(clipping(noisy).clipped);
  EXPECT_TRUE(clipping(clipped).clipped);
  EXPECT_GT(clipping(clipped).at_top, 150u);

  // Slack at exactly zero, and coarse steps with repeated values, are not clipping.
  std::vector<double> slack(noisy), steps;
  for (double& x : slack) x = std::max(x - 20, 0.0);
  for (int i = 0; i < 500; ++i) steps.push_back(i / 50);
  EXPECT_FALSE(clipping(slack).clipped);
  EXPECT_FALSE(clipping(steps).clipped);
}

TEST(Quality, AnOutlierIsOneAmongManyAndNoiseHasNone) {
  std::vector<double> r;
  unsigned state = 7;
  for (int i = 0; i < 200; ++i) {
    state = state * 1664525u + 1013904223u;
    r.push_back(static_cast<double>(state >> 16) / 65536.0 - 0.5);
  }
  EXPECT_TRUE(outliers(r, 0).empty());
  r[31] = 9;
  EXPECT_EQ(outliers(r, 0), (std::vector<std::size_t>{31}));
  EXPECT_TRUE(outliers(r, 10).empty());
  EXPECT_TRUE(outliers(std::vector<double>{0, 0, 0, 9}, 0).empty()) << "too few to tell";
}

TEST(Quality, ConstantsAreRefusedWithTheReason) {
  constexpr ColumnSpec wanted[] = {
      {.name = "pressure", .unit = "Pa gauge", .least = 1e3, .most = 2e6, .doc = "inside"},
      {.name = "force", .unit = "N", .least = 1, .most = 1e5, .doc = "it pulls with"}};
  const Measured m = parse_measured("pressure [kPa gauge],force [N]\n100,10\n100.1,20\n",
                                    {.path = "rig.csv"}, wanted);
  EXPECT_NO_THROW(refuse_constant(m, "force", 1, "", ""));
  try {
    refuse_constant(m, "pressure", 5e3, "pressures that differ", "another");
    FAIL();
  } catch (const Refusal& e) {
    EXPECT_TRUE(says(e.what(), "rig.csv: pressure: found 100 kPa gauge throughout")) << e.what();
  }
}

}  // namespace
}  // namespace sinew::identify::quality_test
