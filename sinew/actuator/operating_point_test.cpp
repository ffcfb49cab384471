// operating_point() has the results of the separate laws, and reports the model's limits.
#include "sinew/actuator/operating_point.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/body.h"
#include "sinew/actuator/loss.h"
#include "sinew/actuator/tension.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::operating_point_test {
namespace {

constexpr Surroundings around{thesis_atmosphere, 1.4, 1e-6};

TEST(OperatingPoint, DrawnOutItPullsWithItsLossesAndContractingWithoutThem) {
  std::mt19937_64 random(3);
  const Actuator a = thesis_actuator();
  std::uniform_real_distribution<double> length(0.065, 0.095), gauge(2e5, 7e5), speed(1e-3, 0.3);
  for (int i = 0; i < 500; ++i) {
    const double l = length(random), p = gauge(random), v = speed(random);
    const OperatingPoint out = operating_point(a, l, p, around, v);
    const OperatingPoint in = operating_point(a, l, p, around, -v);
    const OperatingPoint rest = operating_point(a, l, p, around);
    EXPECT_EQ(rest.tension, tension(a, l, 0.0, p, thesis_atmosphere));
    EXPECT_TRUE(std::isnan(rest.velocity) && std::isnan(rest.sliding_tension));

    // The viscous part changes its sign with the velocity; the dry part is the bound in either
    // direction.
    EXPECT_NEAR(out.viscous_loss, -in.viscous_loss, 1e-9 * out.viscous_loss);
    EXPECT_NEAR(out.sliding_tension, rest.tension + out.viscous_loss + rest.coulomb_bound,
                1e-9 * out.sliding_tension);
    EXPECT_NEAR(0.5 * (out.sliding_tension + in.sliding_tension), rest.tension,
                1e-9 * rest.tension);
    EXPECT_GT(rest.stiffness_sealed, rest.stiffness_at_constant_pressure);
  }
}

TEST(OperatingPoint, ReportsTheEndOfTheModelAndOnlyThere) {
  Actuator a = thesis_actuator();
  EXPECT_TRUE(operating_point(a, 0.085, 4e5, around).beyond.empty());
  EXPECT_EQ(operating_point(a, 0.99 * shortest_length(a), 4e5, around).beyond.size(), 1u);
  EXPECT_EQ(operating_point(a, a.long_end.length + 1e-4, 4e5, around).beyond.size(), 1u);
  // Beyond its thread's length the braid has no angle.
  const OperatingPoint torn = operating_point(a, a.braid.thread_length + 1e-4, 4e5, around);
  EXPECT_EQ(torn.beyond.size(), 2u);
  a.effectiveness.valid_to = 3e5;
  EXPECT_EQ(operating_point(a, 0.085, 4e5, around).beyond.size(), 1u);
}

}  // namespace
}  // namespace sinew::actuator::operating_point_test
