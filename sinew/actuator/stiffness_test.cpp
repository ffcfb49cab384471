// Stiffness is the slope of tension, for constant pressure and for sealed air.

#include "sinew/actuator/stiffness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/bundle.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::stiffness_test {
namespace {

const double atmosphere = thesis_atmosphere;
constexpr double psi = 6894.757293168361, inch = 0.0254;

// The actuator with both readings of Eff, a scale, and a range of pressures that is not exceeded.
Actuator some_actuator(bool absolute) {
  Actuator a = thesis_actuator();
  a.effectiveness.scale = 0.91;
  a.effectiveness.valid_from = -1e6;
  a.effectiveness.valid_to = 2e6;
  if (absolute) a.effectiveness.argument = Effectiveness::Argument::absolute;
  return a;
}

struct Point {
  double length, pressure, external, exponent;
};

Point any_point(std::mt19937_64& random) {
  using Uniform = std::uniform_real_distribution<>;
  return {Uniform(0.0625, 0.099)(random), Uniform(1.1e5, 8e5)(random), Uniform(0, 1e-5)(random),
          Uniform(1, 1.4)(random)};
}

// Returns the absolute pressure of the same air at another length.
double trapped(const Braid& braid, const Point& at, double length) {
  const double ratio =
      (volume(braid, at.length) + at.external) / (volume(braid, length) + at.external);
  return at.pressure * std::pow(ratio, at.exponent);
}

TEST(Stiffness, AtConstantPressureIsTheSlopeOfTension) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    const Actuator a = some_actuator(i % 2);
    const Point at = any_point(random);
    const double gauge = at.pressure - atmosphere, h = 1e-5;
    const double slope = (clamped_tension(a, at.length + h, 0, gauge, atmosphere) -
                          clamped_tension(a, at.length - h, 0, gauge, atmosphere)) /
                         (2 * h);  // exact for a parabola
    EXPECT_NEAR(stiffness_at_constant_pressure(a, at.length, gauge, atmosphere), slope, 1e-6);
  }
}

TEST(Stiffness, SealedIsTheSlopeOfTensionWithTheAirTrapped) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 500; ++i) {
    const Actuator a = some_actuator(i % 2);
    const Point at = any_point(random);
    const auto pull = [&](double length) {
      return clamped_tension(a, length, 0, trapped(a.braid, at, length) - atmosphere, atmosphere);
    };
    // Five-point rule.
    const double h = 2e-5, l = at.length;
    const double slope =
        (8 * (pull(l + h) - pull(l - h)) - (pull(l + 2 * h) - pull(l - 2 * h))) / (12 * h);
    const double sealed = stiffness_sealed(a, l, at.pressure, atmosphere, at.external, at.exponent);
    EXPECT_NEAR(sealed, slope, 1e-7 * sealed + 1e-5);
  }
}

TEST(Stiffness, SealedPressureSlopeIsThatOfTrappedAir) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const Braid braid = thesis_actuator().braid;
    const Point at = any_point(random);
    const double h = 1e-6;
    const double slope =
        (trapped(braid, at, at.length + h) - trapped(braid, at, at.length - h)) / (2 * h);
    EXPECT_NEAR(pressure_slope_sealed(braid, at.length, at.pressure, at.external, at.exponent),
                slope, 1e-6 * std::abs(slope) + 1);
  }
}

TEST(Stiffness, SealedExceedsConstantPressureByASquare) {
  // F = -P_g V' Eff: with constant Eff the difference is n P Eff V'^2/(V + V_ext), never negative.
  std::mt19937_64 random(4);
  for (int i = 0; i < 500; ++i) {
    const Actuator a = some_actuator(i % 2);
    const Point at = any_point(random);
    const double gauge = at.pressure - atmosphere;
    const double eff = effectiveness(a.effectiveness, gauge, atmosphere);
    const double slope = volume_slope(a.braid, at.length);
    const double more = at.exponent * at.pressure * eff * slope * slope /
                        (volume(a.braid, at.length) + at.external);
    EXPECT_NEAR(stiffness_sealed(a, at.length, at.pressure, atmosphere, at.external, at.exponent,
                                 EffectivenessSlope::neglected),
                stiffness_at_constant_pressure(a, at.length, gauge, atmosphere) + more,
                1e-10 * more + 1e-8);
  }
}

TEST(Stiffness, BothAgreeAtTheShortestLengthAndWithEndlessVolume) {
  const Actuator a = some_actuator(false);
  const double p = 5e5, shortest = shortest_length(a.braid);
  EXPECT_NEAR(stiffness_sealed(a, shortest, p, atmosphere, 0, 1.4),
              stiffness_at_constant_pressure(a, shortest, p - atmosphere, atmosphere), 1e-6);
  EXPECT_NEAR(stiffness_sealed(a, 0.08, p, atmosphere, 1e3, 1.4),
              stiffness_at_constant_pressure(a, 0.08, p - atmosphere, atmosphere), 1e-5);
}

