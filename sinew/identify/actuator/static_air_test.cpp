// Volume of the air in a muscle identified from its force.
#include "sinew/identify/actuator/static_air.h"

#include <gtest/gtest.h>

#include "sinew/actuator/body.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static.h"
#include "sinew/identify/actuator/test_muscle.h"

namespace sinew::identify::static_air_test {
namespace {

constexpr double rest = test_rest_length, bar = 1e5;

StaticData measured(const StaticSetting& s) {
  StaticData out;
  for (const double contraction : {0.0, 0.02, 0.05, 0.08, 0.12, 0.16})
    for (double p = 0.5 * bar; p <= 6.5 * bar; p += 1 * bar) {
      StaticPoint point{.length = rest * (1 - contraction), .pressure = p, .rest_length = rest};
      point.force = predicted(s, {.rest_length = rest}, point);
      out.points.push_back(point);
    }
  return out;
}

// A muscle that loses a tenth to a quarter of its ideal tension: its air is that of its geometry,
// at rest and at other lengths, and its force is that of the fit without the diameter.
TEST(StaticAir, TheDiameterGivesTheVolumeOfAMuscleWithLosses) {
  for (const double effectiveness : {0.9, 0.75}) {
    StaticSetting truth = test_muscle();
    truth.actuator.effectiveness.c0 = effectiveness;
    const actuator::Actuator& muscle = truth.actuator;
    const double diameter = actuator::diameter(muscle.braid, rest);
    const StaticData data = measured(truth);
    const StaticResult before = identify_static(data, {.model = "saturating-elastic"});
    const StaticResult found =
        identify_static(data, {.diameter = diameter, .model = "saturating-elastic"});
    const actuator::Actuator &a = found.muscles[0].actuator, &b = before.muscles[0].actuator;
    EXPECT_NEAR(actuator::volume(a, rest), cylinder_volume(rest, diameter), 1e-12);
    EXPECT_LT(actuator::volume(b, rest), 0.95 * actuator::volume(muscle, rest));
    for (double l = 0.84 * rest; l <= rest; l += 0.02 * rest) {
      EXPECT_NEAR(actuator::volume(a, l) / actuator::volume(muscle, l), 1, 0.03) << l;
      EXPECT_NEAR(actuator::volume_slope(a, l) / actuator::volume_slope(muscle, l), 1, 0.05) << l;
      EXPECT_NEAR(actuator::tension(a, l, 0, 4 * bar, 101325),
                  actuator::tension(b, l, 0, 4 * bar, 101325), 1e-9);
    }
    EXPECT_TRUE(found.air.known);
    EXPECT_TRUE(found.report.warnings.empty());
    ASSERT_EQ(before.report.warnings.size(), 1u);
    EXPECT_NE(before.report.warnings[0].find("by the force alone"), std::string::npos);
    EXPECT_LT(before.air.low, actuator::volume(muscle, rest));
    EXPECT_GT(before.air.high, actuator::volume(muscle, rest));
    const std::string file = static_file(found, found.muscles[0], "m", "a test", "");
    EXPECT_NE(file.find("with the volume of air at rest"), file.npos) << file;
  }
}

// A thick wall leaves less air than the braid contains, but does not affect changes of volume. A
// measured volume replaces the cylinder's.
TEST(StaticAir, AThickWallIsAirThatIsNotThere) {
  const StaticData data = measured(test_muscle());
  const double braid = actuator::volume(test_muscle().actuator, rest);
  const StaticResult found = identify_static(
      data, {.volume = 0.5 * braid, .diameter = 0.03, .model = "saturating-elastic"});
  const actuator::Actuator& a = found.muscles[0].actuator;
  EXPECT_NEAR(actuator::volume(a, rest), 0.5 * braid, 1e-12);
  EXPECT_EQ(found.air.kappa, 1);
  for (double l = 0.84 * rest; l <= rest; l += 0.02 * rest)
    EXPECT_NEAR(actuator::volume_slope(a, l) / actuator::volume_slope(test_muscle().actuator, l), 1,
                0.02);
  // A muscle of twice the length has twice the air.
  EXPECT_NEAR(actuator::volume(scaled_actuator(a, rest, 2 * rest), 2 * rest), braid, 1e-10);
}

// A known braid keeps its turns.
TEST(StaticAir, AKnownBraidIsNotMadeWider) {
  StaticSetting truth = test_muscle();
  truth.actuator.effectiveness.c0 = 0.8;
  const StaticResult found = identify_static(
      measured(truth), {.braid = truth.actuator.braid, .model = "saturating-elastic"});
  EXPECT_EQ(found.muscles[0].actuator.braid.turns, truth.actuator.braid.turns);
  EXPECT_TRUE(found.report.warnings.empty());
}

}  // namespace
}  // namespace sinew::identify::static_air_test
