// Bands follow from the wording alone.
#include "sinew/analysis/verdict/band.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sinew::analysis::band_test {
namespace {

void expect(const Band& band, double lowest, double highest) {
  EXPECT_NEAR(band.lowest, lowest, 1e-9);
  EXPECT_NEAR(band.highest, highest, 1e-9);
}

// Half of the last digit decides for short numbers, 5 % for long ones.
TEST(Band, AMeasuredNumberIsAsSureAsItsLastDigitOrItsBench) {
  expect(measured(3, 1), 2.5, 3.5);
  expect(measured(30, 1), 28.5, 31.5);
  expect(measured(0.0044, 0.0001), 0.00418, 0.00462);
  expect(measured(-13, 1, 0.1), -13.75, -12.25);
  expect(measured(0, 1), -0.5, 0.5);
}

// A reported 2 % does not agree with 0 %.
TEST(Band, APercentageHasTwoPointsAtMostAQuarter) {
  expect(percentage(94), 92, 96);
  expect(percentage(2), 1.5, 2.5);
  expect(percentage(0), 0, 0);
  EXPECT_FALSE(percentage(2).holds(0));
}

TEST(Band, WordsWithoutANumberAreSharesOfTheRange) {
  expect(about(90), 81, 99);
  expect(negligible(44), -2.2, 2.2);
  EXPECT_EQ(noticeable(100).lowest, 5);
  EXPECT_EQ(substantial(100).lowest, 20);
  expect(small(100), -20, 20);
  EXPECT_NEAR(much_less(44).highest, 35.2, 1e-9);
  EXPECT_NEAR(much_more(10).lowest, 12, 1e-9);
  EXPECT_TRUE(std::isinf(much_more(10).highest));
  // Each value is either negligible or noticeable.
  for (double x : {0.0, 1.0, 2.19, 2.21, 9.0})
    EXPECT_NE(negligible(44).holds(x), noticeable(44).holds(x)) << x;
}

TEST(Band, EndsBelongToItAndNoNumberToNone) {
  EXPECT_TRUE(range(55, 60).holds(55) && range(55, 60).holds(60));
  EXPECT_TRUE(at_most(5).holds(-1e9) && at_least(5).holds(1e9));
  EXPECT_TRUE(measured(0.3, 0.1).holds(0.35)) << "half a digit, though 0.35 is no binary fraction";
  EXPECT_FALSE(Band{}.holds(std::nan("")));
  EXPECT_FALSE(computed(2.8363, 1e-4).holds(2.83636));
  EXPECT_TRUE(computed(2.8363, 1e-4).holds(2.83635));
}

TEST(Band, EachWordingHasItsRule) {
  for (const auto& w : config::wordings) EXPECT_NE(rule_of(w.value), "another band") << w.word;
}

TEST(Band, NumbersAreTakenFromTheText) {
  const auto expect_words = [](const char* words, double lowest, double highest, double digit,
                               const char* unit) {
    const QuotedNumber s = quoted_number(words);
    ASSERT_TRUE(s.found) << words;
    EXPECT_EQ(s.lowest, lowest) << words;
    EXPECT_EQ(s.highest, highest) << words;
    EXPECT_DOUBLE_EQ(s.last_digit, digit) << words;
    EXPECT_EQ(s.unit, unit) << words;
  };
  const double inf = std::numeric_limits<double>::infinity();
  expect_words("94 %", 94, 94, 1, "%");
  expect_words("55 to 60 in", 55, 60, 1, "in");
  expect_words("60 to 55 in", 55, 60, 1, "in");
  expect_words("-13 in", -13, -13, 1, "in");
  expect_words("1.56 rad/s", 1.56, 1.56, 0.01, "rad/s");
  expect_words("98.70 psi gauge", 98.7, 98.7, 0.01, "psi gauge");
  expect_words("1.8e-5 ft2", 1.8e-5, 1.8e-5, 1e-6, "ft2");
  expect_words("below 0.5", -inf, 0.5, 0.1, "");
  expect_words("at least 60 in", 60, inf, 1, "in");
  EXPECT_FALSE(quoted_number("much smaller").found);
  EXPECT_FALSE(quoted_number("").found);
}

}  // namespace
}  // namespace sinew::analysis::band_test
