// `identify pair` from the outside: a slide that is moved, what is printed, and what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.h"

namespace sinew::test::identify_pair_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

// Records a synthetic slide on 80 N/mm with 15 N of dry friction and a zero of the force cell.
std::string moved(double bias, double phase) {
  std::string out = "time [s],force [N],displacement [mm],pressure_1 [kPa gauge]\n";
  double share = 0, before = std::sin(phase);
  for (int i = 0; i < 600; ++i) {
    const double t = 0.01 * i, x = std::sin(2 * t + phase) + 0.2 * std::sin(7 * t);
    share = std::clamp(share + (x - before) / 0.05, -1.0, 1.0);
    before = x;
    const double force = bias + 80 * x + 15 * share + 0.2 * std::sin(977 * t);
    const double pressure = 450 * std::exp(-0.02 * x) - 101.325;
    out += std::to_string(t) + "," + std::to_string(force) + "," + std::to_string(x) + "," +
           std::to_string(pressure) + "\n";
  }
  return out;
}

TEST(IdentifyPair, FindsTheSlideOfTwoRecordings) {
  const Workspace w;
  write_text(w / "a.csv", moved(3, 0));
  write_text(w / "b.csv", moved(-5, 1));
  const Words words{"identify", "pair",     "a.csv",     "b.csv",   "--hold-out",
                    "5 s..",    "--freeze", "delay=0 s", "--model", "spring_bristle"};
  Words json = words;
  json.emplace_back("--json");
  const Result result = w.sinew(json);
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  EXPECT_NEAR(out["stiffness_N_per_m"], 80e3, 500);
  EXPECT_NEAR(out["recordings"][0]["bias_N"], 3, 0.5);
  EXPECT_NEAR(out["recordings"][1]["bias_N"], -5, 0.5);
  EXPECT_GT(out["held_out"]["r_squared"], 0.999);
  EXPECT_NEAR(out["air"]["muscles"][0]["relative_change_1_per_m"], 20, 0.1);
  EXPECT_EQ(out["air"]["muscles"][0]["falls"], true);
  EXPECT_GT(out["band"]["half_68"], 0);
  EXPECT_GT(out["band"]["half_95"], out["band"]["half_68"]);
  EXPECT_LT(out["held_out"]["rmse"], out["band"]["half_95"]);

  const Result text = w.sinew(words);
  EXPECT_THAT(text.out, AllOf(HasSubstr("friction"), HasSubstr("frozen"), HasSubstr("held out"),
                              HasSubstr("springs and trapped air together"),
                              HasSubstr("68 and 95 % of what it did not see lie within +- ")));
  EXPECT_THAT(text.err, HasSubstr("freeze area or stiffness to part them"));
}

TEST(IdentifyPair, WrongWordsAreWrongUsageAndASlideHasNoFile) {
  const Workspace w;
  write_text(w / "a.csv", moved(3, 0));
  const auto code_of = [&](Words more, const std::string& said) {
    Words words{"identify", "pair", "a.csv"};
    words.insert(words.end(), more.begin(), more.end());
    const Result result = w.sinew(words);
    EXPECT_THAT(result.err, HasSubstr(said));
    return result.code;
  };
  EXPECT_EQ(code_of({"--freeze", "fricton=3 N"}, "--freeze: found \"fricton\""), 2);
  EXPECT_EQ(code_of({"--prior", "friction=3 N"}, "--prior: found"), 2);
  EXPECT_EQ(code_of({"--hold-out", "7..9"}, "--hold-out: found"), 2);
  EXPECT_EQ(code_of({"--rigs", "a,b"}, "--rigs: found 2 names"), 2);
  EXPECT_EQ(code_of({"--model", "spring", "-o", "mine.toml"}, "found a slide"), 1);
  write_text(w / "a.csv", "time [s],force [N]\n0,1\n1,2\n");
  EXPECT_EQ(code_of({}, "neither force and displacement nor torque and angle"), 1);
}

}  // namespace
}  // namespace sinew::test::identify_pair_test
