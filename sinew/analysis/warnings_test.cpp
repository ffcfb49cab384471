#include "sinew/analysis/warnings.h"

#include <gtest/gtest.h>

#include "sinew/analysis/record/test_log.h"
#include "sinew/analysis/summary.h"

namespace sinew::analysis::warnings_test {
namespace {

using test::constant;
using test::Log;

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

Machine machine() {
  Machine m = test::walking_leg();
  m.robot.sensors = {{.name = "hip_angle", .kind = robot::Sensor::Kind::angle, .of = "hip"},
                     {.name = "force", .kind = robot::Sensor::Kind::tension, .of = "x"},
                     {.name = "volt", .kind = robot::Sensor::Kind::fixed}};
  return m;
}

TEST(Warnings, OfAnUneventfulLogAreNone) {
  const Log log = test::walk(2).scalar("/sensor/hip_angle/count", constant(2000));
  EXPECT_TRUE(warnings(log.table, machine()).empty());
  EXPECT_TRUE(warnings({}, machine()).empty());
}

TEST(Warnings, OfTheStandKnowThatNothingIsConvertedAtFirst) {
  Log log(100);
  log.scalar("/sensor/length/count", [](double t) { return t < 0.205 ? 0.0 : 1200.0; });
  EXPECT_TRUE(clipped_transducers(log.table).empty());
  log.scalar("/sensor/force/count", [](double t) { return t < 0.205 ? 0.0 : t < 0.5 ? 9.0 : 0.0; });
  log.scalar("/sensor/pressure/count", [](double t) { return t < 0.5 ? 4095.0 : 100.0; });
  log.scalar("/sensor/dead/count", constant(0));
  log.scalar("/sensor/vented/count", constant(0)).scalar("/sensor/vented/value", constant(0));
  log.table.series.back().topic.fields[0].unit = "Pa";
  const auto found = clipped_transducers(log.table);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].text, "force: 50 of 100 samples at the converter's end");
  EXPECT_EQ(found[1].text, "pressure: 50 of 100 samples at the converter's end");
  EXPECT_EQ(found[2].text, "dead: 100 of 100 samples at the converter's end");
}

TEST(Warnings, OfClippingKnowThatASlackMuscleReadsZero) {
  Log log(100);
  const auto low_then_high = [](double t) {
    return t < 0.2995 ? 0.0 : t < 0.4995 ? 100.0 : 4095.0;
  };
  for (const char* sensor : {"hip_angle", "force", "volt"})
    log.scalar(std::string("/sensor/") + sensor + "/count", low_then_high);
  const auto found = clipped_sensors(log.table, machine().robot);
  ASSERT_EQ(found.size(), 2u) << "what does not move is never clipped";
  EXPECT_EQ(found[0].text, "hip_angle: 80 of 100 samples at the converter's end");
  EXPECT_EQ(found[1].text, "force: 50 of 100 samples at the converter's end");
  ASSERT_EQ(found[0].spans.size(), 2u);
  EXPECT_NEAR(found[0].spans[0].to, 0.29, 1e-9);
  EXPECT_NEAR(found[0].spans[1].from, 0.5, 1e-9);
}

TEST(Warnings, OfTimesLessThanATenthOfASecondApartAreOne) {
  Log log(300);
  log.scalar("/plan/unreachable", [](double t) {
    const bool first = t > 0.995 && t<1.025, soon = t> 1.095 && t < 1.105;
    const bool later = t > 1.995 && t < 2.005;
    return first || soon || later ? 1.0 : 0.0;
  });
  const auto found = unreachable_targets(log.table, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(has(found[0].text, "5 of 300 samples")) << found[0].text;
  ASSERT_EQ(found[0].spans.size(), 2u);
  EXPECT_NEAR(found[0].spans[0].from, 1.0, 1e-9);
  EXPECT_NEAR(found[0].spans[0].to, 1.1, 1e-9);
}

TEST(Warnings, DistinguishASaturatedDutyFromAHighOne) {
  Machine m = machine();
  ASSERT_FALSE(m.robot.muscles.empty());
  const std::string name = m.robot.muscles[0].name;
  Log log(10);
  log.scalar("/muscle/" + name + "/inlet_duty", constant(0.99))
      .scalar("/muscle/" + name + "/exhaust_duty", [](double t) { return t < 0.035 ? 1.0 : 0.0; });
  const auto found = saturated_duties(log.table, m.robot);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(has(found[0].text, name + ": the exhaust stays open all the time in 4 of 10"))
      << found[0].text;
}

TEST(Warnings, BearADutyThatAJumpSaturatesForATenthOfTheTime) {
  const Machine m = machine();
  Log log(100);
  log.scalar("/muscle/" + m.robot.muscles[0].name + "/inlet_duty",
             [](double t) { return t < 0.095 ? 1.0 : 0.0; });
  EXPECT_TRUE(saturated_duties(log.table, m.robot).empty());
}

TEST(Warnings, SpeakOfOneAndOfMany) {
  const Machine m = machine();
  Log log(10);
  log.scalar("/sensor/hip_angle/rejected", constant(1)).scalar("/low_level/gaps", constant(2));
  EXPECT_EQ(implausible_sensors(log.table, m.robot)[0].text,
            "hip_angle: 1 reading was not accepted; the last good ones were used");
  EXPECT_EQ(rejected_commands(log.table)[0].text, "2 ticks came later than announced");
}

TEST(Warnings, AreInTheSummaryAsTheyAreReported) {
  const Log log = test::walk(1).scalar("/plan/unreachable", constant(1));
  EXPECT_EQ(summarize(log.table, machine()).warnings, texts(warnings(log.table, machine())));
  EXPECT_EQ(summarize(log.table, machine()).warnings.size(), 1u);
}

TEST(Warnings, CountOverrunsThatAreLoggedAsASum) {
  Log log(100);
  log.scalar("/low_level/overruns", [](double t) {
    return t < 0.255 ? 0.0 : t < 0.505 ? 3.0 : 7.0;
  });
  const auto found = overruns(log.table);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(has(found[0].text, "7 laws")) << found[0].text;
  ASSERT_EQ(found[0].spans.size(), 2u);
  EXPECT_NEAR(found[0].spans[0].from, 0.26, 1e-9);
}

TEST(Warnings, ReportALogThatWasCutAndRollersInTheAir) {
  Log log = test::walk(1).scalar("/true/roller/front/load",
                                 [](double t) { return t < 0.095 ? -1.0 : 1.0; });
  log.table.complete = false;
  ASSERT_EQ(cut_logs(log.table).size(), 1u);
  EXPECT_TRUE(has(cut_logs(log.table)[0].text, "cut off"));
  const auto found = warnings(log.table, machine());
  ASSERT_EQ(found.size(), 1u) << "a summary has a key for a log that was cut";
  EXPECT_EQ(found[0].text, "the front roller lifts off the track in 10 of 100 samples");
}

}  // namespace
}  // namespace sinew::analysis::warnings_test
