// Wrong labels of rest lengths: fitted with the law if there are several muscles.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "sinew/actuator/tension.h"
#include "sinew/identify/actuator/static_labels.h"
#include "sinew/identify/actuator/static_predict.h"
#include "sinew/identify/actuator/test_muscle.h"

namespace sinew::identify::static_rest_length_test {
namespace {

constexpr std::array labels = {0.1, 0.16, 0.25};
constexpr std::array mounts = {1.0, 0.97, 0.93, 0.88};
const StaticScales scales{.rest_length = test_rest_length};

// Three muscles of one make, each longer than its label by its error [m]. The mount at rest has the
// label of the rest length; the others are measured with a ruler.
StaticData measured(const std::array<double, 3>& errors, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  StaticSetting truth = test_muscle();
  for (std::size_t m = 0; m < labels.size(); ++m)
    truth.rest_lengths.push_back({labels[m], errors[m]});
  StaticData out;
  for (const double label : labels)
    for (const double mount : mounts)
      for (double p = 0.5e5; p < 6.6e5; p += 0.5e5) {
        StaticPoint point{.length = mount * label, .pressure = p, .rest_length = label};
        point.force = predicted(truth, scales, point) + 1.5 * normal(random);
        point.pressure += 500 * normal(random);
        out.points.push_back(point);
      }
  return out;
}

StaticResult identified(const StaticData& data) {
  return identify_static(data, {.model = "saturating-elastic"});
}

const Estimate& error_of(const StaticResult& found, double label) {
  const Estimate* e = rest_length_estimate(found.fit, label);
  if (!e) throw std::out_of_range("a label that is believed");
  return *e;
}

std::string notes_of(const StaticResult& found) {
  std::string out;
  for (const std::string& note : found.report.best().notes) out += note + "\n";
  return out;
}

// Errors of the expected size, independent but with a common part: at least 54 of 60 intervals
// contain the true error. Differences between muscles are determined much better.
TEST(RestLength, ErrorsOfLabelsAreHeldByTheirIntervals) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  int held = 0, beside = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::array<double, 3> errors{};
    double common = 0, found_common = 0;
    for (std::size_t m = 0; m < 3; ++m) {
      errors[m] = std::clamp(normal(random), -2.5, 2.5) * rest_length_deviation(labels[m]);
      common += errors[m] / labels[m] / 3;
    }
    const StaticResult found = identified(measured(errors, seed));
    for (const double label : labels) found_common += error_of(found, label).value / label / 3;
    for (std::size_t m = 0; m < 3; ++m) {
      const Estimate& e = error_of(found, labels[m]);
      held += e.low <= errors[m] && errors[m] <= e.high;
      beside +=
          std::abs(e.value / labels[m] - found_common - errors[m] / labels[m] + common) < 2e-3;
      EXPECT_LT(e.high - e.low, 4 * rest_length_deviation(labels[m]));
    }
    EXPECT_LT(found.report.best().fit.rmse_percent, 0.6);
  }
  EXPECT_GE(held, 54);
  EXPECT_GE(beside, 54);
}

// Correct labels are not changed, and not mentioned.
TEST(RestLength, RightLabelsAreBelieved) {
  int held = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const StaticResult found = identified(measured({}, seed));
    for (const double label : labels) {
      const Estimate& e = error_of(found, label);
      held += e.low <= 0 && 0 <= e.high;
      EXPECT_NEAR(e.value, 0, 0.003 * label) << seed;
    }
    EXPECT_EQ(notes_of(found).find("pulls as one of"), std::string::npos) << notes_of(found);
  }
  EXPECT_GE(held, 27);
}

// The common part of all labels is not attributed to their errors, but to the law's own lengths.
TEST(RestLength, WhatAllLabelsHaveInCommonIsNotTheirs) {
  const StaticResult found = identified(measured({0.001, 0.0016, 0.0025}, 3));
  double sum = 0;
  for (const double label : labels) sum += error_of(found, label).value / label;
  EXPECT_NEAR(sum, 0, 0.004);
}

