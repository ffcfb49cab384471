#include "sinew/gas/pulse.h"

#include <gtest/gtest.h>

#include <limits>

namespace sinew::gas::pulse_test {
namespace {

constexpr double ms = 1e-3;  // [s]

// 3.4: 50 % becomes 42.5 % at 25 Hz and 35 % at 50 Hz.
TEST(Pulse, ThesisValve) {
  EXPECT_DOUBLE_EQ(delivered_duty(0.5, 40 * ms, 4 * ms, 1 * ms), 0.425);
  EXPECT_DOUBLE_EQ(delivered_duty(0.5, 20 * ms, 4 * ms, 1 * ms), 0.35);
}

// 0 up to the opening delay, 1 if the pause is too short to shut, D - 3 ms x f between.
TEST(Pulse, ThreeRegimes) {
  EXPECT_EQ(delivered_duty(0.09, 40 * ms, 4 * ms, 1 * ms), 0.0);
  EXPECT_EQ(delivered_duty(0.98, 40 * ms, 4 * ms, 1 * ms), 1.0);
  EXPECT_EQ(delivered_duty(1.0, 40 * ms, 4 * ms, 1 * ms), 1.0);
  EXPECT_EQ(delivered_duty(0.0, 40 * ms, 0.0, 1 * ms), 0.0);
  for (double d = 0.11; d < 0.97; d += 0.01)
    EXPECT_NEAR(delivered_duty(d, 40 * ms, 4 * ms, 1 * ms), d - 0.003 * 25, 1e-12);
}

// However a pulse of the delay is rounded, it opens and shuts nothing, as in a shutter.
TEST(Pulse, APulseOfExactlyTheDelayHasNoEffect) {
  for (const double frequency : {3.0, 25.0, 40.0, 70.0, 100.0 / 3}) {
    for (int tick = 1; tick < 100; ++tick) {
      const double delay = 0.1 * ms * tick, period = 1 / frequency, duty = delay * frequency;
      if (duty >= 0.5) continue;
      EXPECT_EQ(delivered_open_time(duty, period, delay, 1.5 * ms), 0) << frequency << ' ' << tick;
      EXPECT_EQ(delivered_open_time(1 - duty, period, 1 * ms, delay), period)
          << frequency << ' ' << tick;

      Valve valve;
      valve.profile = Valve::Profile::dead_time;
      valve.opening_delay = delay;
      Shutter shutter(valve);
      shutter.electrical(0, true);
      shutter.electrical(duty * period, false);
      EXPECT_EQ(shutter.next(), std::numeric_limits<double>::infinity());
    }
  }
}

TEST(Pulse, IdealValveDeliversTheDuty) {
  for (double d = 0; d <= 1; d += 0.125) EXPECT_DOUBLE_EQ(delivered_duty(d, 10 * ms, 0, 0), d);
}

}  // namespace
}  // namespace sinew::gas::pulse_test
