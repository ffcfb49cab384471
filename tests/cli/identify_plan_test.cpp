// `sinew identify plan`: a table to fill in, which `identify static` then reads and whose error is
// as it was promised; and what to measure next.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tests/cli/program.h"

namespace sinew::test::identify_plan_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::ordered_json;

const std::string map = SINEW_SOURCE_DIR "/data/martens_boblan_2017/DMSP-10-250_force_map.csv";

Words plan(const Words& more) {
  Words out{"identify",   "plan",  "--rest-length", "250 mm",
            "--diameter", "12 mm", "--pressure",    "600 kPa gauge"};
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

Words next(const Words& more) {
  Words out{"identify",
            "plan",
            map,
            "--map",
            "force=F_N,pressure=P_gauge_Pa,length=L_m",
            "--unit",
            "F_N=N",
            "--unit",
            "P_gauge_Pa=Pa gauge",
            "--unit",
            "L_m=m",
            "--rest-length",
            "250 mm"};
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

// What a muscle of that size pulls with, as `sinew identify static` has it: saturating.
double force_of(double length, double pressure) {
  const double b = 1.15 * 0.25, u = length - 0.25;
  const double turns = std::sqrt(b * b - 0.25 * 0.25) / (M_PI * 0.012);
  const double braid = (3 * length * length - b * b) / (4 * M_PI * turns * turns);
  return std::max(0.0, (pressure - 5e4) * braid - 60 * (1 - std::exp(u / 0.0055)));
}

// The plan with forces in the place of what is empty, and noise.
std::string filled(const std::string& text) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1);
  std::istringstream in(text);
  std::string out;
  for (std::string line; std::getline(in, line);) {
    const std::size_t gap = line.find(",,");
    if (gap != line.npos) {
      const double length = std::stod(line), pressure = std::stod(line.substr(line.find(',') + 1));
      line.insert(gap + 1, std::to_string(force_of(1e-3 * length, 1e3 * pressure) + noise(random)));
    }
    out += line + "\n";
  }
  return out;
}

