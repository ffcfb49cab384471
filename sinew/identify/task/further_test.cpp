// The benefit of further measurements equals that of a plan from the same points.
#include "sinew/identify/task/methods.h"

#include <gtest/gtest.h>

#include "sinew/identify/actuator/test_muscle.h"
#include "sinew/identify/plan/plan.h"

namespace sinew::identify::further_test {
namespace {

StaticResult three_mounts() {
  StaticData data;
  for (const double contraction : {0.02, 0.05, 0.1})
    for (int step = 1; step <= 8; ++step) {
      StaticPoint p{.length = test_rest_length * (1 - contraction),
                    .pressure = 0.75e5 * step,
                    .rest_length = test_rest_length};
      p.force = predicted(test_muscle(), {.rest_length = test_rest_length}, p);
      p.force += step % 2 ? 1 : -1;
      data.points.push_back(p);
    }
  return identify_static(data, {});
}

TEST(Further, ErrorsFallFromMountToMount) {
  const std::vector<Further> all = further_measurements(three_mounts(), units::atmosphere, {});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].readings, 24u);
  ASSERT_FALSE(all[0].mounts.empty());
  double before = all[0].rms;
  for (const FurtherMount& m : all[0].mounts) {
    EXPECT_LT(m.rms, before);
    before = m.rms;
  }
  EXPECT_GT(before, 1.0) << "the law's own error stays";
}

TEST(Further, FewPointsHaveNoPlanAndNoRefusal) {
  StaticResult few = three_mounts();
  few.points.resize(3);
  EXPECT_TRUE(further_measurements(few, units::atmosphere, {}).empty());
}

}  // namespace
}  // namespace sinew::identify::further_test
