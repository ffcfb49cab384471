// Losses from free decays on our simulated stand: the law is recovered, its intervals have the
// stated coverage, and unusable records are refused.
#include "sinew/identify/motion/dynamic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "sinew/actuator/thesis_actuator.h"
#include "sinew/config/diagnostics.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/units/constants.h"
#include "sinew/world/stand.h"

namespace sinew::identify::dynamic_test {
namespace {

using actuator::Loss;
using Scale = Loss::Scale;
using units::inch;

struct Test {
  double psi = 60, pounds = 6;
};
constexpr Test chapter_3[] = {{60, 6}, {80, 11}, {60, 11}};

constexpr double atmosphere = actuator::thesis_atmosphere;

// Returns the stand's lengths at every `step`, and its pressures.
DecayRecord record(const Test& test, const Loss& loss, double to = 2.4, double step = 0.005) {
  plant::StandSetup s;
  s.muscle.actuator = actuator::thesis_actuator();
  s.muscle.actuator.loss = loss;
  s.muscle.external_volume = 0.114 * inch * inch * inch;
  s.load.mass = test.pounds * units::pound_mass;
  s.start = {.pressure = atmosphere + test.psi * units::psi, .displacement = 0.2 * inch};
  DecayRecord out;
  out.stand = {.actuator = actuator::thesis_actuator(),
               .mass = test.pounds * units::pound_mass,
               .pressure = s.start.pressure,
               .external_volume = s.muscle.external_volume,
               .polytropic_exponent = 1.4,
               .atmosphere = atmosphere,
               .gravity = units::standard_gravity};
  out.data.file = std::to_string(static_cast<int>(test.psi)) + "-" +
                  std::to_string(static_cast<int>(test.pounds)) + ".csv";
  out.data.columns = {{"time", "s", {}}, {"length", "m", {}}, {"pressure", "Pa abs", {}}};
  plant::Stand stand(s);
  for (int i = 0; i * step <= to; ++i) {
    const plant::StandTruth truth = stand.truth(i * step);
    out.data.columns[0].values.push_back(i * step);
    out.data.columns[1].values.push_back(truth.length);
    out.data.columns[2].values.push_back(truth.pressure);
    out.data.lines.push_back(i + 2);
  }
  return out;
}

DecayRecord noisy(DecayRecord r, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, noise);
  for (double& x : r.data.columns[1].values) x += normal(random);
  return r;
}

constexpr double noise = 5e-5;  // 1 % of the displacement

const Loss secant_loss{.viscous = 3.5, .coulomb_length = 1.1e-4};
const Loss sealed_loss{.viscous = 3.0, .coulomb_length = 1.0e-4, .coulomb_scale = Scale::sealed};
const Loss viscous_loss{.viscous = 6.0, .coulomb_length = 0};
const Loss constant_loss{.viscous = 2.5,
                         .coulomb_length = 1.2e-4,
                         .coulomb_scale = Scale::constant,
                         .coulomb_stiffness = 3000};

DynamicResult identified(const Loss& truth, double noise_of_length, unsigned seed) {
  std::vector<DecayRecord> records;
  for (const Test& test : chapter_3)
    records.push_back(noisy(record(test, truth), noise_of_length, seed++));
  return identify_dynamic(records);
}

TEST(Dynamic, WithoutNoiseLawAndConstantsComeBack) {
  const DynamicResult r = identified(secant_loss, 0, 1);
  EXPECT_EQ(r.report.best().model, "secant") << r.report.rule;
  EXPECT_NEAR(r.loss.viscous, secant_loss.viscous, 1e-3 * secant_loss.viscous);
  EXPECT_NEAR(r.loss.coulomb_length, secant_loss.coulomb_length, 1e-3 * secant_loss.coulomb_length);
  EXPECT_LT(r.report.best().fit.rmse_percent, 0.01);
}

// Two records instead of three, to save time.
TEST(Dynamic, TheLawIsDistinguishedFromTheOthersByHeldOutData) {
  const std::pair<Loss, const char*> cases[] = {{secant_loss, "secant"},
                                                {sealed_loss, "sealed"},
                                                {viscous_loss, "viscous"},
                                                {constant_loss, "constant"}};
  unsigned seed = 100;
  for (const auto& [loss, name] : cases) {
    const DecayRecord records[] = {noisy(record(chapter_3[0], loss, 1.6), noise, ++seed),
                                   noisy(record(chapter_3[1], loss, 1.6), noise, ++seed)};
    const DynamicResult r = identify_dynamic(records);
    EXPECT_EQ(r.report.best().model, name) << r.report.rule;
    EXPECT_NEAR(r.loss.viscous, loss.viscous, 0.05 * loss.viscous) << name;
  }
}

// A delayed pressure sensor reduces the slope of pressure over volume, and so the exponent.
TEST(Dynamic, APressureThatComesLateIsPutRight) {
  DecayRecord r = record({60, 6}, secant_loss, 1.6, 0.001);
  r.stand.pressure = r.stand.polytropic_exponent = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> pressure = r.data["pressure"];
  for (std::size_t i = 25; i < pressure.size(); ++i) r.data.columns[2].values[i] = pressure[i - 25];
  const DynamicResult found = identify_dynamic({&r, 1}, "secant");
  EXPECT_NEAR(found.records[0].swing.pressure_delay, 0.025, 2e-4);
  EXPECT_NEAR(found.records[0].swing.stand.polytropic_exponent, 1.4, 5e-3);
  EXPECT_NEAR(found.loss.viscous, secant_loss.viscous, 0.01 * secant_loss.viscous);
}

// With one known loss the other is found, with one parameter less.
TEST(Dynamic, AFrozenLossStaysAndTheOtherIsFound) {
  const DecayRecord r = noisy(record({60, 6}, secant_loss, 1.6), noise, 5);
  const DynamicResult found =
      identify_dynamic({&r, 1}, "secant", Constraints({.freeze = {"viscous=3.5 N s/m"}}));
  EXPECT_EQ(found.loss.viscous, 3.5);
  EXPECT_FALSE(found.report.best().parameters[0].free);
  EXPECT_NEAR(found.loss.coulomb_length, secant_loss.coulomb_length,
              0.01 * secant_loss.coulomb_length);
  const DynamicResult free = identify_dynamic({&r, 1}, "secant");
  EXPECT_LT(found.report.best().parameters[1].standard_error,
            free.report.best().parameters[1].standard_error);
  EXPECT_THROW(identify_dynamic({&r, 1}, "secant", Constraints({.freeze = {"viscos=3.5 N s/m"}})),
               config::Error);
}

TEST(Dynamic, IntervalsCoverTheTruthIn200Trials) {
  int viscous = 0, friction = 0;
  double bias_viscous = 0, bias_friction = 0;
  const DecayRecord clean = record({60, 6}, secant_loss, 1.2);
  for (unsigned seed = 0; seed < 200; ++seed) {
    const DecayRecord r = noisy(clean, noise, seed);
    const DynamicResult found = identify_dynamic({&r, 1}, "secant");
    const Estimate &c = found.report.best().parameters[0], &q = found.report.best().parameters[1];
    EXPECT_TRUE(c.identifiable && q.identifiable);
    viscous += c.low <= secant_loss.viscous && secant_loss.viscous <= c.high;
    friction += q.low <= secant_loss.coulomb_length && secant_loss.coulomb_length <= q.high;
    bias_viscous += (c.value / secant_loss.viscous - 1) / 200;
    bias_friction += (q.value / secant_loss.coulomb_length - 1) / 200;
  }
  EXPECT_GE(viscous, 180);
  EXPECT_LE(viscous, 198);
  EXPECT_GE(friction, 180);
  EXPECT_LE(friction, 198);
  EXPECT_LT(std::abs(bias_viscous), 0.01);
  EXPECT_LT(std::abs(bias_friction), 0.01);
}

// The friction of [49] is low by (1 + sqrt b)^2/4 for any record; that of a trajectory is not.
TEST(Dynamic, TheThesissMethodStandsBesideTheExactOne) {
  const DecayRecord r = record({60, 6}, sealed_loss, 4);
  const DynamicResult found = identify_dynamic({&r, 1}, "sealed");
  const DecaySummary& s = found.records[0];
  ASSERT_TRUE(s.printed && s.exact) << s.why_not;
  EXPECT_NEAR(s.printed->coulomb_length / s.exact->coulomb_length,
              std::pow(1 + std::sqrt(s.exact->kept), 2) / 4, 1e-12);
  EXPECT_NEAR(found.loss.coulomb_length, sealed_loss.coulomb_length, 2e-7);
  EXPECT_NEAR(found.loss.viscous, sealed_loss.viscous, 0.005 * sealed_loss.viscous);
  // The fit of turns assumes a linear spring.
  EXPECT_NEAR(s.all.damping.coulomb_length, sealed_loss.coulomb_length,
              0.1 * sealed_loss.coulomb_length);
  EXPECT_NEAR(s.all.damping.viscous, sealed_loss.viscous, 0.1 * sealed_loss.viscous);
}

TEST(Dynamic, AStaticModelThatIsALittleWrongDoesNotSpoilTheLosses) {
  DecayRecord r = record({60, 6}, secant_loss, 2.4);
  for (double& x : r.data.columns[1].values) x += 1e-3;  // the sensor's zero
  r.stand.actuator.effectiveness.scale = 0.95;
  const DynamicResult found = identify_dynamic({&r, 1}, "secant");
  const Fit& best = found.report.best();
  EXPECT_NEAR(best.parameters[4].value, 1e-3, 2e-5);
  EXPECT_NEAR(best.parameters[5].value, 1 / 0.95, 1e-3);
  EXPECT_NEAR(found.loss.viscous, secant_loss.viscous, 0.01 * secant_loss.viscous);
  EXPECT_NEAR(found.loss.coulomb_length, secant_loss.coulomb_length,
              0.01 * secant_loss.coulomb_length);
  EXPECT_EQ(found.report.warnings.size(), 1u);
}

TEST(Dynamic, AMeasuredPressureGivesWhatWasShutInAndTheExponent) {
  DecayRecord r = record({60, 6}, secant_loss, 1.6);
  const double pressure = r.stand.pressure;
  r.stand.pressure = r.stand.polytropic_exponent = std::numeric_limits<double>::quiet_NaN();
  const Swing swing(r);
  EXPECT_NEAR(swing.stand.polytropic_exponent, 1.4, 1e-4);
  EXPECT_NEAR(swing.stand.pressure, pressure, 1e-3 * pressure);  // the rest is anywhere in a band
  const DynamicResult found = identify_dynamic({&r, 1}, "secant");
  EXPECT_NEAR(found.loss.coulomb_length, secant_loss.coulomb_length,
              0.01 * secant_loss.coulomb_length);

  r.data.columns.pop_back();
  EXPECT_THROW(identify_dynamic({&r, 1}, "secant"), Refusal);
}

TEST(Dynamic, ARecordThatIsHeldOutDoesNotMoveTheLosses) {
  DecayRecord records[] = {record({60, 6}, secant_loss, 1.6), record({80, 11}, viscous_loss, 1.6)};
  records[1].held_out = true;
  const DynamicResult found = identify_dynamic(records, "secant");
  EXPECT_NEAR(found.loss.viscous, secant_loss.viscous, 0.005 * secant_loss.viscous);
  EXPECT_EQ(found.report.held_out_is, "80-11.csv");
  EXPECT_GT(found.report.best().held_out->rmse_percent, 1.0);
  const DynamicResult again = identify_dynamic(records, "secant");
  EXPECT_EQ(again.loss.coulomb_length, found.loss.coulomb_length);
}

std::string refused(const DecayRecord& r) {
  try {
    identify_dynamic({&r, 1}, "viscous");
  } catch (const Refusal& e) {
    return e.what();
  }
  return "not refused";
}

TEST(Dynamic, WhatCannotBeUsedIsReported) {
  const DecayRecord good = record({60, 6}, secant_loss, 1.6);
  const auto says = [](const DecayRecord& r, const char* text) {
    EXPECT_NE(refused(r).find(text), std::string::npos) << refused(r);
  };

  DecayRecord grams = good;
  grams.stand.mass *= 1e-3;
  says(grams, "mass, pressure and their units: at the measured length it holds 2.7");

  DecayRecord gauge = good;  // for absolute
  gauge.stand.pressure -= atmosphere;
  says(gauge, "a period of 0.19");

  DecayRecord still = good;
  for (double& x : still.data.columns[1].values) x = 0.073;
  says(still, "60-6.csv: length: found 0.073 m throughout");

  DecayRecord kilograms = good;  // pounds
  kilograms.stand.mass = 6;
  says(kilograms, "a rest length of");

  DecayRecord slips = good;
  slips.stand.actuator.hysteresis.half_width = 1e4;
  says(slips, "a hysteresis");

  DecayRecord out = good;
  out.held_out = true;
  says(out, "every record held out");
}

TEST(Dynamic, TimeThatRunsBackwardsIsReportedWithItsLine) {
  const char* text = "time [s],length [mm]\n0.0,80\n0.1,79\n0.05,78\n";
  try {
    parse_measured(text, {.path = "a.csv"}, decay_columns());
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("a.csv:4"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("0.05 s after 0.1 s"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace sinew::identify::dynamic_test