TEST(IdentifyPlan, IsFilledInAndFittedAndAsGoodAsItSaid) {
  const Workspace w;
  const Result result =
      w.sinew(plan({"--error", "1.5 %", "--noise", "1 N", "-o", "plan.csv", "--json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_TRUE(json["reached"].get<bool>());
  EXPECT_GE(json["mounts"].size(), 3u);
  const double promised = json["after"]["rms_percent"];
  EXPECT_LE(promised, 1.5);
  // Its minutes are those of its mounts and readings.
  EXPECT_NEAR(json["time_s"], 600.0 * json["mounts"].size() + 30.0 * json["readings"].get<double>(),
              1e-6);

  const std::string text = read_text(w / "plan.csv");
  std::size_t rows = 0;
  for (std::size_t at = text.find(",,"); at != text.npos; at = text.find(",,", at + 1)) ++rows;
  EXPECT_EQ(rows, json["readings"]);
  EXPECT_EQ(w.sinew({"identify", "static", "plan.csv"}).code, 1);  // empty cells are told

  write_text(w / "measured.csv", filled(text));
  const Result fitted = w.sinew({"identify", "static", "measured.csv", "--model",
                                 "saturating-effectiveness", "-o", "mine.toml", "--no-report"});
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const Json region = json["region"];
  double squares = 0, count = 0;
  for (const double x : {0.1, 0.4, 0.7, 1.0}) {
    const double length =
        region["shortest_m"].get<double>() * (1 - x) + region["longest_m"].get<double>() * x;
    const Result force =
        w.sinew({"actuator", "mine.toml", "--length", std::to_string(length) + " m", "--pressure",
                 "200 kPa gauge:600 kPa gauge:200 kPa", "--json"});
    ASSERT_EQ(force.code, 0) << force.err;
    double pressure = 2e5;
    const Json points = Json::parse(force.out)["points"];
    for (const Json& point : points) {
      const double truth = force_of(length, pressure);
      const double off = std::max(0.0, point["tension_N"].get<double>()) - truth;
      if (truth > 0) squares += off * off;
      count += truth > 0 ? 1 : 0;
      pressure += 2e5;
    }
  }
  const double found = 100 * std::sqrt(squares / count) / json["largest_force_N"].get<double>();
  EXPECT_LE(found, promised);
}

TEST(IdentifyPlan, PrintsMountsPressuresAndMinutesInOrder) {
  const Workspace w;
  const Result result = w.sinew(plan({"--quiet"}));
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(result.out, AllOf(HasSubstr("plan for a muscle of 250 mm, 12 mm wide"),
                                HasSubstr("up and down over [kPa gauge]"), HasSubstr("minutes"),
                                HasSubstr("(2 % wanted, rms)")));
  const Result inches = w.sinew(plan({"--quiet", "--units", "thesis"}));
  EXPECT_THAT(inches.out, AllOf(HasSubstr("9.843 in"), HasSubstr("up and down over [psi gauge]")));
}

// Five lengths leave the steep end open: the next mounts are there, and buy what they say.
TEST(IdentifyPlan, OfDataSaysWhatToMeasureNextAndWhatItBuys) {
  const Workspace w;
  const Result result = w.sinew(next({"--error", "1.3 %", "--json"}));
  ASSERT_EQ(result.code, 0) << result.err;
  const Json json = Json::parse(result.out);
  EXPECT_EQ(json["measured_readings"], 85);
  EXPECT_GT(json["before"]["rms_percent"].get<double>(), 1.3);
  EXPECT_LE(json["after"]["rms_percent"].get<double>(), 1.3);
  ASSERT_FALSE(json["mounts"].empty());
  const double length = json["mounts"][0]["length_m"];
  EXPECT_GT(length, 0.234);  // the last length before the longest
  EXPECT_LT(length, 0.25);
  const Result enough = w.sinew(next({"--error", "3 %"}));
  EXPECT_THAT(enough.out, HasSubstr("nothing more to measure"));
}

TEST(IdentifyPlan, WhatCannotBeIsWrongUsage) {
  const Workspace w;
  const auto told = [&](const Words& words) {
    const Result result = w.sinew(words);
    EXPECT_EQ(result.code, 2) << result.out;
    return result.err;
  };
  EXPECT_THAT(told({"identify", "plan"}), HasSubstr("--pressure: found nothing"));
  EXPECT_THAT(told({"identify", "plan", "--pressure", "600 kPa gauge", "--rest-length", "250 mm"}),
              HasSubstr("--diameter: found nothing"));
  EXPECT_THAT(
      told(plan({"--error", "0.5 %"})),
      AllOf(HasSubstr("--error: found \"0.5 %\"; expected above 1 %"), HasSubstr("--law-error")));
  EXPECT_THAT(told(plan({"--noise", "2 kg"})), HasSubstr("--noise"));
  EXPECT_THAT(told(plan({"--shortest", "249 mm"})), HasSubstr("--longest"));
  EXPECT_THAT(told(plan({"--most", "1"})), HasSubstr("--most"));
  EXPECT_THAT(told(plan({"--lowest", "600 kPa gauge"})), HasSubstr("--lowest"));
}

TEST(IdentifyPlan, ReplacesAPlanAndNothingElse) {
  const Workspace w;
  EXPECT_EQ(w.sinew(plan({"-o", "plan.csv"})).code, 0);
  EXPECT_THAT(w.sinew(plan({"-o", "plan.csv"})).err, HasSubstr("--force"));
  EXPECT_EQ(w.sinew(plan({"-o", "plan.csv", "--force"})).code, 0);
  write_text(w / "mine.csv", "a,b\n1,2\n");
  EXPECT_EQ(w.sinew(plan({"-o", "mine.csv", "--force"})).code, 1);
  EXPECT_EQ(read_text(w / "mine.csv"), "a,b\n1,2\n");
}

// An actuator's file is a muscle like the one that is planned for.
TEST(IdentifyPlan, OfAnActuatorsFile) {
  const Workspace w;
  const Result result = w.sinew({"identify", "plan", "--actuator", "robots/leg/actuator.toml",
                                 "--rest-length", "95 mm", "--pressure", "110 psi gauge"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("a muscle of 95 mm like"));
}

}  // namespace
}  // namespace sinew::test::identify_plan_test
