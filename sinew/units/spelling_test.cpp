// A spelling of a unit has the same meaning as Sinew's own, or is refused.
#include "sinew/units/spelling.h"

#include <gtest/gtest.h>

namespace sinew::units::spelling_test {
namespace {

std::string first(std::string_view unit) {
  const std::vector<Spelling> all = spellings(unit);
  return all.empty() ? "nothing" : all.front().unit;
}

TEST(Spelling, OfLaboratoriesIsUnderstood) {
  const std::pair<const char*, const char*> cases[] = {{"psig", "psi gauge"},
                                                       {"PSIG", "psi gauge"},
                                                       {"psia", "psi abs"},
                                                       {"psid", "psi diff"},
                                                       {"barg", "bar gauge"},
                                                       {"bara", "bar abs"},
                                                       {"bar(g)", "bar gauge"},
                                                       {"Bar", "bar"},
                                                       {"BAR", "bar"},
                                                       {"bar rel.", "bar gauge"},
                                                       {"barü", "bar gauge"},
                                                       {"kPag", "kPa gauge"},
                                                       {"kPa(a)", "kPa abs"},
                                                       {"MPa(g)", "MPa gauge"},
                                                       {"MPa g", "MPa gauge"},
                                                       {"PSI", "psi"},
                                                       {"kpa", "kPa"},
                                                       {"Mpa", "MPa"},
                                                       {"lbin", "lbf in"},
                                                       {"lb-in", "lbf in"},
                                                       {"lbf·in", "lbf in"},
                                                       {"in-lb", "lbf in"},
                                                       {"ft-lb", "lbf ft"},
                                                       {"lbf-ft", "lbf ft"},
                                                       {"Nm", "N m"},
                                                       {"N·m", "N m"},
                                                       {"N*m", "N*m"},
                                                       {"N-m", "N m"},
                                                       {"Ncm", "N cm"},
                                                       {"Nm/rad", "nothing"},
                                                       {"N·m/rad", "N m/rad"},
                                                       {"°", "deg"},
                                                       {"Degrees", "deg"},
                                                       {"°/s", "deg/s"},
                                                       {"°C", "degC"},
                                                       {"deg C", "nothing"},
                                                       {"µs", "us"},
                                                       {"μs", "us"},
                                                       {"sec", "s"},
                                                       {"Sek", "s"},
                                                       {"msec", "ms"},
                                                       {"mm²", "mm2"},
                                                       {"mm^2", "mm2"},
                                                       {"m/s²", "m/s2"},
                                                       {"m/s^2", "m/s2"},
                                                       {"cm³", "cm3"},
                                                       {"l/min", "L/min"},
                                                       {"inch", "in"},
                                                       {"Inches", "in"},
                                                       {"\"", "in"},
                                                       {"Zoll", "in"},
                                                       {"U/min", "rpm"},
                                                       {"RPM", "rpm"},
                                                       {"1/min", "1/min"},
                                                       {"min-1", "1/min"},
                                                       {"rad/sec", "rad/s"},
                                                       {"Volt", "V"},
                                                       {"counts", "count"},
                                                       {"LSB", "count"},
                                                       {"-", "1"},
                                                       {"Prozent", "%"},
                                                       {"[N]", "N"},
                                                       {" N ", "N"},
                                                       {"lbs", "nothing"},
                                                       {"pounds", "nothing"},
                                                       {"mpa", "nothing"},
                                                       {"NL/min", "nothing"},
                                                       {"furlong", "nothing"},
                                                       {"", "nothing"},
                                                       {"C", "nothing"},
                                                       {"Grad", "nothing"}};
  for (const auto& [theirs, ours] : cases) EXPECT_EQ(first(theirs), ours) << theirs;
}

TEST(Spelling, AUnitThatSinewLacksHasAFactor) {
  const std::tuple<const char*, const char*, double> cases[] = {{"mbar", "bar", 1e-3},
                                                                {"hPa", "Pa", 100},
                                                                {"mbarg", "bar gauge", 1e-3},
                                                                {"kgf", "N", 9.80665},
                                                                {"kp", "N", 9.80665},
                                                                {"daN", "N", 10},
                                                                {"mN", "N", 1e-3},
                                                                {"MN", "kN", 1e3},
                                                                {"nm", "mm", 1e-6},
                                                                {"kp/cm²", "Pa", 98066.5},
                                                                {"mmHg", "Pa", 133.322387415}};
  for (const auto& [theirs, ours, factor] : cases) {
    const std::vector<Spelling> all = spellings(theirs);
    ASSERT_FALSE(all.empty()) << theirs;
    EXPECT_EQ(all.front().unit, ours) << theirs;
    EXPECT_DOUBLE_EQ(all.front().factor, factor) << theirs;
  }
}

TEST(Spelling, TurnsInAMinuteAreAFrequencyOrASpeed) {
  const std::vector<Spelling> all = spellings("1/min");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[1].unit, "rpm");
}

TEST(Spelling, OurOwnComesBackAsItIs) {
  for (const char* unit : {"psi gauge", "N m/rad", "lbf in s/rad", "1", "%", "MPa abs", "count"}) {
    EXPECT_TRUE(is_unit(unit)) << unit;
    EXPECT_EQ(first(unit), unit);
    EXPECT_EQ(spellings(unit).front().factor, 1);
  }
  EXPECT_FALSE(is_unit("m gauge"));
  EXPECT_FALSE(is_unit("psig"));
}

}  // namespace
}  // namespace sinew::units::spelling_test
