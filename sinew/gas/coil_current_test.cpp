// Coil current: it satisfies the circuit, and the shutter's motion is visible in it.
#include "sinew/gas/coil_current.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sinew::gas::coil_current_test {
namespace {

Valve any_valve(std::mt19937& random) {
  std::uniform_real_distribution<double> size(0.5, 1.5);
  Valve v{.opening_delay = 0.5e-3 * size(random), .closing_delay = 0.5e-3};
  v.drive = random() % 2 ? Valve::Drive::speed_up : Valve::Drive::standard;
  v.speed_up = {.opening = 0.4e-3 * size(random), .closing = 0.4e-3};
  v.coil.boost_time = 1e-3 * size(random);
  v.opening_delay_slope = 1e-9 * size(random);
  v.circuit = {.resistance = 12 * size(random),
               .inductance = 6e-3 * size(random),
               .hold_voltage = 5 * size(random),
               .boost_voltage = 24 * size(random),
               .release_voltage = 3 * size(random),
               .motion_voltage = 20 * size(random),
               .motion_time = 0.15e-3 * size(random)};
  return v;
}

// Voltage of the coil at t, implemented independently.
double voltage(const Valve& v, double dp, double period, double duty, double t) {
  const double since = t - period * std::floor(t / period);
  if (since >= duty * period) return -v.circuit.release_voltage;
  const bool boost = v.drive == Valve::Drive::speed_up && since < v.coil.boost_time;
  const double delay = delay_at(v, true, dp);
  const bool moves = since < delay && since >= delay - v.circuit.motion_time;
  return (boost ? v.circuit.boost_voltage : v.circuit.hold_voltage) -
         (moves ? v.circuit.motion_voltage : 0.0);
}

// The exact pieces against the circuit in steps of 20 ns.
TEST(CoilCurrent, ObeysTheCircuit) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> duties(0.05, 0.95), pressures(0, 6e5);
  for (int trial = 0; trial < 20; ++trial) {
    const Valve v = any_valve(random);
    const double period = 8e-3, duty = duties(random), dp = pressures(random), h = 2e-8;
    const auto pieces = coil_current(v, dp, period, duty, 2);
    double i = 0, worst = 0;
    for (int k = 0; k * h < 2 * period - h; ++k) {
      const double t = (k + 0.5) * h;
      const double u = voltage(v, dp, period, duty, t);
      const double half = i + 0.5 * h * (u - v.circuit.resistance * i) / v.circuit.inductance;
      i += h * (u - v.circuit.resistance * half) / v.circuit.inductance;
      if (u < 0 && t - period * std::floor(t / period) > duty * period && i < 0) i = 0;
      worst = std::max(worst, std::abs(current(pieces, (k + 1) * h) - i));
    }
    EXPECT_LT(worst, 2e-4) << trial;
  }
}

TEST(CoilCurrent, HasNoJumps) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const auto pieces = coil_current(any_valve(random), 2e5, 5e-3, 0.4, 3);
    for (std::size_t k = 1; k < pieces.size(); ++k)
      EXPECT_NEAR(pieces[k - 1].at(pieces[k].from), pieces[k].start, 1e-12);
  }
}

// A standard coil whose shutter is stuck: U/R (1 - exp(-t R/L)), and after the pulse zero at
// L/R ln(1 + i R/U_release).
TEST(CoilCurrent, StuckShutterIsAPlainCoil) {
  Valve v;
  v.circuit = {.resistance = 10, .inductance = 5e-3, .hold_voltage = 20, .release_voltage = 4};
  const auto pieces = coil_current(v, 0, 10e-3, 0.5, 1);
  for (const double t : {1e-4, 5e-4, 2e-3, 4.9e-3})
    EXPECT_NEAR(current(pieces, t), 2 * (1 - std::exp(-t / 0.5e-3)), 1e-12);
  const double peak = 2 * (1 - std::exp(-10.0));
  const double gone = 5e-3 + 0.5e-3 * std::log(1 + peak * 10 / 4);
  EXPECT_GT(current(pieces, gone - 1e-6), 0);
  EXPECT_EQ(current(pieces, gone + 1e-6), 0);
  EXPECT_EQ(current(pieces, 9.9e-3), 0);
}

// The current falls while the shutter moves and turns at the instant at which the valve is open:
// later with more pressure if the delay depends on it.
TEST(CoilCurrent, DipsWhenTheShutterOpens) {
  Valve v{.opening_delay = 0.5e-3, .opening_delay_slope = 1e-9};
  v.circuit = {.resistance = 12,
               .inductance = 6e-3,
               .hold_voltage = 24,
               .release_voltage = 3,
               .motion_voltage = 20,
               .motion_time = 0.15e-3};
  for (const double dp : {0.0, 2e5, 6e5}) {
    const auto pieces = coil_current(v, dp, 8e-3, 0.5, 1);
    const double open = 0.5e-3 + 1e-9 * dp;
    EXPECT_GT(current(pieces, open - 0.15e-3), current(pieces, open));
    EXPECT_GT(current(pieces, open + 0.15e-3), current(pieces, open));
    for (double t = 1e-5; t < open - 0.16e-3; t += 1e-5)
      EXPECT_GT(current(pieces, t + 1e-5), current(pieces, t));
  }
  v.circuit.motion_voltage = 0;
  const auto pieces = coil_current(v, 0, 8e-3, 0.5, 1);
  for (double t = 1e-5; t < 3.9e-3; t += 1e-5)
    EXPECT_GT(current(pieces, t + 1e-5), current(pieces, t));
}

// Energy: the source's work is heat, work on the shutter and energy of the field.
TEST(CoilCurrent, EnergyIsConserved) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Valve v = any_valve(random);
    const double period = 6e-3, duty = 0.5, h = 1e-7;
    const auto pieces = coil_current(v, 1e5, period, duty, 1);
    double given = 0, heat = 0;
    for (int k = 0; k < 30000; ++k) {
      const double i = current(pieces, (k + 0.5) * h);
      given += h * voltage(v, 1e5, period, duty, (k + 0.5) * h) * i;
      heat += h * v.circuit.resistance * i * i;
    }
    const double last = current(pieces, 3e-3);
    EXPECT_NEAR(given - heat, 0.5 * v.circuit.inductance * last * last, 1e-3 * given) << trial;
  }
}

}  // namespace
}  // namespace sinew::gas::coil_current_test