// The label of a single muscle cannot be tested: no error is fitted.
TEST(RestLength, OneMuscleHasNoError) {
  StaticData all = measured({0.0012, 0, 0}, 4), one;
  for (const StaticPoint& p : all.points)
    if (p.rest_length == labels[0]) one.points.push_back(p);
  const StaticResult found = identified(one);
  EXPECT_EQ(rest_length_estimate(found.fit, labels[0]), nullptr);
  EXPECT_EQ(found.fit.solution.estimates.size(), found.fit.free_parameters.size());
  EXPECT_EQ(found.muscles[0].file_length, labels[0]);
}

// A muscle scaled to another length is that of the fit, for any muscle's file.
TEST(RestLength, EveryFileScalesToTheSameMuscle) {
  const StaticResult found = identified(measured({0.0012, -0.00064, -0.002}, 5));
  const StaticMuscle wanted = muscle_of(found, 0.2);
  for (const StaticMuscle& m : found.muscles) {
    actuator::Actuator a = m.actuator;
    a.prediction = prediction_of(found, m);
    const std::string file = static_file(found, m, "m", "a test", "");
    EXPECT_NE(file.find("labelled"), file.npos) << file;
    EXPECT_GT(a.prediction.inside_95, 0);
    const actuator::Actuator b = with_rest_length(a, 0.2, units::atmosphere);
    for (double l = 0.17; l <= 0.2; l += 0.005)
      for (double p = 1e5; p < 6e5; p += 1e5)
        EXPECT_NEAR(actuator::clamped_tension(b, l, 0, p, units::atmosphere),
                    actuator::clamped_tension(wanted.actuator, l, 0, p, units::atmosphere), 1e-6);
  }
}

// The error of a file on the rows that it was made from, at the lengths as labelled, is at
// most that of the law with the fitted label or with the label as given; the stated half-widths
// contain 95 % of the errors.
TEST(RestLength, AFileIsScoredOnTheRowsThatItWasMadeFrom) {
  for (unsigned seed = 5; seed < 8; ++seed) {
    const StaticResult found = identified(measured({0.0012, -0.00064, -0.002}, seed));
    for (const StaticMuscle& m : found.muscles) {
      const auto misses_at = [&](double error) {
        StaticSetting setting = found.fit.setting;
        for (RestLengthError& label : setting.rest_lengths)
          if (label.labelled == m.rest_length) label.error = error;
        const actuator::Actuator a = scaled(setting, found.fit.scales, m.rest_length);
        std::vector<double> off;
        for (const StaticPoint& p : found.points)
          if (p.rest_length == m.rest_length)
            off.push_back(std::max(0.0, law_force(a, p.length, p, found.fit.scales.atmosphere)) -
                          p.force);
        return off;
      };
      const double whole = error_of(found, m.rest_length).value;
      const std::vector<double> own = misses_at(m.file_length - m.rest_length);
      EXPECT_LE(score(own, 1).rmse, 1.001 * score(misses_at(whole), 1).rmse) << m.rest_length;
      EXPECT_LE(score(own, 1).rmse, 1.001 * score(misses_at(0), 1).rmse) << m.rest_length;
      const actuator::Prediction told = prediction_of(found, m);
      EXPECT_EQ(told.rest_length, m.file_length);
      const auto inside =
          std::ranges::count_if(own, [&](double miss) { return std::abs(miss) <= told.inside_95; });
      EXPECT_GE(static_cast<double>(inside), 0.94 * static_cast<double>(own.size()));
    }
  }
}

// A muscle that was not fitted has its own label error, which widens its interval by the effect of
// a length error where the force is steepest.
TEST(RestLength, AnUnseenMuscleIsPredictedWithAnErrorOfItsOwn) {
  const StaticResult found = identified(measured({}, 6));
  const double rest = 0.16 + 1e-5, step = rest_length_deviation(rest);
  const StaticPoint seen{.length = 0.155, .pressure = 5e5, .rest_length = 0.16};
  const StaticPoint unseen{.length = 0.155, .pressure = 5e5, .rest_length = rest};
  const double known = widths(found.fit, std::vector{seen})[0];
  const double wider = widths(found.fit, std::vector{unseen})[0];
  StaticSetting more = found.fit.setting;
  more.rest_lengths.push_back({rest, step});
  const double worth = predicted(more, found.fit.scales, unseen) -
                       predicted(found.fit.setting, found.fit.scales, unseen);
  EXPECT_GT(std::abs(worth), 2);  // [N]
  EXPECT_GT(wider, std::hypot(0.9 * known, 0.9 * worth));
  EXPECT_LT(wider, std::hypot(1.5 * known, 1.1 * worth));
}

