// Energy of a coil, and the rest of a valve's electrical side: drives, delays that depend on the
// pressure, the maximum frequency; regulators and tanks.
#include "sinew/gas/coil_current.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/gas/delay.h"
#include "sinew/gas/heat.h"
#include "sinew/gas/supply.h"

namespace sinew::gas::coil_test {
namespace {

// 4.3: standard 2 and 5 ms, speed-up below 1 ms.
Valve matrix(Valve::Drive drive) {
  return {.opening_delay = 2e-3,
          .closing_delay = 5e-3,
          .drive = drive,
          .speed_up = {.opening = 0.5e-3, .closing = 0.5e-3},
          .coil = {.power = 1, .boost_power = 9, .boost_time = 1e-3}};
}

// Integrates the power microsecond by microsecond.
TEST(Coil, EnergyIsPowerSummedOverThePulses) {
  std::mt19937_64 random(1);
  for (const auto drive : {Valve::Drive::standard, Valve::Drive::speed_up}) {
    const Valve v = matrix(drive);
    double total = 0, exact = 0, on = 0;
    for (int i = 0; i < 50; ++i) {
      const int pulse = 1000 + static_cast<int>(random() % 5000u);
      for (int us = 0; us < pulse; ++us)
        total += 1e-6 * (drive == Valve::Drive::speed_up && us < 1000 ? 9.0 : 1.0);
      on += pulse * 1e-6;
      exact += coil_energy_of_pulse(v, pulse * 1e-6);
    }
    EXPECT_NEAR(exact, total, 1e-9);
    EXPECT_NEAR(coil_energy(v, on, 50), total, 1e-9);
  }
  // A pulse shorter than the boost: the sum over a run is too high by the part that was cut.
  const Valve v = matrix(Valve::Drive::speed_up);
  EXPECT_NEAR(coil_energy_of_pulse(v, 0.4e-3), 9 * 0.4e-3, 1e-15);
  EXPECT_NEAR(coil_energy(v, 0.4e-3, 1) - coil_energy_of_pulse(v, 0.4e-3), 8 * 0.6e-3, 1e-15);
}

TEST(Drive, DecidesWhichDelaysHold) {
  for (const auto drive : {Valve::Drive::standard, Valve::Drive::speed_up}) {
    Shutter shutter(matrix(drive));
    const bool fast = drive == Valve::Drive::speed_up;
    shutter.electrical(0, true);
    EXPECT_EQ(shutter.next(), fast ? 0.5e-3 : 2e-3);
    shutter.advance(2e-3);
    shutter.electrical(0.01, false);
    EXPECT_EQ(shutter.next(), 0.01 + (fast ? 0.5e-3 : 5e-3));
  }
  Valve ideal = matrix(Valve::Drive::speed_up);
  ideal.profile = Valve::Profile::ideal;
  EXPECT_EQ(delays(ideal).opening, 0);
}

// 4.3: the exhaust opens later and closes sooner the higher the pressure.
TEST(Delay, IsLinearInThePressureDifferenceAndNeverNegative) {
  Valve v = matrix(Valve::Drive::standard);
  v.opening_delay_slope = 1e-3 / 5e5;
  v.closing_delay_slope = -4e-3 / 5e5;
  EXPECT_NEAR(delay_at(v, true, 5e5), 3e-3, 1e-15);
  EXPECT_NEAR(delay_at(v, false, 5e5), 1e-3, 1e-15);
  EXPECT_EQ(delay_at(v, false, 9e5), 0);
  EXPECT_EQ(delay_at(v, true, 0), 2e-3);

  Shutter shutter(v);
  shutter.electrical(0.1, true, delay_at(v, true, 2.5e5));
  EXPECT_NEAR(shutter.next(), 0.1 + 2.5e-3, 1e-15);
}

struct Followed {
  int openings = 0;
  double shortest = 1;  // time open or shut [s]
};

Followed square_wave(const Valve& v, double frequency) {
  Shutter shutter(v);
  Followed out;
  double last = -1;
  const auto go = [&](double until) {
    while (shutter.next() < until) {
      const double t = shutter.next(), before = shutter.fraction(t);
      shutter.advance(t);
      if (shutter.fraction(t) == before) continue;
      if (shutter.fraction(t) == 1) ++out.openings;
      if (last >= 0) out.shortest = std::min(out.shortest, t - last);
      last = t;
    }
  };
  for (int i = 0; i < 200; ++i) {
    go(0.5 * i / frequency);
    shutter.electrical(0.5 * i / frequency, i % 2 == 0);
  }
  go(1e9);
  return out;
}

// 100 periods: all are delivered up to the limit, fewer above it; no stay is ever shorter.
TEST(MaxFrequency, IsTheFastestWaveThatTheShutterFollows) {
  const Valve v = {.opening_delay = 0.6e-3, .closing_delay = 0.4e-3, .max_frequency = 350};
  EXPECT_EQ(square_wave(v, 100).openings, 100);
  EXPECT_EQ(square_wave(v, 300).openings, 100);
  EXPECT_LT(square_wave(v, 500).openings, 60);
  for (double frequency : {50.0, 200.0, 340.0, 400.0, 500.0, 800.0})
    EXPECT_GE(square_wave(v, frequency).shortest, 0.5 / 350 - 1e-12) << frequency;

  Valve free = v;
  free.max_frequency = 0;
  EXPECT_EQ(square_wave(free, 500).openings, 100);
}

TEST(MaxFrequency, AShortPulseLastsHalfAPeriodOrNotAtAll) {
  const Valve v = {.opening_delay = 0.6e-3, .closing_delay = 0.4e-3, .max_frequency = 250};
  Shutter shutter(v);
  shutter.electrical(0, true);
  shutter.advance(0.6e-3);
  shutter.electrical(1e-3, false);
  EXPECT_NEAR(shutter.next(), 0.6e-3 + 2e-3, 1e-15);
  shutter.electrical(2e-3, true);  // before the change took effect
  EXPECT_EQ(shutter.next(), std::numeric_limits<double>::infinity());
}

// A change that is undone at its own instant does not count: the stay is measured from the one
// before.
TEST(MaxFrequency, AnUndoneChangeStartsNoStay) {
  const Valve v = {.opening_delay = 0.6e-3, .closing_delay = 0.4e-3, .max_frequency = 250};
  Shutter shutter(v);
  shutter.electrical(0, true);
  shutter.advance(0.6e-3);
  shutter.electrical(5e-3, false);
  shutter.advance(5.4e-3);
  shutter.electrical(5.4e-3, true);
  EXPECT_EQ(shutter.fraction(5.4e-3), 1);
  shutter.electrical(6e-3, false);
  EXPECT_NEAR(shutter.next(), 6.4e-3, 1e-15);
}

TEST(Regulator, OutletGoesExponentiallyToItsSetPoint) {
  const Regulator r{.range = 6e5, .time_constant = 0.05};
  const double set = set_point(r, 0.5, 1e5);
  EXPECT_EQ(set, 4e5);
  EXPECT_EQ(set_point(r, 1.7, 1e5), 7e5);
  EXPECT_EQ(set_point(r, -1, 1e5), 1e5);
  EXPECT_EQ(outlet_rate({.range = 6e5}, 1e5, set), 0);
  // exp solves it: p = set + (p_0 - set) exp(-t/tau)
  for (double t : {0.0, 0.02, 0.1}) {
    const double p = set - 3e5 * std::exp(-t / 0.05);
    EXPECT_NEAR(outlet_rate(r, p, set), 3e5 / 0.05 * std::exp(-t / 0.05), 1e-6);
  }
}

TEST(Tank, PressureIsProportionalToItsAir) {
  const Air air;
  const Supply tank{.kind = Supply::Kind::tank, .pressure = 5e5, .volume = 0.3785};  // 100 gallons
  for (double p : {1e5, 4e5, 8e5})
    EXPECT_NEAR(tank_pressure(tank, air, tank_mass(tank, air, p)), p, 1e-9);
  EXPECT_NEAR(tank_mass(tank, air, 1e5), 0.45, 0.01);  // 1.19 kg/m^3
  EXPECT_EQ(line_pressure(tank, 8e5), 5e5);
  EXPECT_EQ(line_pressure(tank, 3e5), 3e5);
}

TEST(Heat, EnergyAndTemperatureAreIdealGas) {
  const Air air{.wall_time = 0.2};
  const double mass = 1e-4, volume = 2e-5, u = energy_at_rest(air, mass);
  EXPECT_NEAR(temperature(air, u, mass), air.temperature, 1e-10);
  EXPECT_NEAR(pressure_of_energy(u, volume), mass * air.gas_constant * air.temperature / volume,
              1e-8);
  EXPECT_NEAR(heat_capacity_pressure(air) - heat_capacity_volume(air), air.gas_constant, 1e-10);
  EXPECT_EQ(heat_flow(air, u, mass), 0);
  EXPECT_NEAR(heat_flow(air, 1.1 * u, mass), -0.1 * u / 0.2, 1e-9);
}

}  // namespace
}  // namespace sinew::gas::coil_test
