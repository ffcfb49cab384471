// Conversion from text to SI and back, and the messages if it fails.
#include "sinew/units/quantity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sinew/units/literals.h"

namespace sinew::units::quantity_test {
namespace {

using namespace literals;

double read(std::string_view text, std::string_view unit) {
  const Parsed parsed = parse_quantity(text, unit);
  EXPECT_FALSE(parsed.mistake) << text;
  return parsed.si;
}

std::string message(std::string_view text, std::string_view unit) {
  const auto m = parse_quantity(text, unit).mistake;
  return m ? to_text(*m) : "no error";
}

TEST(Quantity, ReadsWhatTheLegFilesWrite) {
  EXPECT_EQ(read("3.250 in", "m"), 3.25_in);
  EXPECT_EQ(read("5.724e-6 ft2", "m2"), 5.724e-6_ft2);
  EXPECT_EQ(read("0.240 in3", "m3"), 0.24_in3);
  EXPECT_EQ(read("278 deg", "rad"), 278.0_deg);
  EXPECT_EQ(read("528 degR", "K"), 528.0_degR);
  EXPECT_DOUBLE_EQ(read("20 degC", "K"), 293.15);
  EXPECT_DOUBLE_EQ(read("0.9 %/count", "1/count"), 0.009);
  EXPECT_DOUBLE_EQ(read("6.5 %/(lbf in/rad)", "rad/(N m)"), 0.065 / (1.0_lbf * 1.0_in));
  EXPECT_DOUBLE_EQ(read("-0.00002 1/psi2", "1/Pa2"), -0.00002 / (1.0_psi * 1.0_psi));
  EXPECT_DOUBLE_EQ(read("0.57 in/V", "m/V"), 0.57_in);
  EXPECT_DOUBLE_EQ(read("10.36 lb in2", "kg m2"), 10.36_lb * 1.0_in2);
  EXPECT_EQ(read("55 %", "1"), 0.55);
  EXPECT_EQ(read("-0.2571", "1"), -0.2571);
  EXPECT_EQ(read(" +3mm ", "m"), 0.003);
}

TEST(Quantity, GaugeAndAbsoluteConvertWithTheAtmosphere) {
  EXPECT_EQ(read("62 psi gauge", "Pa abs"), 62.0_psi + atmosphere);
  EXPECT_EQ(read("14.7 psi abs", "Pa abs"), atmosphere);
  EXPECT_DOUBLE_EQ(read("14.7 psi abs", "Pa gauge"), 0);
  EXPECT_EQ(parse_quantity("1 bar gauge", "Pa abs", 90'000).si, 190'000);
  EXPECT_EQ(read("2 psi diff", "Pa diff"), 2.0_psi);
}

TEST(Quantity, APressureWithoutItsReferenceIsRefused) {
  EXPECT_EQ(message("62 psi", "Pa abs"),
            "found \"62 psi\", a pressure without its reference; expected Pa abs "
            "(pressure); try \"62 psi gauge\" or \"62 psi abs\"");
  EXPECT_EQ(message("2 psi gauge", "Pa diff"),
            "found \"2 psi gauge\"; expected Pa diff (pressure); try \"2 psi diff\"");
  EXPECT_NE(message("2 psi diff", "Pa abs").find("try \"2 psi gauge\" or"), std::string::npos);
  EXPECT_NE(message("3 in abs", "m").find("try \"3 in\""), std::string::npos);
}

TEST(Quantity, MassIsNotForce) {
  EXPECT_EQ(message("2 lb", "N"),
            "found \"2 lb\", kg (mass); expected N (force); "
            "try lbf: lb is mass, lbf is force");
  EXPECT_EQ(message("2 lbf", "kg"),
            "found \"2 lbf\", N (force); expected kg (mass); "
            "try lb: lbf is force, lb is mass");
  EXPECT_NE(message("35 lb in/rad", "N m/rad").find("try lbf"), std::string::npos);
}

TEST(Quantity, AnAngleIsADimension) {
  EXPECT_EQ(message("35 lbf in", "N m/rad"),
            "found \"35 lbf in\", N m (torque or energy); expected N m/rad (joint "
            "stiffness); try \"N m/rad\" or \"lbf in/rad\": rad counts as a dimension here");
}

TEST(Quantity, OtherMistakesSayWhatToDo) {
  EXPECT_EQ(message("3.15", "m"),
            "found 3.15 without a unit; expected m (length); try \"3.15 mm\" or "
            "\"3.15 in\"");
  EXPECT_EQ(message("3,15 in", "m"),
            "found \"3,15 in\"; expected m (length); try a decimal point: \"3.15 in\"");
  EXPECT_EQ(message("3.15 s", "m"),
            "found \"3.15 s\", s (time); expected m (length); "
            "try a quantity such as \"1 m\"");
  EXPECT_NE(message("3 ins", "m").find("unknown unit \"ins\""), std::string::npos);
  EXPECT_NE(message("3 ins", "m").find("try \"in\""), std::string::npos);
  EXPECT_NE(message("3 inches", "m").find("try \"in\""), std::string::npos);
  EXPECT_NE(message("about 3 in", "m").find("a number first"), std::string::npos);
  EXPECT_NE(message("", "m").find("a number first"), std::string::npos);
  EXPECT_NE(message("3 s", "1").find("expected a number"), std::string::npos);
}

// A suggestion is valid, and the replaced text decides its unit: 0.07 in place of 0.035 %/count is
// not 0.07 1/count, which is a hundred times as much.
TEST(Quantity, TheUnitThatIsProposedIsTheOneThatWasMeant) {
  const auto hint = [](const char* unit, const char* before) {
    return parse_quantity("0.07", unit, atmosphere, before).mistake->try_this;
  };
  EXPECT_EQ(hint("1/count", "0.035 %/count"), "\"0.07 %/count\", the unit of what stood there");
  EXPECT_EQ(hint("1/count", "0.00035 1/count"), "\"0.07 1/count\", the unit of what stood there");
  EXPECT_EQ(hint("1/count", ""), "\"0.07 %/count\" or \"0.07 1/count\"");
  EXPECT_EQ(hint("Pa abs", "62 psi gauge"), "\"0.07 psi gauge\", the unit of what stood there");
  EXPECT_EQ(hint("Pa abs", ""), "\"0.07 bar gauge\"");
  EXPECT_EQ(hint("m", "not set"), "\"0.07 m\"");
}

// A robot with muscles has no part of 164 m or 164 in.
TEST(Quantity, UnitsAreProposedInWhichTheNumberIsPlausible) {
  const auto hint = [](const char* number, const char* unit) {
    return parse_quantity(number, unit).mistake->try_this;
  };
  EXPECT_EQ(hint("164", "m"), "\"164 mm\"");
  EXPECT_EQ(hint("3.4", "m"), "\"3.4 mm\" or \"3.4 in\"");
  EXPECT_EQ(hint("0.164", "m"), "\"0.164 m\" or \"0.164 in\"");
  EXPECT_EQ(hint("-0.164", "m"), "\"-0.164 m\" or \"-0.164 in\"");
  EXPECT_EQ(hint("6", "Pa diff"), "\"6 bar diff\" or \"6 kPa diff\" or \"6 psi diff\"");
  EXPECT_EQ(hint("62", "Pa abs"),
            "\"62 kPa gauge\" or \"62 kPa abs\" or \"62 psi gauge\" or "
            "\"62 psi abs\"");
  EXPECT_EQ(hint("600000", "Pa gauge"), "\"600000 Pa gauge\"");
  EXPECT_EQ(hint("110", "m3"), "\"110 mL\" or \"110 in3\"");
  EXPECT_EQ(hint("90", "rad"), "\"90 deg\"");
  EXPECT_EQ(hint("300", "s"), "\"300 s\" or \"300 ms\"");
  // No unit is plausible: all are suggested.
  EXPECT_EQ(hint("1e5", "m"), "\"1e5 m\" or \"1e5 mm\" or \"1e5 in\"");
}

TEST(Quantity, EveryUsualUnitIsReadAsTheFieldsOwn) {
  for (const char* unit : {"m",       "s",        "N/m",         "rad",
                           "N s/m",   "kg",       "Pa diff",     "Pa abs",
                           "N",       "m3",       "count",       "1/count",
                           "s/count", "N m/rad",  "N m s/rad",   "1/(N m/rad)",
                           "m2",      "kg m2",    "V/Pa",        "V/N",
                           "V s/rad", "Pa gauge", "s/Pa",        "rad/s2",
                           "rad/s",   "rad/V",    "m3/(s Pa)",   "m/s2",
                           "m/V",     "m/N",      "kg/(s Pa)",   "count/rad",
                           "count/m", "W",        "V",           "N/m3",
                           "N/m2",    "N m",      "K",           "J/(kg K)",
                           "Hz",      "1/s",      "1/(count s)", "1/(N m s/rad)",
                           "1/m",     "1/Pa2"}) {
    const std::vector<std::string> usual = usual_units(unit);
    ASSERT_FALSE(usual.empty()) << unit;
    EXPECT_NE(std::ranges::find(usual, unit), usual.end()) << unit;
    for (const std::string& u : usual)
      EXPECT_EQ(message(("3 " + u).c_str(), unit), "no error") << u << " for " << unit;
  }
}

TEST(Quantity, HintsOfOtherSlipsAreReadToo) {
  EXPECT_NE(message("60 psig", "Pa abs").find("try \"psi gauge\""), std::string::npos);
  EXPECT_NE(message("60 bara", "Pa abs").find("try \"bar abs\""), std::string::npos);
  EXPECT_NE(message("1,000 Pa abs", "Pa abs").find("\"1.000 Pa abs\"; or \"1000 Pa abs\""),
            std::string::npos);
  EXPECT_NE(message("2 kg", "N").find("try N: kg and g are mass"), std::string::npos);
}

TEST(Quantity, IsFinite) {
  EXPECT_EQ(message("nan m", "m"), "found \"nan m\"; expected a finite number of m (length)");
  EXPECT_NE(message("inf", "1").find("a finite number"), std::string::npos);
  for (const char* text : {"1e999 m", "-1e999 m", "1e-999 m", "1e308 km"})
    EXPECT_NE(message(text, "m").find("from 1e-307 to 1e308, or 0"), std::string::npos) << text;
}

TEST(Quantity, AWrongUnitInAFieldIsOurBug) {
  EXPECT_THROW(parse_quantity("1 m", "metre"), std::logic_error);
}

TEST(Quantity, PrintingAndReadingBringBackTheSameBits) {
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-12, 12);
  for (const char* unit : {"m", "1", "N m/rad", "Pa abs", "Pa gauge", "Pa diff", "1/Pa2", "K"}) {
    for (int i = 0; i < 200; ++i) {
      const double value = mantissa(random) * std::pow(10.0, exponent(random));
      EXPECT_EQ(read(format_quantity(value, unit), unit), value) << format_quantity(value, unit);
    }
  }
  EXPECT_TRUE(std::signbit(read(format_quantity(-0.0, "m"), "m")));
}

TEST(Quantity, ShowsInTheUnitAPersonWants) {
  EXPECT_EQ(format_quantity(3.15_in, "m", "in"), "3.15 in");
  EXPECT_EQ(format_quantity(62.0_psi + atmosphere, "Pa abs", "psi gauge"), "62 psi gauge");
  EXPECT_EQ(format_quantity(0.94, "1", "%"), "94 %");
  EXPECT_THROW(convert(1, "m", "s"), std::logic_error);
}

TEST(Quantity, CoefficientsOfAPolynomialHaveFallingUnits) {
  EXPECT_EQ(coefficient_unit("1", "Pa", 0), "1");
  EXPECT_EQ(coefficient_unit("1", "Pa", 2), "1/Pa2");
  EXPECT_EQ(coefficient_unit("m", "m", 0), "m");
  EXPECT_EQ(coefficient_unit("m", "m", 1), "1");
  EXPECT_EQ(coefficient_unit("m", "m", 2), "1/m");
  EXPECT_EQ(coefficient_unit("m", "m", 3), "1/m2");
  EXPECT_EQ(coefficient_unit("N", "Pa", 1), "N/Pa");
  EXPECT_EQ(read("2 lbf/psi2", coefficient_unit("N", "Pa", 2)), read("2 lbf/psi2", "N/Pa2"));
  EXPECT_EQ(message("2 N m/(rad s2)", coefficient_unit("N m/rad", "s", 2)), "no error");
  EXPECT_EQ(message("2 (s/m) (s/m)", coefficient_unit("1", "m/s", 2)), "no error");
}

TEST(Quantity, OfAnotherSpellingIsRefusedWithTheRightOne) {
  const std::tuple<const char*, const char*, const char*> cases[] = {
      {"60 psig", "Pa abs", "\"psi gauge\""},
      {"4 barg", "Pa abs", "\"bar gauge\""},
      {"3 Nm", "N m", "\"N m\""},
      {"3 lbin", "N m", "\"lbf in\""},
      {"90 °", "rad", "\"deg\""},
      {"5 inch", "m", "\"in\""},
      {"60 PSI gauge", "Pa abs", "\"psi gauge\""},
      {"300 mbar gauge", "Pa abs", "\"bar gauge\": 1 mbar is 0.001 bar"}};
  for (const auto& [text, unit, hint] : cases) {
    const Parsed parsed = parse_quantity(text, unit);
    ASSERT_TRUE(parsed.mistake) << text;
    EXPECT_EQ(parsed.mistake->try_this, hint) << text;
  }
}

}  // namespace
}  // namespace sinew::units::quantity_test