// Labels in other units, with rounding errors, are one muscle.
TEST(RestLength, LabelsWithinAMicrometreAreOneMuscle) {
  StaticData data = measured({}, 8);
  for (std::size_t i = 0; i < data.points.size(); i += 2) data.points[i].rest_length += 1e-10;
  EXPECT_EQ(identified(data).muscles.size(), 3u);
}

// A label with a large error is at its bound, and the errors of the others, which absorb a part of
// it, have no interval.
TEST(RestLength, ALabelThatIsFarOffIsReportedAsSuch) {
  const StaticResult found = identified(measured({0.01, 0, 0}, 9));
  const std::string said = notes_of(found);
  EXPECT_TRUE(error_of(found, labels[0]).at_bound);
  EXPECT_NE(said.find("the muscle labelled 100 mm would be longer by more than 7.1 mm"), said.npos)
      << said;
  EXPECT_EQ(said.find("pulls as one of"), said.npos) << said;
  EXPECT_EQ(error_of(found, labels[1]).high, unbounded);
}

// In a sweep of small steps the label's error cannot be assigned to one length.
TEST(RestLength, SweepsAndMusclesWithoutAMountAtRestAreBelieved) {
  std::vector<StaticPoint> points;
  for (const double label : labels)
    for (double mount = 1; mount > 0.9; mount -= label == labels[0] ? 0.01 : 0.03)
      points.push_back({.length = (label == labels[2] ? 0.985 : 1) * mount * label,
                        .pressure = 1e5,
                        .rest_length = label});
  for (const RestLengthError& r : labels_of(points)) EXPECT_FALSE(r.is_fitted()) << r.labelled;
  points.push_back({.length = labels[2], .pressure = 1e5, .rest_length = labels[2]});
  for (const double mount : {0.3, 0.29})
    points.push_back({.length = mount, .pressure = 1e5, .rest_length = 0.3});
  const std::vector<RestLengthError> four = labels_of(points);
  EXPECT_FALSE(four[0].is_fitted());
  EXPECT_TRUE(four[1].is_fitted());
  EXPECT_FALSE(four[2].is_fitted());  // the nearest mount is 1.5 % away
  EXPECT_TRUE(four[3].is_fitted());
  EXPECT_GT(four[3].low, -0.01);  // it stays longer than the next mount
}

// A few readings of a second muscle do not determine its error, and do not refuse its laws.
TEST(RestLength, AFewReadingsOfAnotherMuscleAreNoReasonToRefuse) {
  StaticData all = measured({}, 10), few;
  int taken = 0;
  for (const StaticPoint& p : all.points)
    if (p.rest_length == labels[2] || (p.rest_length == labels[0] && ++taken < 4))
      few.points.push_back(p);
  const StaticResult found = identified(few);
  EXPECT_LT(found.report.best().fit.rmse_percent, 1);
  EXPECT_NE(notes_of(found).find("250 mm was not left out"), std::string::npos) << notes_of(found);
}

// Two muscles give the uncertainty of a third, equally with the fit and with the file.
TEST(RestLength, TwoMusclesPredictAThirdAsTheirFileDoes) {
  StaticData all = measured({0.0012, 0, -0.002}, 11), two;
  for (const StaticPoint& p : all.points)
    if (p.rest_length != labels[1]) two.points.push_back(p);
  const StaticResult found = identified(two);
  const StaticMuscle& longest = found.muscles.front();
  actuator::Actuator kept = longest.actuator;
  kept.prediction = prediction_of(found, longest);
  const double by_file = with_rest_length(kept, 0.16, units::atmosphere).prediction.inside_95;
  const double by_fit = prediction_of(found, muscle_of(found, 0.16)).inside_95;
  EXPECT_GT(by_fit, 0.4 * by_file);
  EXPECT_LT(by_fit, 2.5 * by_file);
}

}  // namespace
}  // namespace sinew::identify::static_rest_length_test
