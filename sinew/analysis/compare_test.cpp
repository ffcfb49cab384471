#include "sinew/analysis/verdict/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sinew/analysis/record/test_log.h"

namespace sinew::analysis::compare_test {
namespace {

using Times_ns = signals::Times;
using Values_of = signals::Column;
constexpr double gap = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t ms = 1'000'000;

struct Recorded {
  Times_ns time_ns;
  Values_of values;
  Recording view() const { return {&time_ns, &values}; }
};

Recorded every(std::int64_t period, std::int64_t offset, int samples, const test::Of& of) {
  Recorded out;
  for (int i = 0; i < samples; ++i) {
    out.time_ns.push_back(offset + i * period);
    out.values.push_back(of(1e-9 * static_cast<double>(out.time_ns.back())));
  }
  return out;
}

Difference of(const Recorded& a, const Recorded& b) {
  return difference(a.view(), b.view(), pair_samples(a.view(), b.view()));
}

const auto wave = [](double t) { return 3 + std::sin(5 * t); };

// --- samples ---

TEST(Compare, ARecordingAgainstItselfIsTheSame) {
  Recorded a = every(10 * ms, 0, 200, wave);
  a.values.set(7, gap);
  const Difference d = of(a, a);
  EXPECT_TRUE(d.same);
  EXPECT_TRUE(d.equal());
  EXPECT_EQ(d.rms, 0);
  EXPECT_EQ(d.largest, 0);
  EXPECT_EQ(d.samples, 199u);
  EXPECT_EQ(d.gaps, 1u);
}

TEST(Compare, OneBitIsADifference) {
  const Recorded a = every(10 * ms, 0, 200, wave);
  Recorded b = a;
  b.values.set(150, std::nextafter(b.values[150], 10));
  const Difference d = of(a, b);
  EXPECT_FALSE(d.same);
  EXPECT_EQ(d.largest, b.values[150] - a.values[150]);
  EXPECT_EQ(d.at, 1.5);
}

TEST(Compare, AConstantOffsetIsItsOwnRmsAndLargest) {
  const Recorded a = every(10 * ms, 0, 200, test::constant(2));
  const Recorded b = every(10 * ms, 0, 200, test::constant(1.5));
  const Difference d = of(a, b);
  EXPECT_EQ(d.rms, 0.5);
  EXPECT_EQ(d.largest, -0.5);
  EXPECT_EQ(d.at, 0) << "the first time of several";
  EXPECT_EQ(d.span, 0.5);
}

TEST(Compare, ExchangeChangesTheSignAndNothingElse) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1, 1);
  for (const auto& [period, offset] : {std::pair{10 * ms, 0L}, {20 * ms, 0L}, {7 * ms, 300'000L}}) {
    const Recorded a = every(10 * ms, 0, 100, [&](double) { return noise(random); });
    const Recorded b = every(period, offset, 80, [&](double) { return noise(random); });
    const Difference ab = of(a, b), ba = of(b, a);
    EXPECT_EQ(ab.how, ba.how);
    EXPECT_EQ(ab.largest, -ba.largest);
    EXPECT_EQ(ab.rms, ba.rms);
    EXPECT_EQ(ab.at, ba.at);
    EXPECT_EQ(ab.samples, ba.samples);
  }
}

TEST(Compare, GapsAreCountedAndNeverCrossed) {
  const Recorded a = every(10 * ms, 0, 100, test::constant(1));
  Recorded b = every(10 * ms, 0, 100, test::constant(1));
  b.values.set(3, gap);
  b.values.set(4, gap);
  const Difference d = of(a, b);
  EXPECT_EQ(d.gaps, 2u);
  EXPECT_EQ(d.samples, 98u);
  EXPECT_TRUE(d.equal());
  EXPECT_FALSE(d.same);

  // Values are not interpolated next to a NaN sample.
  Recorded dense = every(1 * ms, 500'000, 1000, test::constant(1));
  dense.values.set(19, gap);  // 19.5 ms, just before the sample at 20 ms
  const Difference between = of(a, dense);
  EXPECT_EQ(between.how, Pairing::between);
  EXPECT_EQ(between.gaps, 1u);
}

TEST(Compare, AGapInEverySampleLeavesNothingToCompare) {
  const Recorded a = every(10 * ms, 0, 10, test::constant(gap));
  const Difference d = of(a, every(10 * ms, 0, 10, test::constant(1)));
  EXPECT_EQ(d.samples, 0u);
  EXPECT_TRUE(std::isnan(d.rms));
  EXPECT_TRUE(std::isnan(d.at));
  EXPECT_FALSE(d.equal());
}

TEST(Compare, OtherPeriodsMeetAtCommonTimes) {
  const Recorded slow = every(10 * ms, 0, 100, wave), fast = every(1 * ms, 0, 1000, wave);
  const Difference d = of(slow, fast);
  EXPECT_EQ(d.how, Pairing::together);
  EXPECT_EQ(d.samples, 100u);
  EXPECT_TRUE(d.equal());
  EXPECT_FALSE(d.same) << "the other has more";

  // Samples half a tick apart are simultaneous, those a little further apart are not.
  EXPECT_EQ(pair_samples(slow.view(), every(10 * ms, 50'000, 100, wave).view()).how,
            Pairing::together);
  EXPECT_EQ(pair_samples(slow.view(), every(10 * ms, 50'001, 100, wave).view()).how,
            Pairing::between);
}

TEST(Compare, ClocksThatNeverMeetAreJoinedByStraightLines) {
  const auto ramp = [](double t) { return 7 * t; };
  const Recorded a = every(10 * ms, 1'300'000, 50, ramp), b = every(4 * ms, 0, 100, ramp);
  const PairedSamples met = pair_samples(a.view(), b.view());
  EXPECT_EQ(met.how, Pairing::between);
  ASSERT_EQ(met.time_ns.size(), 40u) << "as far as both go";
  EXPECT_EQ(met.time_ns.front(), 1'300'000);
  for (const double d : met.difference) EXPECT_NEAR(d, 0, 1e-15);
}

TEST(Compare, WhatDoesNotOverlapNeverMeets) {
  const Recorded a = every(10 * ms, 0, 10, wave), b = every(10 * ms, 1000 * ms, 10, wave);
  EXPECT_EQ(pair_samples(a.view(), b.view()).how, Pairing::never);
  EXPECT_EQ(pair_samples(a.view(), Recorded{}.view()).how, Pairing::never);
  EXPECT_FALSE(of(a, b).equal());
}

TEST(Compare, EdgesDifferByTheShareOfTimeInWhichTheyDo) {
  // One is open for 2 ms of every 10, the other for 3 ms: they differ for a tenth of the time.
  const signals::Table a = test::Log(0).pulses("/valve/m/inlet/open", 0.002, 1).table;
  const signals::Table b = test::Log(0).pulses("/valve/m/inlet/open", 0.003, 1).table;
  const auto view = [](const signals::Table& t) {
    return Recording{&t.series[0].time_ns, &t.series[0].columns[0]};
  };
  const Difference d = difference_of_edges(view(a), view(b), 0, 1000 * ms);
  EXPECT_EQ(d.how, Pairing::held);
  EXPECT_NEAR(d.rms, std::sqrt(0.1), 1e-12);
  EXPECT_EQ(d.largest, 1);
  EXPECT_NEAR(d.at, 0.002, 1e-12);
  EXPECT_TRUE(difference_of_edges(view(a), view(a), 0, 1000 * ms).same);

  // A valve without an edge is shut.
  const Difference shut = difference_of_edges(view(a), Recorded{}.view(), 0, 1000 * ms);
  EXPECT_NEAR(shut.rms, std::sqrt(0.2), 1e-12);
  EXPECT_EQ(shut.largest, -1);
}

// --- tables ---

TEST(Compare, TablesShareWhatHasTheSameNameAndUnit) {
  signals::Table a =
      test::Log(100).scalar("/a", wave).scalar("/b", wave).vector("/c", wave, wave).table;
  signals::Table b = test::Log(100).vector("/c", wave, test::constant(3)).scalar("/b", wave).table;
  b.series[1].topic.fields[0].unit = "N";
  const auto found = differences(a, b);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].topic, "/c");
  EXPECT_TRUE(found[0].difference.same);
  EXPECT_EQ(found[1].field, "y");
  EXPECT_NEAR(found[1].difference.rms, std::sqrt(0.5), 0.2);
}

TEST(Compare, ShiftedRunsMeetWhereTheirEventsDo) {
  const auto late = [](double t) { return wave(t - 0.25); };
  signals::Table a = test::Log(100).scalar("/a", wave).table;
  signals::Table b = test::Log(100).scalar("/a", late).table;
  shift(b, 250 * ms);
  EXPECT_EQ(times_of(b)->first, -250 * ms);
  const auto found = differences(a, b);
  EXPECT_EQ(found[0].difference.samples, 75u);
  EXPECT_LT(found[0].difference.rms, 1e-12);
}

// --- figures ---

Summary summary(std::vector<Entry> entries) {
  Summary out;
  for (Entry& e : entries) out.add(std::move(e.key), e.value);
  return out;
}

TEST(Compare, FiguresStandBesideEachOtherInTheFirstOnesOrder) {
  const Summary a = summary({{"x", 1}, {"y_m", 2}}), b = summary({{"z", 5}, {"y_m", 3}});
  const auto rows = compare_figures({&a, &b});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].key, "x");
  EXPECT_FALSE(rows[0].values[1]);
  EXPECT_EQ(rows[1].key, "y_m");
  EXPECT_EQ(*rows[1].values[1], 3);
  EXPECT_EQ(rows[2].key, "z");
  EXPECT_FALSE(rows[2].values[0]);
}

TEST(Compare, RelativeDifferencesAreThoseOfTheFirst) {
  EXPECT_EQ(*relative_difference(2, 3), 0.5);
  EXPECT_EQ(*relative_difference(-2, -3), -0.5) << "down is down";
  EXPECT_EQ(*relative_difference(0, 0), 0);
  EXPECT_FALSE(relative_difference(0, 1e-12));
  EXPECT_EQ(size_of_change({"", {0.0, 5.0}}), 1);
  EXPECT_EQ(size_of_change({"", {1.0, -1.0}}), 2);
  EXPECT_EQ(size_of_change({"", {4.0, 4.0, 5.0, std::nullopt}}), 0.2);
  EXPECT_EQ(size_of_change({"", {std::nullopt, 4.0}}), 0);
}

}  // namespace
}  // namespace sinew::analysis::compare_test
