// A checkup of a known muscle: its noise, its parameters, and what is missing.
#include "sinew/identify/check/checkup.h"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <cmath>

#include "sinew/identify/check/test_rig.h"
#include "sinew/identify/contest/refusal.h"
#include "sinew/json/json.h"

namespace sinew::identify::checkup_test {
namespace {

// A table as read from a file.
CheckInput table_of(const std::vector<StaticPoint>& points, bool tell_branches = true) {
  std::string text = fmt::format("length [mm],pressure [kPa gauge],force [N],rest_length [mm]{}\n",
                                 tell_branches ? ",branch" : "");
  for (const StaticPoint& p : points) {
    text +=
        fmt::format("{},{},{},{}", 1e3 * p.length, 1e-3 * p.pressure, p.force, 1e3 * p.rest_length);
    text += !tell_branches ? "\n" : p.branch == Branch::fill ? ",fill\n" : ",vent\n";
  }
  CheckInput out;
  out.add({parse_measured(text, {.path = "rig.csv"}, static_columns()), {}});
  return out;
}

CheckInput table_of(const TestRig& rig) {
  std::vector<StaticPoint> points;
  add_rig(rig, points);
  return table_of(points);
}

const Determined& parameter(const DeterminedLaw& law, const std::string& name) {
  const auto at = std::ranges::find(law.parameters, name, &Determined::name);
  if (at == law.parameters.end()) throw std::out_of_range(name);
  return *at;
}

TEST(Checkup, RecognisesFilesMountsAndSteps) {
  const Recognised found = recognise(table_of(TestRig{}));
  ASSERT_EQ(found.files.size(), 1u);
  EXPECT_EQ(found.files[0].file, "rig.csv");
  EXPECT_EQ(found.files[0].rows, 130u);
  EXPECT_FALSE(found.files[0].is_recording);
  EXPECT_EQ(found.files[0].columns[1].name, "pressure");
  EXPECT_EQ(found.files[0].columns[1].highest, "650 kPa gauge");
  ASSERT_EQ(found.mounts.size(), 5u);
  EXPECT_DOUBLE_EQ(found.mounts.back().length, 0.25);
  EXPECT_EQ(found.mounts.back().pressures, 13);
  EXPECT_EQ(found.mounts.back().branches, "fill, vent");
  EXPECT_EQ(found.mounts.back().points, 26u);
  EXPECT_EQ(found.noise.readings, 0u);  // nothing is repeated
}

// The added noise is found from repeated readings and from samples at rest.
TEST(Checkup, FindsTheNoise) {
  for (const double noise : {0.5, 2.0}) {
    const ForceNoise found = force_noise(table_of(TestRig{.noise = noise, .seed = 3, .runs = 4}));
    EXPECT_EQ(found.from, "repeated readings");
    EXPECT_NEAR(found.deviation, noise, 0.1 * noise);

    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    std::string text = "time [s],pressure [kPa gauge],force [N]\n";
    for (int i = 0; i < 4000; ++i) {  // ten levels, each reached within 0.2 s
      const double t = 0.005 * i, into = std::min(1.0, std::fmod(t, 2) / 0.2),
                   p = 60 * (std::floor(t / 2) + into);
      text += fmt::format("{},{},{}\n", t, p, 0.9 * p + noise * normal(random));
    }
    CheckInput recording;
    recording.add(
        {parse_measured(text, {.path = "fill.csv", .values = {"length=0.25 m"}}, static_columns()),
         {.rest_length = 0.25}});
    const Recognised said = recognise(recording);
    EXPECT_EQ(said.noise.from, "settled samples");
    EXPECT_NEAR(said.noise.deviation, noise, 0.1 * noise);
    EXPECT_TRUE(said.files.at(0).is_recording);
    EXPECT_NEAR(said.files[0].settled, 0.9, 0.06);
  }
}

// The intervals of parameters determined by the data contain the truth.
TEST(Checkup, TheIntervalOfTheDataHoldsTheTruth) {
  int told = 0, held = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const DeterminedLaw law = determine(table_of(
        TestRig{.contractions = {0, 0.01, 0.02, 0.04, 0.07, 0.1, 0.14, 0.18}, .seed = seed}));
    ASSERT_EQ(law.refused, "");
    for (const auto& [name, truth] : {std::pair{"thread_length", 0.28},
                                      {"turns", 3.0},
                                      {"threshold", 4e4},
                                      {"saturating_tension", 110.0},
                                      {"half_width", 8e3}}) {
      const Determined& d = parameter(law, name);
      if (d.by != Determination::by_data) continue;
      EXPECT_TRUE(d.advice.empty()) << name;
      EXPECT_NE(d.words.find("to +-"), std::string::npos) << d.words;
      ++told;
      held += std::abs(d.value - truth) <= d.half_width ? 1 : 0;
    }
  }
  EXPECT_GE(told, 16);
  EXPECT_GE(held, told - 2);
}

// Mounts that are close together determine neither braid nor bladder, and one branch no hysteresis:
// the report names the measurements that would.
TEST(Checkup, ReportsWhatWouldDetermineTheRest) {
  std::vector<StaticPoint> points;
  add_rig({.contractions = {0.06, 0.08}, .noise = 3}, points);
  std::erase_if(points, [](const StaticPoint& p) { return p.branch == Branch::vent; });
  const DeterminedLaw law = determine(table_of(points));
  EXPECT_NE(parameter(law, "thread_length").by, Determination::by_data);
  EXPECT_NE(parameter(law, "saturation_length").by, Determination::by_data);
  EXPECT_NE(parameter(law, "saturation_length").advice.find("1, 2 and 4 %"), std::string::npos);
  const Determined& hysteresis = parameter(law, "half_width");
  EXPECT_EQ(hysteresis.by, Determination::undetermined);
  EXPECT_NE(hysteresis.advice.find("on the way up and on the way down"), std::string::npos);
}

// Red checks are refused together, each with its advice; with `anyway` they are warnings. Good data
// give none.
TEST(Checkup, RefusesWhatIsRedUnlessItIsToBeFittedAnyway) {
  std::vector<std::string> warnings;
  apply_checks(check_static(table_of(TestRig{})), false, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.at(0);

  CheckInput wrong = table_of(TestRig{.contractions = {0}});
  wrong.diameter = 0.04;
  const std::vector<Check> checks = check_static(wrong);
  std::string said;
  try {
    apply_checks(checks, false, warnings);
  } catch (const Refusal& refusal) {
    said = refusal.what();
  }
  for (const char* part :
       {"force unit: ", "1 lbf is 4.448 N", "\nlengths: There is one length only.", "actuator=FILE",
        "check: found 2 red", "anyway=true"})
    EXPECT_NE(said.find(part), std::string::npos) << part << " is not in " << said;
  apply_checks(checks, true, warnings);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].substr(0, 11), "force unit:");
}

