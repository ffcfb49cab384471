// `identify scale` and `identify static --predict` from the outside: a muscle that nobody measured,
// and what is refused of it.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::identify_scale_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

// Two muscles of one make by [22], 10 and 15 cm, while filling; both forget 3 N at random.
std::string two_muscles() {
  std::string out = "length [mm],pressure [kPa gauge],force [N],rest_length [mm]\n";
  int row = 0;
  for (const double rest : {100.0, 150.0})
    for (const double strain : {0.8, 0.85, 0.9, 0.95, 1.0})
      for (const double p : {100.0, 200.0, 300.0, 400.0, 500.0, 600.0}) {
        const double l = rest * strain, b = 1.15 * rest, turns = 0.013 * rest;
        const double force = 1e3 * p * (3 * l * l - b * b) * 1e-6 / (4 * M_PI * turns * turns);
        const double off = 1.5 * ((7 * ++row) % 3 - 1);
        out += std::to_string(l) + "," + std::to_string(p) + "," +
               std::to_string(std::max(0.0, force) + off) + "," + std::to_string(rest) + "\n";
      }
  return out;
}

TEST(IdentifyScale, AMuscleBetweenTwoHasAnIntervalAndIsUsed) {
  const Workspace w;
  std::ofstream(w / "two.csv") << two_muscles();
  const Result fit = w.sinew({"identify", "static", "two.csv", "--hold-out", "muscle", "--model",
                              "ideal", "--predict", "rest_length=120 mm", "-o", "make.toml",
                              "--branch", "fill", "--anyway"});
  ASSERT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out + fit.err, HasSubstr("a muscle of 120 mm, from the others: 68 %"));

  const Result predicted = w.sinew({"actuator", "make-120mm.toml", "--length", "110 mm",
                                    "--pressure", "400 kPa gauge", "--json"});
  ASSERT_EQ(predicted.code, 0) << predicted.err;
  const Json there = Json::parse(predicted.out)["points"][0];
  EXPECT_GT(there["half_95_N"].get<double>(), there["half_68_N"].get<double>());

  // From the file alone it is the same muscle.
  const Result scaled = w.sinew(
      {"identify", "scale", "make.toml", "--rest-length", "120 mm", "--json", "-o", "scaled.toml"});
  ASSERT_EQ(scaled.code, 0) << scaled.err;
  EXPECT_GT(Json::parse(scaled.out)["half_95_N"].get<double>(), 0);
  const Result again = w.sinew(
      {"actuator", "scaled.toml", "--length", "110 mm", "--pressure", "400 kPa gauge", "--json"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NEAR(Json::parse(again.out)["points"][0]["tension_N"].get<double>(),
              there["tension_N"].get<double>(), 1e-6);
}

TEST(IdentifyScale, WhatIsWrongIsSaidAndNothingIsLost) {
  const Workspace w;
  const std::string leg = SINEW_SOURCE_DIR "/robots/leg/actuator.toml";
  const Result unknown = w.sinew({"identify", "scale", leg, "--rest-length", "120 mm"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("prediction.rest_length"));

  std::ofstream(w / "two.csv") << two_muscles();
  ASSERT_EQ(
      w.sinew({"identify", "static", "two.csv", "--model", "ideal", "-o", "make.toml", "--anyway"})
          .code,
      0);
  const auto scale = [&](const std::string& reading) {
    return w.sinew({"identify", "scale", "make.toml", "--rest-length", "120 mm", "--reading",
                    reading, "-o", "make.toml"});
  };
  const Result taken = scale("110 mm, 4 bar gauge, 200 N");
  EXPECT_EQ(taken.code, 1);
  EXPECT_THAT(taken.err, HasSubstr("make.toml"));
  const Result predict = w.sinew({"identify", "static", "two.csv", "--predict", "length=3 mm"});
  EXPECT_EQ(predict.code, 2) << predict.err;
  EXPECT_THAT(predict.err, HasSubstr("expected a rest length; try \"120 mm\""));
  for (const char* reading : {"110 mm, 4 bar gauge", "110 mm, 4 bar, 200 N", "a, b, c"}) {
    const Result result = w.sinew(
        {"identify", "scale", "make.toml", "--rest-length", "120 mm", "--reading", reading});
    EXPECT_EQ(result.code, 2) << reading << result.err;
    EXPECT_THAT(result.err, HasSubstr("--reading")) << reading;
  }
  const Result other = w.sinew({"identify", "scale", "make.toml", "--rest-length", "120 mm",
                                "--reading", "110 mm, 4 bar gauge, 5 N"});
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err, HasSubstr("a force near"));
}

}  // namespace
}  // namespace sinew::test::identify_scale_test
