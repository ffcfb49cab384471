#include "sinew/analysis/align/divergence.h"

#include <gtest/gtest.h>

#include "sinew/analysis/align/test_motion.h"

namespace sinew::analysis::parting_test {
namespace {

// The simulation leaves the measured motion at `t0` by a ramp of `slope`.
signals::Table leaving(double t0, double slope) {
  signals::Table out;
  test::add_channel(out, "/joint/elbow/angle", "rad", {}, 0,
                    [=](double t) { return test::motion(t) + (t > t0 ? slope * (t - t0) : 0); });
  return out;
}

TEST(Divergence, IsWhereTheDifferenceLeavesTheBandForGood) {
  const signals::Table measured = leaving(0, 0), simulated = leaving(12, 0.05);
  const Divergence p = divergences(measured, simulated, 0.05).at(0);
  const double range =
      spread_of(signal_of("", {&measured.series[0].time_ns, &measured.series[0].columns[0]})).range;
  EXPECT_NEAR(p.band, 0.05 * range, 1e-3 * range);
  ASSERT_TRUE(p.at);
  EXPECT_NEAR(*p.at, 12 + p.band / 0.05, 0.011);
  EXPECT_EQ(p.growth[2], 0);
  for (std::size_t k = 4; k + 1 < p.growth.size(); ++k) EXPECT_LT(p.growth[k], p.growth[k + 1]);
}

TEST(Divergence, OneStraySampleIsNone) {
  const signals::Table measured = leaving(0, 0);
  signals::Table simulated = measured;
  simulated.series[0].columns[0].set(700, 99);
  EXPECT_FALSE(divergences(measured, simulated, 0.05).at(0).at);
}

TEST(Divergence, NoiseAloneIsNone) {
  signals::Table measured, simulated = leaving(0, 0);
  test::add_channel(measured, "/joint/elbow/angle", "rad", {}, 0.1, test::motion);
  EXPECT_FALSE(divergences(measured, simulated, 0.01).at(0).at);
}

TEST(Divergence, CommandsAndPlansAreNoMotion) {
  for (const char* topic : {"/valve/a/inlet/open", "/muscle/a/inlet_duty", "/desired/joint/a/angle",
                            "/true/joint/a/angle", "/plan/phase", "/leg/left/valve/a/inlet/open"})
    EXPECT_FALSE(is_of_motion(topic)) << topic;
  for (const char* topic : {"/joint/a/angle", "/sensor/a/count", "/leg/left/muscle/a/tension"})
    EXPECT_TRUE(is_of_motion(topic)) << topic;
}

}  // namespace
}  // namespace sinew::analysis::parting_test
