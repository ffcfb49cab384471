// `sinew identify valve`: from CSV to a valve's file and to predict.dat.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sinew/signals/pulse.h"
#include "tests/cli/program.h"

namespace sinew::test::identify_valve_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

// ISO 6358 with C = 3 L/(s bar), b = 0.3, from 7 bar abs.
std::string chart() {
  std::string text = "upstream [bar abs],downstream [bar abs],flow [L/min]\n";
  for (const double down : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.5}) {
    const double x = std::max(0.0, (down / 7 - 0.3) / 0.7);
    text += "7," + std::to_string(down) + "," + std::to_string(60 * 3 * 7 * std::sqrt(1 - x * x)) +
            "\n";
  }
  return text;
}

std::string duties() {
  std::string text = "duty [%],delivered [%]\n";
  for (double d = 0; d <= 100; d += 0.25)
    text += std::to_string(d) + "," +
            std::to_string(100 * signals::delivered_duty(d / 100, 0.04, 4e-3, 1.2e-3)) + "\n";
  return text;
}

// Isothermal, ISO 6358 with C/V = 2 1/(s bar) and b = 0.3, from 7 bar abs; in steps of 50 us, or
// longer ones where the chamber is larger. Rows without the header, `more` at their ends.
std::string rows_of_filling(double larger = 1, const std::string& more = "") {
  std::string text;
  double p = 1.013e5;
  for (int i = 0; i < 20000; ++i) {
    if (i % 100 == 0)
      text += std::to_string(5e-5 * larger * i) + "," + std::to_string(1e-3 * (p - 1.01325e5)) +
              more + "\n";
    const double x = std::max(0.0, (p / 7e5 - 0.3) / 0.7);
    if (i > 2000)
      p += 5e-5 * 287 * 293.15 * 2e-5 * 1.185 * 7e5 * std::sqrt(std::max(0.0, 1 - x * x));
  }
  return text;
}

std::string filling(double larger = 1) {
  return "time [s],pressure [kPa gauge]\n" + rows_of_filling(larger);
}

TEST(IdentifyValve, AChartBecomesAValveThatSinewValveReads) {
  const Workspace w;
  write_text(w / "chart.csv", chart());
  const Result found =
      w.sinew({"identify", "valve", "chart.csv", "-o", "mine.toml", "--name", "mine", "--json"});
  ASSERT_EQ(found.code, 0) << found.err;
  const Json report = Json::parse(found.out);
  EXPECT_EQ(report["model"], "iso6358");
  EXPECT_NEAR(report["parameters"][0]["value"], 3e-8, 3e-11);
  EXPECT_NEAR(report["parameters"][1]["value"], 0.3, 0.001);
  EXPECT_TRUE(report.contains("held_out"));

  const Result flow = w.sinew({"valve", "mine.toml", "mine", "--upstream", "7 bar abs",
                               "--downstream", "1 bar abs", "--json"});
  ASSERT_EQ(flow.code, 0) << flow.err;
  EXPECT_NEAR(Json::parse(flow.out)["sonic_conductance_m3_per_s_Pa"], 3e-8, 3e-11);
  EXPECT_EQ(w.sinew({"check", "mine.toml"}).code, 0);
}

TEST(IdentifyValve, AMapOfDutiesBecomesDelaysAndPredictDat) {
  const Workspace w;
  write_text(w / "duty.csv", duties());
  const Result found = w.sinew({"identify", "valve", "duty.csv", "--frequency", "25 Hz", "--base",
                                "robots/leg/valves.toml", "--name", "758", "-o", "mine.toml",
                                "--predict-dat", "predict.dat", "--json"});
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(read_text(w / "predict.dat"), HasSubstr("\n50,47,90\n"));  // t_o 10 %, t_c 3 %

  const Result valve = w.sinew({"valve", "mine.toml", "758", "--upstream", "100 psi gauge",
                                "--downstream", "0 psi gauge", "--json"});
  ASSERT_EQ(valve.code, 0) << valve.err;
  const Json out = Json::parse(valve.out);
  EXPECT_NEAR(out["opening_delay_s"], 4e-3, 0.1e-3);
  EXPECT_NEAR(out["closing_delay_s"], 1.2e-3, 0.1e-3);
  EXPECT_GT(out["effective_area_m2"], 1e-6);  // as before
}

