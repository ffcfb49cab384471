// units/short_quantity_test.cpp - digits caused by conversion are not shown, and no bit is lost.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sinew/units/quantity.h"

namespace sinew::units::short_quantity_test {
namespace {

double read(std::string_view text, std::string_view unit) {
  const Parsed parsed = parse_quantity(text, unit);
  return parsed.mistake ? std::nan("") : parsed.si;
}

TEST(ShortQuantity, IsWhatWasWrittenWhereSIHasDigitsOfItsOwn) {
  EXPECT_EQ(format_quantity(read("0.035 %/count", "1/count"), "1/count"),
            "0.00035000000000000005 1/count");
  EXPECT_EQ(short_quantity(read("0.035 %/count", "1/count"), "1/count"), "0.035 %/count");
  EXPECT_EQ(short_quantity(read("278 deg", "rad"), "rad"), "278 deg");
  EXPECT_EQ(short_quantity(read("100 psi abs", "Pa abs"), "Pa abs"), "100 psi abs");
}

TEST(ShortQuantity, IsWhatWasWrittenInAUnitOfMixedWords) {
  EXPECT_EQ(format_quantity(read("263.4 kg mm2", "kg m2"), "kg m2"),
            "0.00026339999999999995 kg m2");
  EXPECT_EQ(short_quantity(read("263.4 kg mm2", "kg m2"), "kg m2"), "263.4 kg mm2");
  EXPECT_EQ(short_quantity(read("0.9 lb in2", "kg m2"), "kg m2"), "0.9 lb in2");
  EXPECT_EQ(short_quantity(read("6.3 N mm/deg", "N m/rad"), "N m/rad"), "6.3 N mm/deg");
}

TEST(ShortQuantity, ReadsBackToTheSameBits) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(0.001, 999);
  const char* units[] = {"1",      "m",       "m3",  "1/count", "s/count",
                         "Pa abs", "Pa diff", "rad", "N m/rad", "kg m2"};
  for (const char* unit : units)
    for (int i = 0; i < 2000; ++i) {
      // Usual values, and any double.
      const double short_one = std::round(number(random) * 100) / 100;
      for (const std::string& other : usual_units(unit)) {
        const double si = read(format_number(short_one) + (other == "1" ? "" : " " + other), unit);
        EXPECT_EQ(read(short_quantity(si, unit), unit), si) << unit << " " << other;
      }
      const double any = number(random);
      EXPECT_EQ(read(short_quantity(any, unit), unit), any) << unit;
    }
}

TEST(ShortQuantity, WhatIsShortInSIStaysSI) {
  EXPECT_EQ(short_quantity(0.08001, "m"), "0.08001 m");
  EXPECT_EQ(short_quantity(0.55, "1"), "0.55");
  EXPECT_EQ(short_quantity(0, "Pa abs"), "0 Pa abs");
}

TEST(RoundedQuantity, HasNoDigitsThatNobodyWrote) {
  EXPECT_EQ(rounded_quantity(read("0.035 %/count", "1/count"), "1/count"), "0.00035 1/count");
  EXPECT_EQ(rounded_quantity(0.1 + 0.2, "m"), "0.3 m");
  EXPECT_EQ(rounded_quantity(1.0 / 3, "m"), "0.333333333333333 m");
}

TEST(Digits, AreTheRequestedOnes) {
  EXPECT_EQ(with_digits(3.16713958, 4), 3.167);
  EXPECT_EQ(with_digits(-1234567.0, 3), -1230000.0);
  EXPECT_EQ(with_digits(2.61773e-6, 10), 2.61773e-6);
  EXPECT_EQ(with_digits(0, 4), 0);
  EXPECT_TRUE(std::isinf(with_digits(std::numeric_limits<double>::infinity(), 4)));
}

TEST(QuantityLike, SpeaksInTheUnitThatSomebodyWrote) {
  EXPECT_EQ(quantity_like("80 mm", 0.127, "m", "in"), "127 mm");
  EXPECT_EQ(quantity_like("3.2in", 0.127, "m", "mm"), "5 in");
  EXPECT_EQ(quantity_like("", 0.127, "m", "in"), "5 in");
  EXPECT_EQ(quantity_like("rest", 0.127, "m", "in"), "5 in");
  EXPECT_EQ(quantity_like("4 bar gauge", 1e5 + 2e5, "Pa abs", "psi abs", 1e5), "2 bar gauge");
}

}  // namespace
}  // namespace sinew::units::short_quantity_test
