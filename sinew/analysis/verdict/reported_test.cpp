#include "sinew/analysis/verdict/reported.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "sinew/config/diagnostics.h"

namespace sinew::analysis::reported_test {
namespace {

constexpr double inch = 0.0254, degree = std::numbers::pi / 180;

Verdict verdict(std::string key, double value_of_run, std::string value,
                std::vector<std::string> accept) {
  Summary s;
  s.add(key, value_of_run);
  return compare(s, {{key, std::move(value), std::move(accept), "6.3"}}).at(0);
}

std::string message(const Reported& r) {
  try {
    (void)compare({}, {r});
  } catch (const config::Error& e) {
    return e.what();
  }
  return "";
}

TEST(Reported, UnitFollowsFromTheEndOfTheKey) {
  EXPECT_EQ(unit_of_key("trolley.distance_m"), "m");
  EXPECT_EQ(unit_of_key("trolley.mean_speed_m_per_s"), "m/s");
  EXPECT_EQ(unit_of_key("joints.hip.min_angle_rad"), "rad");
  EXPECT_EQ(unit_of_key("muscles.hip_flexor.peak_tension_N"), "N");
  EXPECT_EQ(unit_of_key("joints.hip.peak_torque_Nm"), "N m");
  EXPECT_EQ(unit_of_key("joints.hip.stiffness_mean_Nm_per_rad"), "N m/rad");
  EXPECT_EQ(unit_of_key("air_used_kg"), "kg");
  EXPECT_EQ(unit_of_key("air_used_kg_per_m"), "kg/m");
  EXPECT_EQ(unit_of_key("valves.switchings_per_m"), "1/m");
  EXPECT_EQ(unit_of_key("foot.extension_time_s"), "s");
  EXPECT_EQ(unit_of_key("sensors.hip_angle.mean_count"), "count");
  EXPECT_EQ(unit_of_key("joints.hip.velocity_jump_rms_rad_per_s"), "rad/s");
  EXPECT_EQ(unit_of_key("phases.hold.muscles.knee_flexor.end_pressure_Pa"), "Pa abs");
  EXPECT_EQ(unit_of_key("passiveness"), "1");
}

TEST(Reported, OursIsShownInTheUnitOfTheSource) {
  EXPECT_EQ(verdict("trolley.distance_m", 57.68 * inch, "55 to 60 in", {}).computed, "57.7 in");
  EXPECT_EQ(verdict("trolley.mean_speed_m_per_s", 4.612 * inch, "4.5 in/s", {}).computed,
            "4.6 in/s");
  EXPECT_EQ(verdict("passiveness", 0.9312, "94 %", {}).computed, "93.1 %");
  EXPECT_EQ(verdict("a_rad", 249.24 * degree, "249 deg", {}).computed, "249.2 deg");
  EXPECT_EQ(verdict("a_Pa", 101352.9322095749, "0 psi gauge", {}).computed, "0 psi gauge");
  EXPECT_EQ(verdict("a_Pa", 790827.07, "100 psi gauge", {}).computed, "100.0 psi gauge");
  EXPECT_EQ(verdict("a_kg", 0.000123456, "0.1 g", {}).computed, "0.12 g");
  EXPECT_EQ(verdict("valves.switchings", 4513, "about 4500", {}).computed, "4513");
  // If the text has no usable unit, that of the band is used, else SI.
  EXPECT_EQ(verdict("a_m", 2 * inch, "two inches", {"1 in", "3 in"}).computed, "2.0 in");
  EXPECT_EQ(verdict("a_m", 1.5, "as far as the wall", {}).computed, "1.5 m");
}

TEST(Reported, TheBandDecides) {
  const std::vector<std::string> band = {"53 in", "60 in"};
  using Agreement = Verdict::Agreement;
  EXPECT_EQ(verdict("d_m", 53 * inch, "55 in", band).agreement, Agreement::agrees);
  EXPECT_EQ(verdict("d_m", 1.524, "55 in", band).agreement, Agreement::agrees);
  EXPECT_EQ(verdict("d_m", 60.1 * inch, "55 in", band).agreement, Agreement::differs);
  EXPECT_EQ(verdict("d_m", 52.9 * inch, "55 in", band).agreement, Agreement::differs);
  EXPECT_EQ(verdict("d_m", 57 * inch, "55 in", band).accept, "53 in to 60 in");
  EXPECT_EQ(to_text(Agreement::agrees), "agrees");
  EXPECT_EQ(to_text(Agreement::differs), "differs");
  EXPECT_EQ(to_text(Agreement::differs_as_known), "differs as known");
}

TEST(Reported, NoKeyOrNoBandIsNotJudged) {
  const Verdict absent = compare({}, {{"d_m", "55 in", {"53 in", "60 in"}, "6.3"}}).at(0);
  EXPECT_EQ(absent.agreement, Verdict::Agreement::not_applicable);
  EXPECT_EQ(absent.computed, "");
  const Verdict open = verdict("d_m", 1, "55 in", {});
  EXPECT_EQ(open.agreement, Verdict::Agreement::not_applicable);
  EXPECT_EQ(open.computed, "39.4 in");
}

TEST(Reported, WhatCannotBeABandIsAnError) {
  EXPECT_NE(message({"trolley.distance_m", "5 ft", {"53 lb", "60 lb"}, ""})
                .find("trolley.distance_m: accept: found \"53 lb\""),
            std::string::npos);
  EXPECT_NE(message({"d_m", "", {"53", "60 in"}, ""}).find("53 without a unit"), std::string::npos);
  EXPECT_NE(message({"d_m", "", {"53 in"}, ""}).find("the lowest and the highest"),
            std::string::npos);
  EXPECT_NE(message({"d_m", "", {"60 in", "53 in"}, ""}).find("the lowest first"),
            std::string::npos);
  EXPECT_NE(message({"p_Pa", "", {"1 psi", "2 psi"}, ""}).find("gauge"), std::string::npos);
}

TEST(Reported, GaugePressuresKnowTheAtmosphere) {
  Summary s;
  s.add("a_Pa", 100000);
  const Reported r{"a_Pa", "0 Pa gauge", {"-1 Pa gauge", "1 Pa gauge"}, ""};
  EXPECT_EQ(compare(s, {r}, 100000).at(0).agreement, Verdict::Agreement::agrees);
  EXPECT_EQ(compare(s, {r}, 101325).at(0).agreement, Verdict::Agreement::differs);
}

// A reason makes a difference a known one. Agreement in spite of a reason is reported too.
TEST(Reported, AKnownDifferenceHasItsReason) {
  Summary s;
  s.add("d_m", 1.0);
  Reported r{.key = "d_m", .value = "2 m", .accept = {"1.9 m", "2.1 m"}, .source = "6.3"};
  r.because = "the foot slips";
  const Verdict known = compare(s, {r}).at(0);
  EXPECT_EQ(known.agreement, Verdict::Agreement::differs_as_known);
  EXPECT_EQ(known.source, "6.3. Why: the foot slips");
  r.accept = {"0.9 m", "1.1 m"};
  EXPECT_EQ(compare(s, {r}).at(0).agreement, Verdict::Agreement::agrees_unexpectedly);
}

// The band follows from the wording, in the source's unit.
TEST(Reported, ABandFollowsFromTheWording) {
  using config::StatementClass, config::Wording;
  Summary s;
  s.add("d_m", 1.43);
  s.add("share", 0.955);
  s.add("p_Pa", 101325 + 6894.757 * 57.1);
  Reported r{.key = "d_m", .value = "55 to 60 in", .source = "6.3"};
  r.statement_class = StatementClass::fitted;
  r.wording = Wording::range;
  Verdict v = compare(s, {r}).at(0);
  EXPECT_EQ(v.agreement, Verdict::Agreement::agrees);
  EXPECT_EQ(v.accept, "55 in to 60 in");
  EXPECT_EQ(v.statement_class, StatementClass::fitted);
  r.value = "60 in";
  r.wording = Wording::measured;
  EXPECT_EQ(compare(s, {r}).at(0).agreement, Verdict::Agreement::differs);  // the lowest is 57 in
  r.reading_error = "1 in";
  EXPECT_EQ(compare(s, {r}).at(0).accept, "56 in to 64 in");
  EXPECT_EQ(compare(s, {r}).at(0).agreement, Verdict::Agreement::agrees);
  r = {.key = "share", .value = "94 %", .source = "6.3"};
  r.wording = Wording::percentage;
  EXPECT_EQ(compare(s, {r}).at(0).accept, "92 % to 96 %");
  EXPECT_EQ(compare(s, {r}).at(0).agreement, Verdict::Agreement::agrees);
  r = {.key = "p_Pa", .value = "60 psi gauge", .source = "3.4"};
  r.wording = Wording::measured;  // 5 % of the gauge pressure, not of the absolute one
  EXPECT_EQ(compare(s, {r}).at(0).agreement, Verdict::Agreement::agrees);
  r = {.key = "d_m", .value = "much smaller", .source = "6.5"};
  r.wording = Wording::much_less;
  r.of = "1.8 m";
  EXPECT_EQ(compare(s, {r}).at(0).accept, "at most 1.44 m");
  EXPECT_EQ(compare(s, {r}).at(0).agreement, Verdict::Agreement::agrees);
}

TEST(Reported, AWordingNeedsItsNumber) {
  using config::Wording;
  const auto with = [](const char* key, const char* value, Wording wording, const char* of = "") {
    Reported r{.key = key, .value = value};
    r.wording = wording;
    r.of = of;
    return message(r);
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(with("d_m", "as far as the wall", Wording::measured),
              HasSubstr("a number in `value`"));
  EXPECT_THAT(with("d_m", "much", Wording::much_more), HasSubstr("of = a quantity"));
  EXPECT_THAT(with("d_m", "60 lb", Wording::measured), HasSubstr("d_m: wording: found \"60 lb\""));
  EXPECT_THAT(with("d_m", "60 in", Wording::range), HasSubstr("two numbers with \"to\""));
  EXPECT_THAT(with("share", "0.94", Wording::percentage), HasSubstr("a value in %"));
}

// The source does not describe a run that was changed with --set, so that it is not judged.
TEST(Reported, IsNotJudgedWhereTheRunWasChanged) {
  const std::string experiment = "[load]\nmass = \"5 lb\"\n", kept = "source = \"--set\"\n";
  Summary summary;
  summary.add("d_m", 1);
  for (const char* lowest : {"1 m", "2 m"}) {
    std::vector<Reported> reported = {{"d_m", "1 m", {lowest, "3 m"}, "6.3"}};
    mark_changed(reported, config::parse_text(experiment, "a.toml"));
    EXPECT_NE(compare(summary, reported).at(0).agreement, Verdict::Agreement::not_applicable);
    for (const char* same : {"title = 'mine'\n", "seed = 7\n", "[log]\nperiod = 1\n"}) {
      mark_changed(reported, config::parse_text(same, "--set"));
      EXPECT_NE(compare(summary, reported).at(0).agreement, Verdict::Agreement::not_applicable)
          << same;
    }
    for (const std::string& changed : {experiment, "[page]\ntitle = 'mine'\n" + experiment,
                                       "[phase.up]\ntitle = 'mine'\n" + experiment}) {
      mark_changed(reported, config::parse_text(changed, "--set"));
      EXPECT_EQ(compare(summary, reported).at(0).agreement, Verdict::Agreement::not_applicable)
          << changed;
    }
    mark_changed(reported, config::parse_text(experiment + kept, "resolved.toml"));
    EXPECT_EQ(compare(summary, reported).at(0).agreement, Verdict::Agreement::not_applicable);
  }
}

}  // namespace
}  // namespace sinew::analysis::reported_test
