// The choice among models follows its rule, and each reason of refusals is given once.
#include "sinew/identify/contest/fit.h"

#include <gtest/gtest.h>

#include "sinew/identify/contest/refusal.h"

namespace sinew::identify::fit_test {
namespace {

Fit model(const std::string& name, std::size_t parameters, double percent) {
  Fit fit{.model = name};
  fit.parameters.resize(parameters);
  fit.fit.rmse_percent = percent;
  return fit;
}

std::string message(const Report& report, double percent) {
  try {
    Report r = report;
    choose(r);
    refuse_unexplained(r, percent, "something else");
  } catch (const Refusal& e) {
    return e.what();
  }
  return "none";
}

TEST(Choice, IsTheFewestParametersAmongTheGoodOnes) {
  Report r{.fits = {model("one", 1, 2.0), model("two", 2, 1.05), model("five", 5, 1.0)}};
  choose(r);
  EXPECT_EQ(r.best().model, "two");
  choose(r, 0.01);
  EXPECT_EQ(r.best().model, "five");
  choose(r, 0.01, 2.5);  // all errors are negligible
  EXPECT_EQ(r.best().model, "one");
  r.fits[1].refused = "for a reason";
  choose(r);
  EXPECT_EQ(r.best().model, "five");
}

// The scatter is 1 % for pressures and 3 % for lengths, in all laws: halving the first counts, and
// a simpler law with the same mean is not chosen if it loses that.
TEST(Choice, CountsEveryKindOfPartsByItsOwnScatter) {
  Report r{.fits = {model("two", 2, 2.2), model("three", 3, 2.2), model("four", 4, 2.2)}};
  for (Fit& fit : r.fits) fit.cross_validated = fit.fit;
  r.fits[0].kinds = {1.0, 3.0};
  r.fits[1].kinds = {0.5, 3.1};
  r.fits[2].kinds = {0.48, 3.05};
  choose(r);
  EXPECT_EQ(r.best().model, "three");
  r.fits[1].kinds = {0.65, 2.35};  // the same mean, but lengths at the cost of pressures
  choose(r);
  EXPECT_EQ(r.best().model, "four");
  r.fits[0].kinds = {1e-9, 1.5};  // an exact fit of one kind does not decide alone
  r.fits[1].kinds = {1e-12, 1.5};
  choose(r);
  EXPECT_EQ(r.best().model, "two");
}

TEST(Choice, ReportsHowCloseTheNextOnesAre) {
  Report r{.fits = {model("one", 1, 3.0), model("two", 2, 1.05), model("five", 5, 1.0),
                    model("six", 6, 1.26), model("seven", 7, 9)}};
  choose(r);
  EXPECT_NE(r.rule.find("two has 2 and 1.05 %, the smallest is 1 % (five); next: five 0.95 times "
                        "its error, six 1.20 times its error, one 2.86 times its error"),
            std::string::npos)
      << r.rule;
}

// A law with a parameter at the end of its range is another law, or is not determined.
TEST(Choice, LeavesOutWhatStandsAtItsBounds) {
  Report r{.fits = {model("one", 1, 2.0), model("two", 2, 1.0)}};
  r.fits[1].parameters[0] = {.name = "gain", .at_bound = true};
  Fit free_of_it = r.fits[1];
  keep_off_bounds(free_of_it, std::vector<std::string_view>{"gain"});
  EXPECT_EQ(free_of_it.not_chosen, "");
  keep_off_bounds(r.fits[1]);
  EXPECT_EQ(r.fits[1].not_chosen, "gain at the bound of its range");
  choose(r);
  EXPECT_EQ(r.best().model, "one");
  EXPECT_TRUE(r.warnings.empty());

  r.fits[0].not_chosen = "slope at the bound of its range";
  choose(r);  // the only choice, with a warning
  EXPECT_EQ(r.best().model, "two");
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_EQ(r.warnings[0],
            "no law is free of a reason not to choose it; two: gain at the bound of its range");
}

TEST(Choice, RefusesWhenNothingIsLeftAndReportsEachReasonOnce) {
  Report r{.subject = "law", .fits = {model("a", 1, 1), model("b", 2, 1), model("c", 3, 1)}};
  r.fits[0].refused = r.fits[2].refused = "one length only";
  r.fits[1].refused = "no mesh";
  EXPECT_EQ(message(r, 10),
            "law: found no model that the data support: one length only (a, c); no mesh (b); "
            "expected data that determine the simplest of them");
}

TEST(Choice, RefusesWhatNoModelExplains) {
  const Report r{
      .subject = "law", .full_scale_is = "the largest force", .fits = {model("a", 1, 20)}};
  EXPECT_EQ(message(r, 25), "none");
  EXPECT_EQ(message(r, 15),
            "law: found 20 % of the largest force that the best model, a, does not explain; "
            "expected at most 15 %; try something else");
}

}  // namespace
}  // namespace sinew::identify::fit_test
