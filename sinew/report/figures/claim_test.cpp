// Verdicts follow from numbers alone.
#include "sinew/report/figures/gallery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sinew::report::claim_test {
namespace {

using enum StatementClass;

Measured half_a_millisecond(double computed) {
  return {.where = "4.3",
          .says = "opens in about half a millisecond",
          .reported = "0.5 ms",
          .quantity = "first dip",
          .computed = computed,
          .unit = "ms",
          .accept = analysis::another(0.4, 0.6),
          .why = "by eye",
          .because = {}};
}

TEST(Claim, AgreesInsideOfItsBandAndAtItsEnds) {
  for (const double computed : {0.4, 0.5, 0.6})
    EXPECT_EQ(judge(predicted, half_a_millisecond(computed)).verdict, Agreement::agrees)
        << computed;
  for (const double computed : {0.399, 0.601, -0.5, std::nan("")})
    EXPECT_EQ(judge(predicted, half_a_millisecond(computed)).verdict, Agreement::differs)
        << computed;
}

// Statements are counted by class; one that is missed differs in every class.
TEST(Claim, IsCountedByClassAndVerdict) {
  Measured m = half_a_millisecond(0.5);
  Tally tally;
  count(tally, {judge(put_in, m), judge(predicted, m)});
  EXPECT_EQ(tally.of(put_in, Agreement::agrees), 1);
  EXPECT_EQ(tally.of(predicted, Agreement::agrees), 1);
  EXPECT_EQ(tally.of(fitted), 0);
  m.computed = 0.7;
  count(tally, {judge(put_in, m)});
  EXPECT_EQ(tally.of(put_in, Agreement::differs), 1);
  EXPECT_EQ(tally.of(Agreement::agrees), 2);
  EXPECT_EQ(tally.total(), 3);
}

// A band follows a rule or needs a reason.
TEST(Claim, ABandOfOurOwnNeedsItsReason) {
  Measured m = half_a_millisecond(0.5);
  m.why.clear();
  EXPECT_THROW((void)judge(predicted, m), std::logic_error);
  m.accept = analysis::about(0.5);
  EXPECT_EQ(judge(predicted, m).wording, analysis::Wording::about);
}

TEST(Claim, AKnownDifferenceThatHasVanishedIsReportedToo) {
  Measured m = half_a_millisecond(0.7);
  m.because = "our coil is larger";
  EXPECT_EQ(judge(predicted, m).verdict, Agreement::differs_as_known);
  EXPECT_EQ(judge(predicted, m).why, "by eye. Known to differ: our coil is larger");
  m.computed = 0.5;
  EXPECT_EQ(judge(predicted, m).verdict, Agreement::agrees_unexpectedly);
  Tally tally;
  count(tally, {judge(predicted, m)});
  EXPECT_EQ(tally.of(predicted, Agreement::agrees_unexpectedly),
            1);  // the reason has to be removed
}

TEST(Claim, ReportsNumbersWithTheirUnits) {
  const Claim both = judge(predicted, half_a_millisecond(0.47));
  EXPECT_EQ(both.computed, "0.47 ms");
  EXPECT_EQ(both.accept, "0.4 to 0.6 ms");
  Measured m = half_a_millisecond(-1e-9);
  m.accept = analysis::at_most(2);
  EXPECT_EQ(judge(predicted, m).accept, "at most 2 ms");
  EXPECT_EQ(judge(predicted, m).computed, "-1e-09 ms");
  m.accept = analysis::range(0, 2);
  EXPECT_EQ(judge(predicted, m).computed, "0 ms");  // rounding, compared with the band
  m.unit = "";
  m.accept = analysis::at_least(3);
  m.computed = 12345.678;
  EXPECT_EQ(judge(predicted, m).accept, "at least 3");
  m.computed = std::nan("");
  EXPECT_EQ(judge(predicted, m).computed, "none");
}

// The reason in a verdict of the experiment's file is separated from its source.
TEST(Claim, TakesAVerdictWithItsReason) {
  analysis::Verdict v{.key = "trolley.distance_m",
                      .reported = "5 ft",
                      .computed = "57.7 in",
                      .accept = "53 in to 60 in",
                      .source = "6.3",
                      .agreement = Agreement::agrees};
  EXPECT_EQ(claim(v).where, "6.3");
  EXPECT_EQ(claim(v).why, "");
  EXPECT_EQ(claim(v).computed, "57.7 in");
  v.source += ". Why: the track ends";
  v.agreement = Agreement::differs_as_known;
  EXPECT_EQ(claim(v).where, "6.3");
  EXPECT_EQ(claim(v).why, "Known to differ: the track ends");
  v.statement_class = StatementClass::fitted;
  v.band_reason = "two lines of the plot";
  EXPECT_EQ(claim(v).why, "two lines of the plot. Known to differ: the track ends");
  EXPECT_EQ(claim(v).statement_class, StatementClass::fitted);
  EXPECT_EQ(claim(v).verdict, Agreement::differs_as_known);
}

// A number is shown with the digits that a narrow band requires.
TEST(Claim, ShowsWhyANumberIsOutside) {
  Measured m = half_a_millisecond(2.8934);
  m.accept = analysis::range(2.8931, 2.8933);
  EXPECT_EQ(judge(predicted, m).computed.substr(0, 6), "2.8934");
}

TEST(Claim, CountsEachVerdictOnce) {
  Tally tally;
  count(tally, {judge(predicted, half_a_millisecond(0.5)), judge(predicted, half_a_millisecond(2)),
                not_applicable("2.3", "a larger actuator", "", "its size is not given")});
  EXPECT_EQ(tally.of(Agreement::agrees), 1);
  EXPECT_EQ(tally.of(Agreement::differs), 1);
  EXPECT_EQ(tally.of(none, Agreement::not_applicable), 1);
  EXPECT_EQ(tally.of(Agreement::differs_as_known), 0);
  EXPECT_EQ(judge(predicted, {.computed = 1000, .unit = "Hz", .accept = analysis::at_least(400)})
                .computed,
            "1000 Hz");
}

}  // namespace
}  // namespace sinew::report::claim_test
