// Tension with effectiveness, ends and losses, [30]-[35].

#include "sinew/actuator/tension.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/actuator/loss.h"
#include "sinew/actuator/thesis_actuator.h"

namespace sinew::actuator::tension_test {
namespace {

const double atmosphere = thesis_atmosphere;

TEST(Effectiveness, IsHeldOutsideTheFittedPressures) {
  const Effectiveness e = thesis_actuator().effectiveness;
  EXPECT_EQ(effectiveness(e, -5e4, atmosphere), e.c0);
  EXPECT_EQ(effectiveness(e, 2e6, atmosphere), effectiveness(e, e.valid_to, atmosphere));
}

TEST(Effectiveness, AbsoluteArgumentIsTheGaugeOneShifted) {
  Effectiveness gauge = thesis_actuator().effectiveness;
  Effectiveness absolute = gauge;
  absolute.argument = Effectiveness::Argument::absolute;
  for (double p : {0.0, 2e5, 5e5}) {
    EXPECT_DOUBLE_EQ(effectiveness(absolute, p, atmosphere),
                     effectiveness(gauge, p + atmosphere, atmosphere));
  }
}

TEST(Effectiveness, ScaleIsAFactor) {
  Effectiveness e = thesis_actuator().effectiveness;
  const double whole = effectiveness(e, 4e5, atmosphere);
  e.scale = 0.9;
  EXPECT_DOUBLE_EQ(effectiveness(e, 4e5, atmosphere), 0.9 * whole);
}

TEST(Tension, VacuumPushes) {
  const Actuator a = thesis_actuator();
  EXPECT_LT(clamped_tension(a, 0.08, 0, -3e4, atmosphere), 0);
  EXPECT_GT(clamped_tension(a, 0.08, 0, 3e4, atmosphere), 0);
  EXPECT_EQ(clamped_tension(a, 0.08, 0, 0, atmosphere), 0);
}

TEST(Tension, IsContinuousAtBothEnds) {
  const Actuator a = thesis_actuator();
  for (double end : {shortest_length(a.braid), a.long_end.length}) {
    const double below = clamped_tension(a, end - 1e-10, 0, 6e5, atmosphere);
    const double above = clamped_tension(a, end + 1e-10, 0, 6e5, atmosphere);
    EXPECT_NEAR(below, above, 1e-4);
  }
}

TEST(Tension, LongEndIsASpringAndDamperInParallel) {
  const Actuator a = thesis_actuator();
  const double beyond = a.long_end.length + 1e-3, v = 0.2;
  const double rest =
      ideal_tension(a.braid, beyond, 3e5) * effectiveness(a.effectiveness, 3e5, atmosphere) +
      a.loss.viscous * v;
  EXPECT_NEAR(clamped_tension(a, beyond, v, 3e5, atmosphere),
              rest + a.long_end.stiffness * 1e-3 + a.long_end.damping * v, 1e-9);
}

TEST(Tension, ShortEndStopsOrLetsGo) {
  Actuator a = thesis_actuator();
  const double below = shortest_length(a.braid) - 1e-3;
  const double braid_alone =
      ideal_tension(a.braid, below, 3e5) * effectiveness(a.effectiveness, 3e5, atmosphere);
  EXPECT_NEAR(clamped_tension(a, below, 0, 3e5, atmosphere),
              braid_alone - a.short_end.stiffness * 1e-3, 1e-9);
  EXPECT_LT(braid_alone, 0);  // the mesh is past its widest: air pushes it back

  a.short_end.law = ShortEnd::Law::zero;
  EXPECT_EQ(clamped_tension(a, below, 0.3, 3e5, atmosphere), 0);
}

// Appendix A's commented line: 5 F + 10 F_damping, F with the damping in it.
TEST(Tension, EmpiricalShortEndIsAppendixAsOtherLine) {
  Actuator a = thesis_actuator();
  Actuator open = a;  // as without an end
  a.short_end = {.law = ShortEnd::Law::empirical};
  open.short_end = {};
  const double p = 4e5, shortest = shortest_length(a.braid);
  for (const double l : {0.5 * shortest, 0.9 * shortest, shortest, 1.2 * shortest}) {
    for (const double v : {-0.3, 0.0, 0.2}) {
      const double pull = clamped_tension(open, l, 0, p, atmosphere), lost = a.loss.viscous * v;
      const double expected = l < shortest ? 5 * (pull + lost) + 10 * lost : pull + lost;
      EXPECT_NEAR(clamped_tension(a, l, v, p, atmosphere), expected, 1e-12);
    }
    EXPECT_DOUBLE_EQ(coulomb_bound(a, l, p, atmosphere, 0),
                     coulomb_bound(open, l, p, atmosphere, 0) * (l < shortest ? 15 : 1));
  }
}

TEST(Tension, LossesTakePowerAway) {
  Actuator a = thesis_actuator();
  a.bladder = {.stiffness = 300, .rest_length = 0.08};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<> length(0.055, 0.105), speed(-1, 1), pressure(0, 7e5);
  for (int i = 0; i < 1000; ++i) {
    const double l = length(random), v = speed(random), p = pressure(random);
    const double loss =
        clamped_tension(a, l, v, p, atmosphere) - clamped_tension(a, l, 0, p, atmosphere);
    EXPECT_GE(loss * v, 0);
  }
}

// Lengths times k, pressures times p: forces go as p k^2.
TEST(Tension, ScalesWithLengthSquaredAndPressure) {
  const double k = 2.5, p = 3;
  const Actuator a = thesis_actuator();
  Actuator big = a;
  big.braid.thread_length *= k;
  big.effectiveness.c1 /= p;
  big.effectiveness.c2 /= p * p;
  big.effectiveness.valid_to *= p;
  big.long_end.length *= k;
  for (auto* end : {&big.long_end.stiffness, &big.short_end.stiffness}) *end *= p * k;
  big.loss.viscous *= p * k;  // force per speed, times unchanged
  big.long_end.damping *= p * k;
  big.short_end.damping *= p * k;

  std::mt19937_64 random(2);
  std::uniform_real_distribution<> length(0.055, 0.105), speed(-1, 1), pressure(0, 7e5);
  for (int i = 0; i < 1000; ++i) {
    const double l = length(random), v = speed(random), g = pressure(random);
    const double small = clamped_tension(a, l, v, g, atmosphere);
    EXPECT_NEAR(clamped_tension(big, k * l, k * v, p * g, p * atmosphere), p * k * k * small,
                1e-12 * (1 + std::abs(small)) * p * k * k);
  }
}

TEST(Loss, SecantIsTensionOverWhatIsLeftToContract) {
  const Actuator a = thesis_actuator();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> length(0.065, 0.099), pressure(0, 7e5);
  for (int i = 0; i < 1000; ++i) {
    const double l = length(random), p = pressure(random);
    const double pull =
        ideal_tension(a.braid, l, p) * effectiveness(a.effectiveness, p, atmosphere);
    const double secant = pull / (l - shortest_length(a.braid));
    EXPECT_NEAR(secant_stiffness(a, l, p, atmosphere), secant, 1e-10 * secant);
  }
}

TEST(Loss, SecantIsFiniteWhereTheThesisHas0Over0) {
  const Actuator a = thesis_actuator();
  const double shortest = shortest_length(a.braid), p = 4e5;
  // Secant and tangent meet there.
  EXPECT_NEAR(
      secant_stiffness(a, shortest, p, atmosphere),
      6 * p * shortest * braid_factor(a.braid) * effectiveness(a.effectiveness, p, atmosphere),
      1e-9);
}

TEST(Loss, BoundFollowsItsScaleAndIsNeverNegative) {
  Actuator a = thesis_actuator();
  const double l = 0.08, p = 4e5, sealed = 5000;
  const double q = a.loss.coulomb_length;
  EXPECT_DOUBLE_EQ(coulomb_bound(a, l, p, atmosphere, sealed),
                   q * secant_stiffness(a, l, p, atmosphere));
  a.loss.coulomb_scale = Loss::Scale::sealed;
  EXPECT_DOUBLE_EQ(coulomb_bound(a, l, p, atmosphere, sealed), q * sealed);
  EXPECT_EQ(coulomb_bound(a, l, p, atmosphere, -sealed), 0);
  a.loss.coulomb_scale = Loss::Scale::constant;
  a.loss.coulomb_stiffness = 3000;
  EXPECT_DOUBLE_EQ(coulomb_bound(a, l, p, atmosphere, sealed), q * 3000);
}

// [33]: losses dissipate power, and the tension at rest is halfway between both directions.
TEST(SlidingTension, LosesBothWaysAndOnlyWhileItMoves) {
  const Actuator a = thesis_actuator();
  std::mt19937 random(33);
  std::uniform_real_distribution<double> lengths(0.064, 0.095), pressures(1e5, 6e5), speeds(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const double l = lengths(random), p = pressures(random), v = speeds(random);
    const double rest = clamped_tension(a, l, 0, p, atmosphere);
    const double bound = coulomb_bound(a, l, p, atmosphere, 0);
    const double out = sliding_tension(a, l, v, p, atmosphere, 0);
    const double in = sliding_tension(a, l, -v, p, atmosphere, 0);
    ASSERT_NEAR(out - rest, bound + a.loss.viscous * v, 1e-12);
    ASSERT_NEAR(in, std::max(rest - bound - a.loss.viscous * v, 0.0), 1e-12);
    ASSERT_EQ(sliding_tension(a, l, 0, p, atmosphere, 0), rest);
  }
}

// A muscle cannot push: its tension is that of the clamped actuator where that pulls, and 0
// elsewhere.
TEST(Tension, NeverPushes) {
  std::mt19937 random(39);
  const Actuator a = thesis_actuator();
  std::uniform_real_distribution<double> length(0.5 * shortest_length(a), a.braid.thread_length),
      pressure(-5e4, 8e5);
  int pushes = 0;
  for (int k = 0; k < 1000; ++k) {
    const double l = length(random), p = pressure(random);
    const double clamped = clamped_tension(a, l, 0, p, thesis_atmosphere);
    EXPECT_EQ(tension(a, l, 0, p, thesis_atmosphere), std::max(clamped, 0.0));
    EXPECT_GE(sliding_tension(a, l, -0.1, p, thesis_atmosphere, 0), 0);
    pushes += clamped < 0;
  }
  EXPECT_GT(pushes, 100);
}

}  // namespace
}  // namespace sinew::actuator::tension_test
