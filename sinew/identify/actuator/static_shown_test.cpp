// A static report explains wrong points, its errors by part sum to the total, and its intervals are
// about the law.
#include "sinew/identify/actuator/static.h"

#include <gtest/gtest.h>

#include <random>

#include "sinew/identify/actuator/test_muscle.h"

namespace sinew::identify::static_shown_test {
namespace {

constexpr double rest = test_rest_length;

// Returns a muscle at six lengths and twelve pressures, with the noise of a good force cell.
StaticData good_data() {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  StaticData out;
  for (const double contraction : {0.0, 0.02, 0.04, 0.07, 0.1, 0.14})
    for (int step = 1; step <= 12; ++step) {
      StaticPoint p{
          .length = rest * (1 - contraction), .pressure = 0.5e5 * step, .rest_length = rest};
      p.force = predicted(test_muscle(), {.rest_length = rest}, p) + normal(random);
      out.points.push_back(p);
    }
  return out;
}

std::size_t place_of(int mount, int step) {
  return static_cast<std::size_t>(12 * mount + step - 1);
}

// Returns the explanation of the only wrong point.
std::string told_of(const StaticData& data) {
  const Report report = identify_static(data, {.braid = test_muscle().actuator.braid}).report;
  if (report.left_out.size() != 1) return "nothing is left out";
  EXPECT_EQ(report.left_out[0].reason, "outlier");
  EXPECT_EQ(report.left_out[0].count, 1u);
  return report.left_out[0].rows[0].why;
}

TEST(LeftOut, ASlippedDecimalIsReported) {
  StaticData data = good_data();
  data.points[place_of(2, 6)].force *= 10;
  EXPECT_NE(told_of(data).find("a slipped decimal"), std::string::npos);
}

TEST(LeftOut, AReadingOfAnotherMountIsReported) {
  StaticData data = good_data();
  StaticPoint as = data.points[place_of(2, 11)];
  as.length = data.points[place_of(5, 1)].length;
  data.points[place_of(2, 11)].force = predicted(test_muscle(), {.rest_length = rest}, as);
  EXPECT_NE(told_of(data).find("another mount"), std::string::npos) << told_of(data);
}

TEST(LeftOut, ZeroForceIsReported) {
  StaticData data = good_data();
  data.points[place_of(1, 9)].force = 0;
  EXPECT_NE(told_of(data).find("no force where the law pulls"), std::string::npos);
}

TEST(LeftOut, WhatNothingExplainsIsReported) {
  StaticData data = good_data();
  data.points[place_of(0, 12)].force *= 1.35;
  EXPECT_NE(told_of(data).find("nothing in these data explains it"), std::string::npos)
      << told_of(data);
}

TEST(LeftOut, OfGoodDataNothingIs) {
  EXPECT_TRUE(identify_static(good_data(), {}).report.left_out.empty());
}

TEST(StaticErrors, PartsAreThoseOfAllPoints) {
  StaticData data = good_data();
  for (std::size_t i = 0; i < data.points.size(); i += 3) data.points[i].fitted = false;
  const Report report = identify_static(data, {}).report;
  ASSERT_EQ(report.errors.size(), 2u);  // length and pressure: one muscle, no branch
  const Score whole = score(report.best().residuals, report.full_scale);
  EXPECT_EQ(whole.points, data.points.size());
  for (const ErrorBy& by : report.errors) {
    std::size_t points = 0;
    double squares = 0;
    for (const PartError& p : by.parts) {
      points += p.score.points;
      squares += static_cast<double>(p.score.points) * p.score.rmse * p.score.rmse;
    }
    EXPECT_EQ(points, whole.points) << by.what;
    EXPECT_NEAR(squares, static_cast<double>(whole.points) * whole.rmse * whole.rmse,
                1e-9 * squares);
  }
}

TEST(StaticCurves, IntervalsAreOneWithinTheOtherAndWiderBeyondTheData) {
  const StaticResult result = identify_static(good_data(), {});
  ASSERT_EQ(result.report.curves.size(), 6u);
  for (const PredictedCurve& curve : result.report.curves) {
    const std::size_t last = curve.at.size() - 1, middle = last / 2;
    for (std::size_t i = 0; i <= last; ++i) EXPECT_LE(curve.half_68[i], curve.half_95[i]);
    EXPECT_GT(curve.at[last], 6e5);
    EXPECT_GE(curve.half_95[last], curve.half_95[middle]);
  }
}

}  // namespace
}  // namespace sinew::identify::static_shown_test