// docs/evidence/departures.md, [25]: adiabatic, without Eff, hoses of both setups of chapter 3.
TEST(Stiffness, SealedIs123To185OfTheThesisStiffness) {
  Actuator a = thesis_actuator();
  a.effectiveness = {};
  const auto ratio = [&](double length_in, double external_in3) {
    const double gauge = 60 * psi;
    return stiffness_sealed(a, length_in * inch, gauge + atmosphere, atmosphere,
                            external_in3 * inch * inch * inch, 1.4) /
           stiffness_at_constant_pressure(a, length_in * inch, gauge, atmosphere);
  };
  EXPECT_NEAR(ratio(3.15, 0.495), 1.23, 0.005);
  EXPECT_NEAR(ratio(3.40, 0.114), 1.85, 0.006);
}

TEST(Stiffness, FromTensionIsThatOfThePressureWhateverTheEffectiveness) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 500; ++i) {
    const Actuator a = some_actuator(i % 2);
    const Point at = any_point(random);
    const double gauge = at.pressure - atmosphere;
    const double k = stiffness_at_constant_pressure(a, at.length, gauge, atmosphere);
    EXPECT_NEAR(stiffness_from_tension(a.braid, at.length,
                                       clamped_tension(a, at.length, 0, gauge, atmosphere)),
                k, 1e-9 * std::abs(k));
  }
}

TEST(Stiffness, FromTensionHasAPoleAtTheShortestLength) {
  const Braid braid = thesis_actuator().braid;
  const double shortest = shortest_length(braid), tension = 20;

  // k approaches F/(L - L_min): the sign changes through infinity.
  for (double away : {1e-3, 1e-5, 1e-7}) {
    EXPECT_GT(stiffness_from_tension(braid, shortest + away, tension), 0.99 * tension / away);
    EXPECT_LT(stiffness_from_tension(braid, shortest - away, tension), -0.99 * tension / away);
  }
  // Linear in the tension.
  EXPECT_DOUBLE_EQ(stiffness_from_tension(braid, 0.08, 2 * tension),
                   2 * stiffness_from_tension(braid, 0.08, tension));
}

TEST(Stiffness, PassivePartCompletesTheSlope) {
  Actuator a = thesis_actuator();
  a.bladder = {.stiffness = 364, .rest_length = 0.08};
  const double p = 3e5, h = 1e-6;
  for (double l : {0.058, 0.07, 0.09, 0.102}) {
    const double slope = (clamped_tension(a, l + h, 0, p, atmosphere) -
                          clamped_tension(a, l - h, 0, p, atmosphere)) /
                         (2 * h);
    EXPECT_NEAR(stiffness_at_constant_pressure(a, l, p, atmosphere) +
                    passive_stiffness(a, l, p, atmosphere),
                slope, 1e-5 * slope);
  }
}

TEST(Stiffness, ScalesWithLengthAndPressure) {
  const double k = 2.5, p = 3;
  Actuator a = thesis_actuator();
  a.effectiveness = {.scale = 0.9};
  Actuator big = a;
  big.braid.thread_length *= k;
  std::mt19937_64 random(6);
  for (int i = 0; i < 200; ++i) {
    const Point at = any_point(random);
    const double small =
        stiffness_sealed(a, at.length, at.pressure, atmosphere, at.external, at.exponent);
    EXPECT_NEAR(stiffness_sealed(big, k * at.length, p * at.pressure, p * atmosphere,
                                 k * k * k * at.external, at.exponent),
                p * k * small, 1e-12 * p * k * small);
  }
}

TEST(Bundle, IsThatManySingleActuators) {
  std::mt19937_64 random(7);
  for (int count : {1, 2, 5}) {
    const Point at = any_point(random);
    const Bundle bundle{
        .actuator = some_actuator(false), .count = count, .external_volume = count * at.external};
    const Actuator& one = bundle.actuator;
    const double gauge = at.pressure - atmosphere;
    EXPECT_DOUBLE_EQ(volume(bundle, at.length),
                     count * (volume(one.braid, at.length) + at.external));
    EXPECT_DOUBLE_EQ(clamped_tension(bundle, at.length, 0.1, gauge, atmosphere),
                     count * clamped_tension(one, at.length, 0.1, gauge, atmosphere));
    EXPECT_DOUBLE_EQ(stiffness_at_constant_pressure(bundle, at.length, gauge, atmosphere),
                     count * stiffness_at_constant_pressure(one, at.length, gauge, atmosphere));
    EXPECT_DOUBLE_EQ(stiffness_sealed(bundle, at.length, at.pressure, atmosphere, at.exponent),
                     count * stiffness_sealed(one, at.length, at.pressure, atmosphere, at.external,
                                              at.exponent));
  }
}

}  // namespace
}  // namespace sinew::actuator::stiffness_test