// With a known braid one length is enough.
TEST(Checkup, OneLengthWillDoWhereTheBraidIsKnown) {
  CheckInput one = table_of(TestRig{.contractions = {0.05}});
  EXPECT_TRUE(has_red(check_static(one)));
  one.braid = actuator::Braid{.thread_length = 0.28, .turns = 3};
  EXPECT_FALSE(has_red(check_static(one)));
}

// Weights are hung on a muscle at few pressures: every row has its own length.
TEST(Checkup, WeightsOnAMuscleAreGoodData) {
  const StaticScales scales{.rest_length = test_rest_length, .atmosphere = 101325};
  std::string text = "length [mm],pressure [kPa gauge],load [kg]\n";
  for (const double p : {1e5, 2e5, 3e5, 4e5, 5e5, 6e5})
    for (double load = 1; load < 40; load += 3)
      for (double c = 0.25; c > 0; c -= 1e-4) {
        const StaticPoint at{.length = 0.25 * (1 - c), .pressure = p, .rest_length = 0.25};
        if (predicted(test_muscle(), scales, at) < 9.80665 * load) continue;
        text += fmt::format("{},{},{}\n", 1e3 * at.length, 1e-3 * p, load);
        break;
      }
  CheckInput input;
  input.add(
      {parse_measured(text, {.path = "weights.csv"}, static_columns()), {.rest_length = 0.25}});
  std::vector<std::string> warnings;
  apply_checks(check_static(input), false, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.at(0);
}

// Impossible lengths can come from Python's arrays, which no reader has checked: they are red.
TEST(Checkup, LengthsBelowZeroAreRed) {
  for (const double sign : {-1.0, 0.0}) {
    std::vector<StaticPoint> points;
    add_rig({}, points);
    Measured table{.file = "arrays"};
    table.columns = {
        {"force", "N", {}, ""}, {"pressure", "Pa gauge", {}, ""}, {"length", "m", {}, ""}};
    for (const StaticPoint& p : points) {
      table.columns[0].values.push_back(p.force);
      table.columns[1].values.push_back(p.pressure);
      table.columns[2].values.push_back(sign * p.length);
      table.lines.push_back(1 + static_cast<int>(table.lines.size()));
    }
    CheckInput input;
    input.add_or_report({table, {}});
    EXPECT_TRUE(has_red(check_up(input).checks)) << sign;
  }
}

TEST(Checkup, JsonHasAllOfIt) {
  const auto json = to_json(check_up(table_of(TestRig{})));
  EXPECT_EQ(json["format"], "sinew.check/1");
  EXPECT_EQ(json["red"], false);
  EXPECT_EQ(json["recognised"]["mounts"].size(), 5u);
  EXPECT_EQ(json["recognised"]["mounts"][4]["length_m"], 0.25);
  EXPECT_EQ(json["determined"]["model"], "saturating-effectiveness");
  EXPECT_EQ(json["determined"]["parameters"][0]["determined_by"], "data");
  EXPECT_EQ(json["checks"].back()["name"], "labels");
}

}  // namespace
}  // namespace sinew::identify::checkup_test
