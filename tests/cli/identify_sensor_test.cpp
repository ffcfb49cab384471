// `identify sensor` and `force-beam` from the outside: what they print, write and refuse.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sinew/units/literals.h"
#include "tests/cli/program.h"

namespace sinew::test::identify_sensor_test {
namespace {

using namespace units::literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

// Weights on the four transducers of table 4-1, up and down, with an offset and a wobble of 3 mV.
// Synthetic: what was measured is lost.
std::string weights() {
  const double scales[] = {0.1689, 0.1610, 0.1694, 0.1809};
  std::string text =
      "load [lb],hip_flexor_tension [V],hip_extensor_tension [V],knee_flexor_tension [V],"
      "knee_extensor_tension [V]\n";
  for (int i = 0; i <= 32; ++i) {
    const int load = i <= 16 ? i : 32 - i;
    text += std::to_string(load);
    for (int k = 0; k < 4; ++k) {
      text += ',';
      text += std::to_string(0.05 + scales[k] * load + 0.003 * std::sin(17.0 * i + 5 * k));
    }
    text += '\n';
  }
  return text;
}

TEST(IdentifySensor, TellsTable41AndWritesARobotThatHasIt) {
  const Workspace w;
  write_text(w / "weights.csv", weights());
  const Result result = w.sinew({"identify", "sensor", "weights.csv", "--json", "--average",
                                 "--base", "robots/leg/robot.toml", "-o", "my-leg.toml"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  const double errors[] = {0.7, 5.6, 0.4, -6.0};
  for (std::size_t i = 0; i < 4; ++i) {
    const Json& sensor = out["sensors"][i];
    EXPECT_NEAR(sensor["deviation_percent"], errors[i], 0.2);
    EXPECT_EQ(sensor["chosen"], "line");
    EXPECT_LT(sensor["held_out"]["rmse_percent"], 0.2);
    EXPECT_EQ(sensor["models"].size(), 3u);
  }

  const Result check = w.sinew({"check", "my-leg.toml"});
  EXPECT_EQ(check.code, 0) << check.err;
  const Result show = w.sinew({"show", "my-leg.toml", "--json"});
  ASSERT_EQ(show.code, 0) << show.err;
  EXPECT_THAT(show.out, HasSubstr("identify sensor weights.csv"));
  EXPECT_THAT(show.out, HasSubstr("the average of weights.csv"));
}

TEST(IdentifySensor, ScoresItselfOnAnotherCalibration) {
  const Workspace w;
  write_text(w / "a.csv", "angle [deg],knee [V]\n0,1\n30,1.457\n60,1.913\n90,2.37\n");
  write_text(w / "b.csv", "angle [deg],knee [V]\n15,1.328\n75,2.241\n");  // 0.1 V higher
  const Result result = w.sinew({"identify", "sensor", "a.csv", "--hold-out", "b.csv", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  EXPECT_NEAR(out["held_out"]["rmse"], 0.1, 0.002);
  EXPECT_EQ(out["sensors"][0]["scale_unit"], "rad/V");
  EXPECT_NEAR(out["sensors"][0]["scale"], 1.147, 0.001);
}

TEST(IdentifySensor, RefusesWhatARobotDoesNotHave) {
  const Workspace w;
  write_text(w / "weights.csv", "load [N],hip_angle [V]\n0,0\n1,1\n2,2\n");
  const Words words{"identify", "sensor", "weights.csv",          "-o",
                    "x.toml",   "--base", "robots/leg/robot.toml"};
  const Result kind = w.sinew(words);
  EXPECT_EQ(kind.code, 1);
  EXPECT_THAT(kind.err, HasSubstr("sensor.hip_angle.kind: found another kind; expected tension"));
  write_text(w / "weights.csv", "load [N],hip_flexor_tensio [V]\n0,0\n1,1\n2,2\n");
  EXPECT_THAT(w.sinew(words).err, HasSubstr("try \"hip_flexor_tension\""));
  EXPECT_FALSE(std::filesystem::exists(w / "x.toml"));
}

TEST(ForceBeam, PredictsTheThesisTransducer) {
  const Workspace w;
  const Result result = w.sinew({"force-beam", "--json"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  EXPECT_NEAR(out["sensitivity_V_per_N"].get<double>() * 1.0_lbf, 0.17, 0.001);
  EXPECT_NEAR(out["yield_load_N"], 60.0_lbf, 0.1);
  EXPECT_NEAR(out["factor_of_safety"], 2, 0.001);
  EXPECT_NEAR(out["clip_load_N"], 29.4_lbf, 0.05_lbf);
}

TEST(ForceBeam, SaysWhereItEndsAndWhatItDoesNotTake) {
  const Workspace w;
  EXPECT_THAT(w.sinew({"force-beam", "--load", "61 lbf"}).err, HasSubstr("the beam yields"));
  const Result beyond = w.sinew({"force-beam", "--gages", "0.8 in"});
  EXPECT_EQ(beyond.code, 2);
  EXPECT_THAT(beyond.err, AllOf(HasSubstr("--gages: found \"0.8 in\""), HasSubstr("0.75 in")));
  EXPECT_EQ(w.sinew({"force-beam", "--height", "0 in"}).code, 2);
  EXPECT_EQ(w.sinew({"force-beam", "--bridge", "wheatstone"}).code, 2);
}

}  // namespace
}  // namespace sinew::test::identify_sensor_test