TEST(IdentifyValve, AFillingWithoutAVolumeFailsAndSaysWhatIsMissing) {
  const Workspace w;
  write_text(w / "fill.csv", filling());
  const Result without = w.sinew({"identify", "valve", "fill.csv"});
  EXPECT_EQ(without.code, 1);
  EXPECT_THAT(without.err, HasSubstr("expected the volume beside it"));
  EXPECT_THAT(without.out, HasSubstr("conductance_per_volume"));
  const Result file = w.sinew(
      {"identify", "valve", "fill.csv", "--volume", "0.5 L", "--exponent", "1", "-o", "v.toml"});
  EXPECT_EQ(file.code, 0) << file.err;
  EXPECT_THAT(file.out, HasSubstr("sonic_conductance"));
  EXPECT_EQ(w.sinew({"check", "v.toml"}).code, 0);
}

// A chamber of 0.5 L, and the same with a bottle of 0.5 L joined to it: C = 1e-8, from two files,
// or from one with a column of the volumes.
TEST(IdentifyValve, TwoFillingsWithAKnownVolumeJoinedTellConductanceAndVolume) {
  const Workspace w;
  write_text(w / "a.csv", filling());
  write_text(w / "b.csv", filling(2));
  write_text(w / "both.csv", "time [s],pressure [kPa gauge],added_volume [L]\n" +
                                 rows_of_filling(1, ",0") + rows_of_filling(2, ",0.5"));
  const std::vector<Words> ways{{"a.csv", "b.csv", "--added-volume", "0 L,0.5 L"}, {"both.csv"}};
  for (const Words& way : ways) {
    Words words{"identify", "valve", "--exponent", "1", "--json", "--quiet"};
    words.insert(words.end(), way.begin(), way.end());
    const Result result = w.sinew(words);
    ASSERT_EQ(result.code, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["parameters"][0]["name"], "sonic_conductance");
    EXPECT_NEAR(json["parameters"][0]["value"].get<double>() / 1e-8, 1, 0.02);
    EXPECT_EQ(json["parameters"][1]["name"], "volume");
    EXPECT_NEAR(json["parameters"][1]["value"].get<double>() / 5e-4, 1, 0.02);
  }
  const Result file = w.sinew({"identify", "valve", "both.csv", "--exponent", "1", "-o", "v.toml"});
  ASSERT_EQ(file.code, 0) << file.err;
  EXPECT_EQ(w.sinew({"check", "v.toml"}).code, 0);

  const Result few = w.sinew({"identify", "valve", "a.csv", "b.csv", "--added-volume", "0 L"});
  EXPECT_EQ(few.code, 2);
  EXPECT_THAT(few.err, HasSubstr("--added-volume: found 1 volumes; expected one for each of 2"));
  const Result known = w.sinew({"identify", "valve", "both.csv", "--volume", "0.5 L"});
  EXPECT_EQ(known.code, 2);
  EXPECT_THAT(known.err, HasSubstr("--volume: found \"0.5 L\""));
}

