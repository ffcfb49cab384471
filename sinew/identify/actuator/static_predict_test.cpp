// Muscles that were not measured: similar to measured ones, and corrected by one reading.
#include "sinew/identify/actuator/static_predict.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/actuator/prediction.h"
#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/test_muscle.h"
#include "sinew/identify/contest/refusal.h"

namespace sinew::identify::static_predict_test {
namespace {

actuator::Actuator measured_muscle() {
  actuator::Actuator a = test_muscle().actuator;
  a.prediction = {.rest_length = test_rest_length,
                  .lengths = {0.2, 0.23, 0.25},
                  .lowest = 1e5,
                  .highest = 6e5,
                  .inside_68 = 2,
                  .inside_95 = 4,
                  .between_68 = 3,
                  .between_95 = 6,
                  .beyond_68 = 4,
                  .beyond_95 = 10,
                  .other_68 = 0.02,
                  .other_95 = 0.05,
                  .other_reach = 0.5};
  return a;
}

double force(const actuator::Actuator& a, double length, double pressure) {
  return actuator::clamped_tension(a, length, 0, pressure, units::atmosphere);
}

// Returns the muscle after one reading at 250 mm and 6 bar, where it pulls most.
actuator::Actuator read(const actuator::Actuator& a, double force) {
  return scale_force(a, reading_factor(a, {0.25, 6e5, force}, units::atmosphere).law);
}

// Force depends on strain, not length: a similar muscle pulls the same at the same share of its
// rest length, as long as only the braid and the first part of the bladder pull.
TEST(Predict, ALikeMusclePullsTheSameAtTheSameStrain) {
  actuator::Actuator a = measured_muscle();
  a.bladder.stiffness = 0;
  const actuator::Actuator half = with_rest_length(a, 0.5 * test_rest_length, units::atmosphere);
  for (const double strain : {0.8, 0.9, 1.0})
    for (const double p : {2e5, 5e5})
      EXPECT_NEAR(force(half, 0.5 * strain * test_rest_length, p),
                  force(a, strain * test_rest_length, p), 1e-9);
}

// The ends of every muscle are the same: their compliance does not scale, and a short muscle loses
// more.
TEST(Predict, EndsThatGiveWayTakeMoreFromAShortMuscle) {
  actuator::Actuator a = measured_muscle();
  a.series.compliance = 1e-5;
  const actuator::Actuator half = with_rest_length(a, 0.5 * test_rest_length, units::atmosphere);
  EXPECT_EQ(half.series.compliance, a.series.compliance);
  EXPECT_LT(force(half, 0.5 * test_rest_length, 5e5), force(a, test_rest_length, 5e5));
}

TEST(Predict, ThereAndBackIsTheSameMuscle) {
  const actuator::Actuator a = measured_muscle();
  const actuator::Actuator there = with_rest_length(a, 0.17, units::atmosphere);
  const actuator::Actuator back = with_rest_length(there, test_rest_length, units::atmosphere);
  for (const double l : {0.2, 0.22, 0.25}) EXPECT_NEAR(force(back, l, 4e5), force(a, l, 4e5), 1e-9);
}

// Beyond the tested ratio the interval grows with the distance, and is never below that of the fit.
TEST(Predict, IntervalsGrowBeyondTheRatioThatWasTried) {
  const actuator::Actuator a = measured_muscle();
  const auto share = [&](double rest_length) {
    const actuator::Actuator b = with_rest_length(a, rest_length, units::atmosphere);
    return b.prediction.inside_95 / force(b, b.prediction.lengths.back(), b.prediction.highest);
  };
  EXPECT_NEAR(share(0.25 * std::exp(0.4)), 0.05, 1e-9);
  EXPECT_NEAR(share(0.25 * std::exp(-1.0)), 0.10, 1e-9);
}

// In older files the share is that of the largest force at any force.
TEST(Predict, AnOlderFileHasOneIntervalAtAllForces) {
  const actuator::Actuator a = measured_muscle();
  const actuator::Actuator older = with_rest_length(a, 0.3, units::atmosphere, 1, 0),
                           newer = with_rest_length(a, 0.3, units::atmosphere);
  const double largest = force(older, older.prediction.lengths.back(), 6e5);
  for (const double at : {0.0, 0.5 * largest, largest}) {
    EXPECT_NEAR(actuator::widest_inside_68(older.prediction, at), 0.02 * largest, 1e-9);
    EXPECT_NEAR(actuator::widest_inside_95(older.prediction, at), 0.05 * largest, 1e-9);
  }
  EXPECT_NEAR(actuator::widest_inside_95(newer.prediction, largest), 0.05 * std::sqrt(5) * largest,
              1e-9);
}

// Strengths differ by 2 %, and the error of the law's form is 1 % there: the law is corrected by
// four fifths of the difference, at every length.
TEST(Predict, AReadingCountsAsFarAsItIsSurerThanTheLaw) {
  const actuator::Actuator a = measured_muscle();
  const actuator::Actuator b = read(a, 1.1 * force(a, 0.25, 6e5));
  for (const double l : {0.21, 0.23, 0.25})
    EXPECT_NEAR(force(b, l, 5e5), 1.08 * force(a, l, 5e5), 1e-9 * force(a, l, 5e5));
}

// At lower force the error of the form is a larger share.
TEST(Predict, AReadingOfASmallForceCountsLess) {
  const actuator::Actuator a = measured_muscle();
  const double f = force(a, 0.25, 2e5), most = force(a, 0.25, 6e5);
  const double factor = reading_factor(a, {0.25, 2e5, 1.1 * f}, units::atmosphere).law;
  EXPECT_NEAR(factor, 1 + 0.1 / (1 + std::pow(0.5 * most / f, 2)), 1e-12);
  EXPECT_LT(factor, 1.05);
}

// The error after a reading counts as one more muscle in addition to three.
TEST(Predict, AReadingNarrowsOrWidensTheInterval) {
  const actuator::Actuator a = measured_muscle();
  const double f = force(a, 0.25, 6e5);
  EXPECT_NEAR(reading_factor(a, {0.25, 6e5, f}, units::atmosphere).share, std::sqrt(0.75), 1e-12);
  const double left = (1 - 1.16 / 1.2) / std::sqrt(5);
  EXPECT_NEAR(reading_factor(a, {0.25, 6e5, 1.2 * f}, units::atmosphere).share,
              std::sqrt((3 + std::pow(left / 0.02, 2)) / 4), 1e-12);
  const auto inside = [&](double share) {
    return with_rest_length(a, 0.2, units::atmosphere, share).prediction.inside_95;
  };
  EXPECT_NEAR(inside(0.9), 0.9 * inside(1), 1e-12);
}

// A corrected muscle that is scaled keeps its correction: it is stronger by the same factor at
// every length, for any loss at the ends.
TEST(Predict, AReadingGoesAlongToOtherLengths) {
  for (const double scale : {1.0, 0.9}) {
    actuator::Actuator a = measured_muscle();
    a.effectiveness.scale = scale;
    a.toe.tension = 20;
    a.series.compliance = 1e-5;
    const double f = force(a, 0.25, 6e5);
    const actuator::Actuator b = read(a, 1.1 * f);
    const actuator::Actuator plain = with_rest_length(a, 0.15, units::atmosphere);
    const actuator::Actuator on = with_rest_length(b, 0.15, units::atmosphere);
    for (const double l : {0.13, 0.14, 0.15})
      EXPECT_NEAR(force(on, l, 5e5), 1.08 * force(plain, l, 5e5), 1e-6 * f);  // ends by iteration
  }
}

TEST(Predict, AReadingOfSomethingElseIsRefused) {
  const actuator::Actuator a = measured_muscle();
  const double f = force(a, 0.25, 6e5);
  for (const double force : {0.4 * f, 2.5 * f, 4.448 * f, -f})
    EXPECT_THROW(read(a, force), Refusal) << force;
  EXPECT_THROW(reading_factor(a, {0.1, 0, f}, units::atmosphere), Refusal);
}

TEST(Predict, AFileWithoutALengthIsRefused) {
  actuator::Actuator a = measured_muscle();
  a.prediction.lengths.clear();
  EXPECT_THROW(with_rest_length(a, 0.1, units::atmosphere), Refusal);
}

TEST(Predict, AFileWithoutItsRestLengthIsRefused) {
  try {
    with_rest_length(test_muscle().actuator, 0.1, units::atmosphere);
    FAIL();
  } catch (const Refusal& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("prediction.rest_length"), std::string::npos);
  }
}

}  // namespace
}  // namespace sinew::identify::static_predict_test
