// The timing tables, and the effect of a slow valve on a pulse.
#include <gtest/gtest.h>

#include "sinew/signals/pulse.h"
#include "sinew/signals/timing.h"

namespace sinew::signals::signals_test {
namespace {

TEST(Timing, IdentityIsThePrintedRule) {
  constexpr ValveTiming t = identity_timing();
  static_assert(t.closing[0] == 0 && t.opening[0] == 101);
  static_assert(t.closing[100] == 101 && t.opening[100] == 100);
  for (unsigned d = 1; d < 100; ++d) {
    ASSERT_EQ(t.closing[d], d);
    ASSERT_EQ(t.opening[d], 100);
  }
}

TEST(Timing, ShippedTablesShutAtZero) {
  static_assert(closes_at_zero(identity_timing()));
  static_assert(closes_at_zero(identity_timing(50), 50));
  static_assert(closes_at_zero(compensated_timing(5, 12)));
  EXPECT_EQ(compensated_timing(5, 12).closing[40], 28);
  EXPECT_EQ(compensated_timing(5, 12).opening[40], 95);
  EXPECT_EQ(compensated_timing(5, 12).closing[7], 0);
  EXPECT_EQ(compensated_timing(5, 12).closing[100], 101);
}

// 3.4: 50 % becomes 42.5 % at 25 Hz and 35 % at 50 Hz.
TEST(Pulse, ThesisValve) {
  EXPECT_DOUBLE_EQ(delivered_duty(0.5, 40.0, 4.0, 1.0), 0.425);
  EXPECT_DOUBLE_EQ(delivered_duty(0.5, 20.0, 4.0, 1.0), 0.35);
}

// 0 below the opening delay, 1 if the pause is too short to shut, D - 3 ms x f between.
TEST(Pulse, ThreeRegimes) {
  EXPECT_EQ(delivered_duty(0.09, 40.0, 4.0, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(delivered_open_time(0.1, 40.0, 4.0, 1.0), 1.0);
  EXPECT_EQ(delivered_duty(0.98, 40.0, 4.0, 1.0), 1.0);
  EXPECT_EQ(delivered_duty(1.0, 40.0, 4.0, 1.0), 1.0);
  EXPECT_EQ(delivered_duty(0.0, 40.0, 0.0, 1.0), 0.0);
  for (double d = 0.1; d < 0.97; d += 0.01)
    EXPECT_NEAR(delivered_duty(d, 40.0, 4.0, 1.0), d - 0.003 * 25, 1e-12);
}

TEST(Pulse, IdealValveDeliversTheDuty) {
  for (double d = 0; d <= 1; d += 0.125) EXPECT_DOUBLE_EQ(delivered_duty(d, 10.0, 0.0, 0.0), d);
}

}  // namespace
}  // namespace sinew::signals::signals_test
