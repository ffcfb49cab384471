// A muscle in an external loop has the results of the network, whatever the loop's steps.
#include "sinew/world/driven/driven_muscle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "sinew/air/test_machines.h"

namespace sinew::air::driven_muscle_test {
namespace {

double swinging(double t) { return (3.2 + 0.3 * std::sin(9 * t)) * inch; }

// Moves 0.4 s along an oscillation, with valves switched by a fixed pattern of tens of
// milliseconds.
DrivenMuscle after(const Muscle& m, double step) {
  DrivenMuscle driven(m, {.polytropic_exponent = 1.2}, {}, swinging(0));
  const int steps = static_cast<int>(std::lround(0.4 / step));
  const int per_command = static_cast<int>(std::lround(0.01 / step));
  for (int k = 0; k < steps; ++k) {
    if (k % per_command == 0) {
      const int at = k / per_command;
      driven.inlet(at % 5 == 0);
      driven.exhaust(at % 7 == 3);
    }
    driven.advance(step, swinging((k + 1) * step));
  }
  return driven;
}

TEST(DrivenMuscle, TheLoopsStepHardlyMatters) {
  for (const gas::Hose& hose : {gas::Hose{}, iso_hose(3e-9, 1e-6)}) {
    Muscle m = bundle(0);
    m.hose = hose;
    const DrivenMuscle fine = after(m, 2e-5), tenth = after(m, 1e-4), slow = after(m, 1e-3);
    EXPECT_GT(fine.account().in, 5e-5);
    EXPECT_NEAR(tenth.pressure() / fine.pressure(), 1, 2e-4);
    EXPECT_NEAR(slow.pressure() / fine.pressure(), 1, 1e-3);
    EXPECT_NEAR(slow.tension() / fine.tension(), 1, 3e-3);
  }
}

TEST(DrivenMuscle, AirIsNeitherMadeNorLost) {
  Muscle m = bundle(0.1);
  m.hose = iso_hose(3e-9, 2e-6);
  m.leak = {.area = 1e-8};
  const DrivenMuscle start(m, {.polytropic_exponent = 1.2}, {}, swinging(0));
  const DrivenMuscle driven = after(m, 1e-4);
  const Account a = driven.account();
  EXPECT_GT(a.leak, 0);
  EXPECT_NEAR(driven.air_mass(), start.air_mass() + a.in - a.out - a.leak, 1e-12 * a.in);
}

TEST(DrivenMuscle, GoesOnFromItsState) {
  Muscle m = bundle(0);
  m.hose = iso_hose(3e-9, 1e-6);
  DrivenMuscle one(m, {}, {}, swinging(0)), other(m, {}, {}, 0.07, 3e5);
  one.inlet(true);
  for (int k = 1; k <= 57; ++k) one.advance(1e-4, swinging(k * 1e-4));
  one.inlet(false);  // its edge is pending
  other.restore(one.state());
  for (int k = 58; k <= 300; ++k) {
    one.advance(1e-4, swinging(k * 1e-4));
    other.advance(1e-4, swinging(k * 1e-4));
    ASSERT_EQ(one.tension(), other.tension());
    ASSERT_EQ(one.pressure(), other.pressure());
  }
}

// The node at which the valve opens and the edge that shuts it differ by rounding only.
TEST(DrivenMuscle, APulseOfJustTheOpeningDelayPassesNoAir) {
  constexpr double tick = 1e-4;
  Muscle m = bundle(0);
  m.inlet.profile = gas::Valve::Profile::dead_time;
  m.inlet.opening_delay = 3 * tick;
  m.inlet.closing_delay = 2.6 * tick;
  DrivenMuscle driven(m, {}, {}, swinging(0));
  const auto pass = [&](int ticks) {
    for (int k = 0; k < ticks; ++k) driven.advance(tick, swinging(0));
  };
  for (int pulse = 0; pulse < 200; ++pulse) {
    driven.inlet(true);
    pass(3);
    driven.inlet(false);
    pass(20 + pulse % 7);
  }
  EXPECT_LT(driven.account().in, 1e-15);
  driven.inlet(true);
  pass(4);
  driven.inlet(false);
  pass(20);
  EXPECT_GT(driven.account().in, 1e-8);
}

// Choked air passes a ramp as if the valve were open for half its time. Muscles behind a hose with
// air, and those with a wide exhaust, are integrated ahead of the machine; the others with it.
TEST(DrivenMuscle, ChokedAirOfRampsIsThatOfTheirMeanShare) {
  constexpr int pulses = 20, on = 10, off = 20;
  struct Case {
    double hose, exhaust;  // volume [m^3], area [m^2]
  };
  for (const auto& [hose, exhaust] : {Case{0, 2e-6}, Case{2e-5, 2e-6}, Case{0, 5e-3}})
    for (const auto& [opening, closing] :
         {std::pair{1e-3, 0.0}, {1.5e-3, 0.0}, {0.0, 4e-3}, {2.3e-3, 3.1e-3}})
      for (const double step : {1e-3, 2e-4}) {
        Muscle m = bundle(0);
        m.external_volume = 5e-3;
        if (hose > 0) m.hose = iso_hose(1e-7, hose);
        m.inlet.profile = gas::Valve::Profile::ramp;
        m.inlet.opening_ramp = opening;
        m.inlet.closing_ramp = closing;
        m.inlet.opening_delay = m.inlet.closing_delay = 0;
        m.exhaust.flow.area = exhaust;
        const gas::Air air;
        const gas::Supply supply;
        DrivenMuscle driven(m, air, supply, swinging(0));
        for (int k = 0; k < pulses * (on + off); ++k) {
          driven.inlet(k % (on + off) < on);
          for (int part = 0; part < std::lround(1e-3 / step); ++part)
            driven.advance(step, swinging(0));
        }
        const double open = pulses * (1e-3 * on - 0.5 * opening + 0.5 * closing);
        const double flow = gas::mass_flow(m.inlet.flow, air, supply.pressure, air.atmosphere);
        EXPECT_NEAR(driven.account().in / (flow * open), 1, 1e-4)
            << hose << " " << exhaust << " " << opening << " " << closing << " " << step;
      }
}

// A chamber of constant volume with an open inlet, after a second: without heat to the walls the
// air that enters brings its enthalpy, so V (P_s - P_0)/(gamma R T) has entered, whatever the
// valve.
TEST(DrivenMuscle, WithoutHeatTheChamberTakesItsEnthalpy) {
  for (const double area : {5e-7, 4e-6, 3.2e-5})
    for (const double linear : {1e-3, 1e-5})
      for (const double step : {1e-3, 1e-4}) {
        Muscle m = bundle(0);
        m.inlet.flow.area = area;
        m.inlet.flow.linear_below = linear;
        const gas::Air air{.wall_time = 1e6};
        const gas::Supply supply;
        DrivenMuscle driven(m, air, supply, swinging(0));
        const double start = driven.air_mass(),
                     volume = start * air.gas_constant * air.temperature / air.atmosphere;
        driven.inlet(true);
        for (int k = 0; k < std::lround(1 / step); ++k) driven.advance(step, swinging(0));
        const double enters = volume * (supply.pressure - air.atmosphere) /
                              (gas::heat_capacity_ratio * air.gas_constant * air.temperature);
        EXPECT_NEAR(driven.account().in / enters, 1, 5e-4) << area << " " << linear << " " << step;
      }
}

// A tank that is smaller than the muscle behind a wide inlet reaches the common pressure with it;
// the muscle's pressure never exceeds that.
TEST(DrivenMuscle, SmallTanksComeToTheCommonPressure) {
  for (const double tank : {1e-4, 5e-6, 1e-6})
    for (const double area : {1e-6, 2e-5}) {
      Muscle m = bundle(0);
      m.inlet.flow.area = area;
      const gas::Air air{.polytropic_exponent = 1};
      gas::Supply supply;
      supply.kind = gas::Supply::Kind::tank;
      supply.volume = tank;
      supply.initial_pressure = supply.pressure;
      DrivenMuscle driven(m, air, supply, swinging(0));
      const double spring = air.gas_constant * air.temperature;
      const double muscle = driven.account().mass * spring / air.atmosphere;
      const double common = (supply.pressure * tank + air.atmosphere * muscle) / (tank + muscle);
      driven.inlet(true);
      double highest = 0;
      for (int k = 0; k < 500 && !driven.failed(); ++k) {
        driven.advance(1e-3, swinging(0));
        highest = std::max(highest, driven.pressure());
      }
      EXPECT_NEAR(driven.pressure() / common, 1, 3e-3) << tank << " " << area;
      EXPECT_LT(highest / common, 1 + 1e-3) << tank << " " << area;
    }
}

// A regulator's set point is reached and held.
TEST(DrivenMuscle, FollowsASetPoint) {
  Muscle m = bundle(0);
  m.inlet.kind = gas::Valve::Kind::regulator;
  m.inlet.regulator = {.range = 5 * bar, .time_constant = 0.01};
  m.inlet.flow.area = 5e-6;
  const gas::Air air;
  DrivenMuscle driven(m, air, {}, 3.2 * inch);
  driven.set_point(0.6);
  for (int k = 0; k < 5000; ++k) driven.advance(1e-4, 3.2 * inch);
  EXPECT_NEAR(driven.pressure(), air.atmosphere + 3 * bar, 1e-3 * bar);
  EXPECT_FALSE(driven.failed());
}

TEST(DrivenMuscle, WhatAValveIsNotIsRefusedAndNothingMoves) {
  using Kind = gas::Valve::Kind;
  for (const Kind kind : {Kind::two_way, Kind::three_way, Kind::regulator}) {
    Muscle m = bundle(0);
    m.inlet.kind = kind;
    if (kind == Kind::regulator) m.inlet.regulator = {.range = 5 * bar, .time_constant = 0.01};
    DrivenMuscle driven(m, {}, {}, 3.2 * inch);
    const auto is_refused = [&](auto&& command) {
      const DrivenMuscle::State before = driven.state();
      try {
        command();
      } catch (const std::invalid_argument&) {
        return std::memcmp(&before, &driven.state(), sizeof before) == 0;
      }
      return false;
    };
    EXPECT_EQ(is_refused([&] { driven.set_point(0.5); }), kind != Kind::regulator);
    EXPECT_EQ(is_refused([&] { driven.exhaust(true); }), kind != Kind::two_way);
    EXPECT_EQ(is_refused([&] { driven.inlet(true); }), kind == Kind::regulator);
  }
}

TEST(DrivenMuscle, NeedsRoomForAir) {
  Muscle m = bundle(0);
  m.external_volume = 0;
  EXPECT_THROW(DrivenMuscle(m, {}, {}, 1.2 * m.actuator.braid.thread_length),
               std::invalid_argument);
}

}  // namespace
}  // namespace sinew::air::driven_muscle_test
