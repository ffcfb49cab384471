// Legs of other muscles and other sensors than the thesis's.
#include <gtest/gtest.h>

#include "runs.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::legs_test {
namespace {

using test::figure, test::seed, test::summary_of;
using units::degree, units::inch;

// The hamstring alone bends the knee and stretches the hip: slack, it leaves both hanging.
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

// --- 7.2: fewer sensors -------------------------------------------------------------------------

analysis::Summary walk_with(const std::string& source, int n) {
  return summary_of("walk-with-pressures", {"joint.hip.stiffness_source=\"" + source + "\"",
                                            "joint.knee.stiffness_source=\"" + source + "\"",
                                            "trolley.track_length=10 ft", seed(n)});
}

// Pressures have the same effect as forces, and are steadier; position alone walks and repeats its
// steps as well, but the stiffness is no longer the commanded one.
TEST(FewerSensors, PressuresReplaceForcesAndPositionAloneWalks) {
  for (int n = 1; n <= 3; ++n) {
    const analysis::Summary forces = walk_with("forces", n), pressures = walk_with("pressures", n),
                            none = walk_with("none", n);
    const char *distance = "trolley.distance_m", *repeat = "foot.step_repeat_true_rms_m",
               *stiffness = "joints.knee.stiffness_mean_true_Nm_per_rad";
    EXPECT_NEAR(figure(pressures, distance), figure(forces, distance),
                0.1 * figure(forces, distance));
    EXPECT_LT(figure(pressures, repeat), figure(forces, repeat));
    EXPECT_NEAR(figure(pressures, stiffness), figure(forces, stiffness),
                0.15 * figure(forces, stiffness));
    EXPECT_GT(figure(none, distance), figure(forces, distance));
    EXPECT_LT(figure(none, repeat), 2e-3);
    EXPECT_GT(figure(none, stiffness), 1.4 * figure(forces, stiffness));
  }
}

// One force per joint: the flexor's is sufficient, the extensor's carries the body and misleads.
TEST(FewerSensors, OneForceIsEnoughIfItIsTheFlexors) {
  EXPECT_GT(figure(walk_with("flexor force", 1), "trolley.distance_m") / inch, 53);
  EXPECT_LT(figure(walk_with("extensor force", 1), "trolley.distance_m") / inch, 2);
}

// The presence of the transducers of table C-1 changes only the noise, which depends on the places
// of the sensors.
TEST(FewerSensors, TransducersThatNoLawReadsChangeLittle) {
  const analysis::Summary plain = summary_of("walk-test-1"),
                          more = summary_of("walk-with-pressures",
                                            {"joint.hip.stiffness_source=forces",
                                             "joint.knee.stiffness_source=forces"});
  EXPECT_NEAR(figure(more, "trolley.distance_m") / inch, figure(plain, "trolley.distance_m") / inch,
              0.5);
}

// --- 7.3: dampers -------------------------------------------------------------------------------

std::vector<std::string> dampers(const std::string& size) {
  return {"joint.hip.damper=" + size, "joint.knee.damper=" + size};
}

TEST(Dampers, CalmTheHipAndTheSteps) {
  for (int n = 1; n <= 3; ++n) {
    std::vector<std::string> none = dampers("0 lbf in s/rad");
    none.push_back(seed(n));
    const analysis::Summary without = summary_of("damper", none),
                            with = summary_of("damper", {seed(n)});
    for (const char* key : {"joints.hip.swing_oscillation_rms_rad", "foot.step_repeat_true_rms_m"})
      EXPECT_LT(figure(with, key), 0.7 * figure(without, key)) << key;
    EXPECT_NEAR(figure(with, "trolley.distance_m"), figure(without, "trolley.distance_m"),
                0.15 * figure(without, "trolley.distance_m"));
  }
}

TEST(Dampers, CostQuickness) {
  double last = 0;
  for (const char* size :
       {"0 lbf in s/rad", "2 lbf in s/rad", "4 lbf in s/rad", "8 lbf in s/rad"}) {
    const double time = figure(summary_of("kick", dampers(size)), "foot.extension_time_to_peak_s");
    EXPECT_GT(time, last) << size;
    last = time;
  }
  EXPECT_GT(last, 0.3);
}

// A joint's law may use the speed of a sensor; the hip then shakes less, as with an estimate.
TEST(Spindles, DampTheHipOfTest2) {
  const auto shakes = [](const char* gain) {
    const std::string robot = sinew::test::source_dir() + "/robots/leg-with-spindles/robot.toml",
                      velocity = std::string("joint.hip.velocity_gain=") + gain;
    return figure(summary_of("walk-test-2", {"robot=" + robot, velocity}),
                  "joints.hip.swing_oscillation_rms_rad");
  };
  EXPECT_LT(shakes("0.008 % s/count"), 0.9 * shakes("0 % s/count"));
}

}  // namespace
}  // namespace sinew::legs_test