// What one filling lacks, and how well each way to get it would do.
TEST(IdentifyValve, AFillingTellsWhatWouldSeparateConductanceAndVolume) {
  const Workspace w;
  write_text(w / "fill.csv", filling());
  const Result result = w.sinew({"identify", "valve", "fill.csv", "--exponent", "1"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("--added-volume \"0 L,0.5 L\""));
  EXPECT_THAT(result.err, HasSubstr("weigh the chamber full of water"));
}

// Rows of two valves that take turns in one table; of a chart their times mean nothing.
TEST(IdentifyValve, RowsOfTwoValvesInOneTableArePartedByWhere) {
  const Workspace w;
  std::string text = "time [s],pressure [kPa gauge],valve\n";
  std::istringstream a(rows_of_filling()), b(rows_of_filling());
  for (std::string first, second; std::getline(a, first) && std::getline(b, second);)
    text += first + ",inlet\n" + second.substr(0, second.find(',')) + ",600,exhaust\n";
  write_text(w / "mixed.csv", text);
  const Result mixed = w.sinew({"identify", "valve", "mixed.csv", "--per-volume"});
  EXPECT_EQ(mixed.code, 1);
  EXPECT_THAT(mixed.err, HasSubstr("2 curves whose rows take turns"));
  EXPECT_THAT(mixed.err, HasSubstr("--where \"valve=inlet\""));
  const Result one = w.sinew({"identify", "valve", "mixed.csv", "--per-volume", "--exponent", "1",
                              "--where", "valve=inlet", "--json"});
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_NEAR(Json::parse(one.out)["parameters"][0]["value"].get<double>() / 2e-5, 1, 0.02);

  std::string timed = "time [s],";
  std::istringstream rows(chart());
  std::string line;
  std::getline(rows, line);
  timed += line + "\n";
  for (int time = 90; std::getline(rows, line); time -= 10)
    timed += std::to_string(time) + "," + line + "\n";
  write_text(w / "chart.csv", timed);
  const Result chart = w.sinew({"identify", "valve", "chart.csv", "--json"});
  ASSERT_EQ(chart.code, 0) << chart.err;
  EXPECT_NEAR(Json::parse(chart.out)["parameters"][0]["value"].get<double>(), 3e-8, 3e-11);
  EXPECT_THAT(chart.err, HasSubstr("times are out of order"));
}

// Two valves in one chart are no valve.
TEST(IdentifyValve, AChartOfTwoValvesIsRefused) {
  const Workspace w;
  std::string text = chart();
  for (const double down : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 6.5}) {
    const double x = std::max(0.0, (down / 7 - 0.3) / 0.7);
    text += "7," + std::to_string(down) + "," +
            std::to_string(0.4 * 60 * 3 * 7 * std::sqrt(1 - x * x)) + "\n";
  }
  write_text(w / "two.csv", text);
  const Result result = w.sinew({"identify", "valve", "two.csv"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("if rows of several valves stand in one table"));
}

TEST(IdentifyValve, WrongUnitsAndTimesThatRunBackwardsAreToldWithTheirLine) {
  const Workspace w;
  std::string text = filling();
  write_text(w / "unit.csv", "time [s],pressure [N]" + text.substr(text.find('\n')));
  const Result unit = w.sinew({"identify", "valve", "unit.csv"});
  EXPECT_EQ(unit.code, 1);
  EXPECT_THAT(unit.err, HasSubstr("unit.csv:1:"));

  write_text(w / "back.csv", text + "0.5,400\n");
  const Result back = w.sinew({"identify", "valve", "back.csv"});
  EXPECT_EQ(back.code, 1);
  EXPECT_THAT(back.err, HasSubstr("back.csv:202:"));
}

TEST(IdentifyValve, WhatCannotBeIsToldBeforeAnythingIsFitted) {
  const Workspace w;
  write_text(w / "fill.csv", filling());
  const auto refused = [&](const Words& more) {
    Words words{"identify", "valve", "fill.csv", "--volume", "0.5 L"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = w.sinew(words);
    EXPECT_NE(result.code, 0) << result.out;
    return result.err;
  };
  EXPECT_THAT(refused({"--kind", "nonsense"}), HasSubstr("--kind"));
  EXPECT_THAT(refused({"--kind", "coil"}), HasSubstr("found the columns time, pressure alone"));
  EXPECT_THAT(refused({"--temperature", "-300 degC"}), HasSubstr("expected 200 K to 400 K"));
  EXPECT_THAT(refused({"--hold-out", "fill.csv"}), HasSubstr("expected another file"));
  EXPECT_THAT(refused({"--predict-dat", "fill.csv", "--force"}), HasSubstr("another file"));
}

TEST(IdentifyValve, DelaysAloneMakeNoFile) {
  const Workspace w;
  write_text(w / "duty.csv", duties());
  const Result found =
      w.sinew({"identify", "valve", "duty.csv", "--frequency", "25 Hz", "-o", "mine.toml"});
  EXPECT_EQ(found.code, 1);
  EXPECT_THAT(found.err, HasSubstr("--base VALVES.toml"));
}

}  // namespace
}  // namespace sinew::test::identify_valve_test
