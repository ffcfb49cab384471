// The timing tables, and the effect of a slow valve on a pulse.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sinew::signals::signals_test
