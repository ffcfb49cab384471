// Duties and predict.dat: delays from delivered duties, and tables that compensate them.
#include <algorithm>
#include <random>

#include "sinew/config/valve_timing.h"
#include "sinew/gas/delay.h"
#include "sinew/gas/pulse.h"
#include "sinew/identify/valve/edges.h"
#include "sinew/identify/valve/fixtures_test.h"
#include "sinew/identify/valve/timing.h"

namespace sinew::identify::duty_test {
namespace {

// --- duty ---

Measured duty_map(double opening, double closing, std::initializer_list<double> frequencies,
                  double noise, unsigned seed, bool flow, double from = 0, double to = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  Values duty, delivered, frequency;
  for (const double f : frequencies)
    for (int k = 0; k <= 50; ++k) {
      const double d = 0.02 * k;
      if (d < from - 1e-9 || d > to + 1e-9) continue;
      duty.push_back(d);
      frequency.push_back(f);
      const double open = gas::delivered_duty(d, 1 / f, opening, closing);
      delivered.push_back((open + (open > 0 && open < 1 ? normal(random) : 0)) * (flow ? 4e-4 : 1));
    }
  return table({{"duty", "1", duty},
                {flow ? "flow" : "delivered", flow ? "m3/s" : "1", delivered},
                {"frequency", "Hz", frequency}});
}

TEST(ValveDuty, BothDelaysComeBackWithinTheirBrackets) {
  for (const bool flow : {false, true}) {
    int covered = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> delay(1e-3, 5e-3);
      const double opening = delay(random), closing = delay(random);
      const ValveResult r =
          identify_duty(duty_map(opening, closing, {25, 50}, 2e-3, seed, flow), ValveOptions());
      ASSERT_TRUE(r.opening_known && r.closing_known) << r.refused;
      const Estimate &o = parameter(r, "opening_delay"), &c = parameter(r, "closing_delay");
      covered += o.low <= opening && opening <= o.high && c.low <= closing && closing <= c.high;
      EXPECT_NEAR(r.valve.opening_delay, opening, 0.4e-3);
    }
    EXPECT_GE(covered, 180);
  }
}

// 3.4: 4 ms and 1 ms; 50 % becomes 42.5 % and 35 %.
TEST(ValveDuty, TheStraightPartAloneGivesTheDifferenceOnly) {
  const ValveResult r =
      identify_duty(duty_map(4e-3, 1e-3, {25, 50}, 1e-3, 1, false, 0.3, 0.8), ValveOptions());
  expect_says(r.refused, "the straight part of the map does not separate the delays");
  EXPECT_NEAR(parameter(r, "delay_difference").value, 3e-3, 0.05e-3);
}

TEST(ValveDuty, AMissingFrequencyAndAConstantDeliveryAreRefused) {
  Measured m = duty_map(4e-3, 1e-3, {25}, 0, 1, false);
  Measured without = m;
  without.columns.pop_back();
  expect_says(refusal_of([&] { identify_duty(without, ValveOptions()); }),
              "no frequency of the pulses");
  for (double& d : m.columns[1].values) d = 0.4;
  expect_says(refusal_of([&] { identify_duty(m, ValveOptions()); }),
              "the same delivery for all duties");
}

// --- predict.dat ---

// Applies the table's edges to a shutter with the delays, as the low level does: on at `open` of a
// period, off at `close` of the next.
double delivered_by(const config::ValveTiming& timing, unsigned duty, const gas::Valve& valve,
                    double period) {
  gas::Shutter shutter(valve);
  const double tick = period / 100;
  double open_time = 0, t = 0;
  const int periods = 12, from = 4;
  const auto advance = [&](double until) {
    while (t < until) {
      const double next = std::min(shutter.next(), until);
      const double counted = std::max(0.0, next - std::max(t, from * period));
      open_time += shutter.fraction(0.5 * (t + next)) * counted;
      t = next;
      shutter.advance(t);
    }
  };
  bool on = false;
  for (int k = 0; k < periods; ++k)
    for (int count = 1, opened = 0; count <= 100 && !opened; ++count) {
      const bool close = on && count >= timing.closing[duty];
      const bool opens = !on && count >= timing.opening[duty];
      if (!close && !opens) continue;
      opened = opens;  // stays so until the next period
      advance(k * period + count * tick);
      on = opens;
      shutter.electrical(k * period + count * tick, on);
    }
  advance(periods * period);
  return open_time / ((periods - from) * period);
}

TEST(ValveTiming, ACompensatedTableDeliversTheDutyThroughTheDelays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> delay(0, 2e-3);
  for (int trial = 0; trial < 30; ++trial) {
    gas::Valve valve;
    valve.opening_delay = delay(random);
    valve.closing_delay = delay(random);
    const CompensatedTiming c = compensated(valve.opening_delay, valve.closing_delay, 100);
    const config::ValveTiming read =
        config::parse_valve_timing(predict_dat(c.timing), "predict.dat");
    for (unsigned duty = 0; duty <= 100; ++duty) {
      const double real = delivered_by(read, duty, valve, 10e-3);
      EXPECT_NEAR(real, c.delivered[duty], 1e-3) << trial << " " << duty;
      // Between the shortest pulse and the shortest gap it is correct to half a tick.
      const double d = duty / 100.0, least = valve.closing_delay * 100 + 0.02;
      const double most = 1 - valve.opening_delay * 100 - 0.02;
      if (d > least && d < most) {
        EXPECT_NEAR(real, d, 0.0101) << trial << " " << duty;
      }
    }
  }
}

TEST(ValveTiming, WithoutDelaysItIsTheIdentity) {
  const signals::ValveTiming t = compensated(0, 0, 100).timing,
                             identity = signals::identity_timing();
  EXPECT_EQ(t.closing, identity.closing);
  EXPECT_EQ(t.opening, identity.opening);
  EXPECT_TRUE(signals::closes_at_zero(compensated(2e-3, 1e-3, 100).timing));
}

}  // namespace
}  // namespace sinew::identify::duty_test
