// Legs of other muscles and other sensors than the thesis's.
#include <gtest/gtest.h>

#include "runs.h"
#include "sinew/units/constants.h"

namespace sinew {
namespace {

using test::figure, test::seed, test::summary_of;
constexpr double inch = units::inch, degree = 3.14159265358979312 / 180;

// The hamstring alone bends the knee and stretches the hip: slack, it leaves both where they hang.
TEST(ThreeMuscles, WalkBecauseOfTheHamstring) {
  for (int n = 1; n <= 3; ++n) {
    const analysis::Summary s = summary_of("three-muscles", {seed(n)});
    EXPECT_GT(figure(s, "trolley.distance_m") / inch, 34);
    EXPECT_LT(figure(s, "joints.hip.tracking_rms_rad") / degree, 9);
    EXPECT_LT(figure(s, "joints.knee.tracking_rms_rad") / degree, 9);
    const double bent =
        figure(s, "joints.knee.max_angle_true_rad") - figure(s, "joints.knee.min_angle_true_rad");
    EXPECT_GT(bent / degree, 20);
  }
  const analysis::Summary lame = summary_of("three-muscles", {"valve.inlet.flow.area=1e-12 m2"});
  EXPECT_LT(figure(lame, "trolley.distance_m") / inch, 1);
}

}  // namespace
}  // namespace sinew
