// Verdicts follow from numbers, and from nothing else.
#include "sinew/report/claim.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::report {
namespace {

Measured half_a_millisecond(double ours) {
  return {.where = "4.3",
          .says = "opens in about half a millisecond",
          .theirs = "0.5 ms",
          .quantity = "first dip",
          .ours = ours,
          .unit = "ms",
          .accept = {0.4, 0.6},
          .why = "by eye",
          .because = {}};
}

TEST(Claim, AgreesInsideOfItsBandAndAtItsEnds) {
  for (const double ours : {0.4, 0.5, 0.6})
    EXPECT_EQ(judge(half_a_millisecond(ours)).verdict, Is::agrees) << ours;
  for (const double ours : {0.399, 0.601, -0.5, std::nan("")})
    EXPECT_EQ(judge(half_a_millisecond(ours)).verdict, Is::differs) << ours;
}

// Met, but no evidence; missed, it differs as any other.
TEST(Claim, WhatWasPutInIsCountedApart) {
  Measured m = half_a_millisecond(0.5);
  m.put_in = true;
  EXPECT_EQ(word(judge(m)), "as put in");
  Tally tally;
  count(tally, {judge(m)});
  EXPECT_EQ(tally.agree, 0);
  EXPECT_EQ(tally.as_put_in, 1);
  m.ours = 0.7;
  EXPECT_EQ(word(judge(m)), "differs");
  count(tally, {judge(m)});
  EXPECT_EQ(tally.differ, 1);
  EXPECT_EQ(total(tally), 2);
}

TEST(Claim, AKnownDifferenceThatIsNoMoreIsToldToo) {
  Measured m = half_a_millisecond(0.7);
  m.because = "our coil is larger";
  EXPECT_EQ(judge(m).verdict, Is::differs_as_known);
  EXPECT_EQ(judge(m).why, "by eye. Known to differ: our coil is larger");
  m.ours = 0.5;
  EXPECT_EQ(judge(m).verdict, Is::agrees_after_all);
  Tally tally;
  count(tally, {judge(m)});
  EXPECT_EQ(tally.differ, 1);  // somebody has to take the reason away
}

TEST(Claim, TellsNumbersWithTheirUnits) {
  const Claim both = judge(half_a_millisecond(0.47));
  EXPECT_EQ(both.ours, "0.47 ms");
  EXPECT_EQ(both.accept, "0.4 to 0.6 ms");
  Measured m = half_a_millisecond(-1e-9);
  m.accept = {.highest = 2};
  EXPECT_EQ(judge(m).accept, "at most 2 ms");
  EXPECT_EQ(judge(m).ours, "-1e-09 ms");
  m.accept = {0, 2};
  EXPECT_EQ(judge(m).ours, "0 ms");  // rounding, beside such a band
  m.unit = "";
  m.accept = {.lowest = 3};
  m.ours = 12345.678;
  EXPECT_EQ(judge(m).accept, "at least 3");
  m.ours = std::nan("");
  EXPECT_EQ(judge(m).ours, "none");
}

// Of a verdict that the experiment's file has: its reason stands apart from its source.
TEST(Claim, TakesAVerdictWithItsReason) {
  analysis::Verdict v{.key = "trolley.distance_m",
                      .reported = "5 ft",
                      .ours = "57.7 in",
                      .accept = "53 in to 60 in",
                      .source = "6.3",
                      .is = Is::agrees};
  EXPECT_EQ(claim(v).where, "6.3");
  EXPECT_EQ(claim(v).why, "");
  EXPECT_EQ(claim(v).ours, "57.7 in");
  v.source += ". Why: the track ends";
  v.is = Is::differs_as_known;
  EXPECT_EQ(claim(v).where, "6.3");
  EXPECT_EQ(claim(v).why, "Known to differ: the track ends");
  EXPECT_EQ(claim(v).verdict, Is::differs_as_known);
}

// A narrow band shows the digits that lie in it.
TEST(Claim, ShowsWhyANumberIsOutside) {
  Measured m = half_a_millisecond(2.8934);
  m.accept = {2.8931, 2.8933};
  EXPECT_EQ(judge(m).ours.substr(0, 6), "2.8934");
}

TEST(Claim, CountsEachVerdictOnce) {
  Tally tally;
  count(tally, {judge(half_a_millisecond(0.5)), judge(half_a_millisecond(2)),
                not_comparable("2.3", "a larger actuator", "", "its size is not given")});
  EXPECT_EQ(tally.agree, 1);
  EXPECT_EQ(tally.differ, 1);
  EXPECT_EQ(tally.not_comparable, 1);
  EXPECT_EQ(tally.differ_as_known, 0);
  EXPECT_EQ(word(not_comparable("2.3", "", "", "no size")), "not comparable");
  EXPECT_EQ(word({.verdict = Is::differs_as_known}), "differs, as known");
  EXPECT_EQ(judge({.ours = 1000, .unit = "Hz", .accept = {.lowest = 400}}).ours, "1000 Hz");
}

}  // namespace
}  // namespace sinew::report
