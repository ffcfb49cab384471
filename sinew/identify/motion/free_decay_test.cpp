// Trajectory of a mass on trapped air: compared with chapter 3's numbers, closed forms and itself.
#include "sinew/identify/motion/free_decay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "sinew/actuator/loss.h"
#include "sinew/actuator/stiffness.h"
#include "sinew/actuator/thesis_actuator.h"
#include "sinew/identify/motion/decay.h"
#include "sinew/units/constants.h"
#include "tests/places.h"

namespace sinew::identify::free_decay_test {
namespace {

using units::inch;

Hanging trapped(double gauge_psi = 60, double pounds = 6) {
  Hanging h{.actuator = actuator::thesis_actuator()};
  h.mass = pounds * units::pound_mass;
  h.pressure = actuator::thesis_atmosphere + gauge_psi * units::psi;
  h.external_volume = 0.114 * inch * inch * inch;
  h.polytropic_exponent = 1.4;
  h.atmosphere = actuator::thesis_atmosphere;
  h.gravity = units::standard_gravity;
  return h;
}

std::vector<double> instants(double to, double step) {
  std::vector<double> out;
  for (int i = 0; i * step <= to; ++i) out.push_back(i * step);
  return out;
}

std::vector<double> lengths(const Hanging& h, double length, double velocity,
                            const std::vector<double>& times, int steps = 60) {
  std::vector<double> out(times.size());
  EXPECT_TRUE(free_decay(h, length, velocity, times, out, steps));
  return out;
}

TEST(FreeDecay, HasThePeaksAndPeriodsOfTheThreeTrappedAirTests) {
  const auto data = nlohmann::json::parse(
      std::ifstream(sinew::test::source_dir() + "/data/reference.json"))["verification_summary"];
  struct Case {
    const char* name;
    double psi, pounds;
  };
  for (const Case& c :
       {Case{"A 60psi 6lb", 60, 6}, {"B 80psi 11lb", 80, 11}, {"C 60psi 11lb", 60, 11}}) {
    const Hanging h = trapped(c.psi, c.pounds);
    const double rest = *rest_length(h);
    EXPECT_NEAR(rest / inch, data[c.name]["Leq_eq"].get<double>(), 1e-8) << c.name;
    const std::vector<double> t = instants(2, 1e-3);
    const Oscillation o = find_turns(t, lengths(h, rest + 0.2 * inch, 0, t), std::string(c.name));
    const auto& r = data[c.name]["equations"];
    EXPECT_NEAR(1e3 * o.period, r["Td_mean_ms"].get<double>(), 0.5) << c.name;
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(o.turns[2 * k].value / inch, r["peaks_in"][k].get<double>(), 1e-4) << c.name << k;
  }
}

TEST(FreeDecay, ConvergesInFourthOrderThroughFrictionThatChangesSides) {
  for (const auto scale : {actuator::Loss::Scale::secant, actuator::Loss::Scale::sealed}) {
    Hanging h = trapped();
    h.actuator.loss.coulomb_scale = scale;
    const double start = *rest_length(h) + 0.2 * inch;
    const std::vector<double> t = instants(1.2, 0.0037);
    const std::vector<double> exact = lengths(h, start, 0, t, 3200);
    const auto error = [&](int steps) {
      const std::vector<double> x = lengths(h, start, 0, t, steps);
      double most = 0;
      for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - exact[i]));
      return most;
    };
    EXPECT_LT(error(60), 1e-7);
    EXPECT_GT(error(50) / error(100), 12);
  }
}

// Small oscillations of a muscle without losses keep their amplitude and have sealed_frequency.
TEST(FreeDecay, WithoutLossesItSwingsForEverWithTheSealedStiffness) {
  Hanging h = trapped();
  h.actuator.loss = {};
  const double rest = *rest_length(h), w = sealed_frequency(h, rest), small = 1e-6;
  const std::vector<double> t = instants(3, 0.01);
  const std::vector<double> x = lengths(h, rest + small, 0, t, 200);
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_NEAR(x[i], rest + small * std::cos(w * t[i]), 2e-3 * small);
}

TEST(FreeDecay, FrictionHoldsWhatTheLoadDoesNotMove) {
  Hanging h = trapped();
  const double rest = *rest_length(h);
  const double bound =
      actuator::coulomb_bound(h.actuator, rest, h.pressure - h.atmosphere, h.atmosphere, 0);
  const double k = std::pow(sealed_frequency(h, rest), 2) * h.mass;
  const std::vector<double> t = instants(0.5, 0.01);
  const std::vector<double> held = lengths(h, rest + 0.9 * bound / k, 0, t);
  EXPECT_EQ(held.back(), rest + 0.9 * bound / k);
  const std::vector<double> slides = lengths(h, rest + 1.5 * bound / k, 0, t);
  EXPECT_NE(slides.back(), slides.front());
  // It comes to rest within the band.
  const std::vector<double> falls = lengths(h, rest + 0.1 * inch, 0, instants(5, 0.01));
  EXPECT_LE(std::abs(falls.back() - rest), 1.1 * bound / k);
  EXPECT_EQ(falls.back(), falls[falls.size() - 10]);
}

TEST(FreeDecay, WhatLeavesTheBraidIsNoTrajectory) {
  Hanging h = trapped();
  h.mass = 100;  // beyond the thread's length at any pressure the muscle has
  h.actuator.long_end.stiffness = 0;
  EXPECT_FALSE(rest_length(h).has_value());
  std::vector<double> t = instants(1, 0.01), x(t.size());
  EXPECT_FALSE(free_decay(h, 0.08, 0, t, x));
}

}  // namespace
}  // namespace sinew::identify::free_decay_test
