// The thesis's own files: out.dat there and back, gain.dat.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::thesis_files_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

const std::string walk = "experiments/walk-test-1.toml";

// "joints.hip.min_angle_rad" -> its value.
std::map<std::string, double> keys_of(const Workspace& w, const std::string& file) {
  std::map<std::string, double> out;
  const Json flat = Json::parse(read_text(w / file)).flatten();
  for (const auto& [key, value] : flat.items())
    if (value.is_number() && !key.starts_with("/host")) out[key] = value;
  return out;
}

// What a run's summary says of measured channels, its out.dat says too: a count of the desired
// angle, 1e-6 lbf in/rad and whole percents are all that is lost.
TEST(OutDat, OfARunGivesTheSameNumbers) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "ran"}).code, 0);
  ASSERT_EQ(w.sinew({"export", "ran", "--format", "out.dat", "-o", "out.dat"}).code, 0);
  const Result imported = w.sinew({"import", "out.dat", "--experiment", walk, "-o", "again"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  // Before it, without npm, that there is no report.
  EXPECT_NE(imported.err.find("\nagain\n"), std::string::npos) << imported.err;
  const Result analyzed = w.sinew({"analyze", "again", "--json"});
  EXPECT_EQ(analyzed.out, read_text(w / "again/summary.json"));

  const auto ran = keys_of(w, "ran/summary.json"), again = keys_of(w, "again/summary.json");
  EXPECT_GE(again.size(), 60U);
  for (const auto& [key, value] : again) {
    ASSERT_TRUE(ran.count(key)) << key;
    // The file holds nothing of before and after the sequence.
    if (key == "/duration_s" || key.ends_with("/swing_oscillation_rms_rad")) continue;
    // Its last period is cut short where no row follows: 10 ms at 0.4 m/s.
    const bool way = key.starts_with("/trolley/distance");
    const double size = std::max(1.0, std::abs(ran.at(key)));
    EXPECT_NEAR(value, ran.at(key), (way ? 4e-3 : 2e-3) * size) << key;
  }
  for (const char* key : {"/joints/hip/tracking_rms_rad", "/passiveness", "/steps",
                          "/trolley/distance_from_torques_m"})
    EXPECT_TRUE(again.count(key)) << key;
  for (const auto& [key, value] : again) EXPECT_THAT(key, ::testing::Not(HasSubstr("true"))) << key;
}

TEST(OutDat, ThatIsDamagedIsRefusedAndLeavesNothing) {
  const Workspace w;
  write_text(w / "out.dat", "mode timer\nswing 0\n");
  const Result r = w.sinew({"import", "out.dat", "--experiment", walk, "-o", "again"});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.err, StartsWith("out.dat:1:1: found \"mode timer\"; expected the heading"));
  EXPECT_FALSE(std::filesystem::exists(w / "again"));
  EXPECT_THAT(w.sinew({"import", "no.dat", "--experiment", walk}).err, HasSubstr("no.dat"));
}

// Settling opens the four exhausts, by B.1's masks 8 to 11 or by table C-1's 10 to 13.
TEST(Ports, HaveTheBitsOfTheCodeOrOfTheTable) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", walk, "-o", "ran"}).code, 0);
  const Result code = w.sinew({"export", "ran", "--format", "ports"});
  EXPECT_THAT(code.out,
              StartsWith("time [s],port 0 [1],port 1 [1]\n0.0000,255,240\n0.6000,255,255\n"));
  ASSERT_EQ(w.sinew({"run", walk, "-o", "table", "--set", "wiring.bits=table"}).code, 0);
  EXPECT_THAT(w.sinew({"export", "table", "--format", "ports"}).out,
              HasSubstr("\n0.0000,255,195\n0.6000,255,255\n"));
  const Result twice = w.sinew({"run", walk, "--set", "muscle.hip_extensor.inlet.bit=0"});
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, HasSubstr("bit 0, which muscle.hip_flexor.inlet.bit has"));
}

// The two gain files of B.5 are the robot's gains and those of 6.5.
TEST(GainFile, OfTheThesisIsTheLegs) {
  const Workspace w;
  EXPECT_EQ(w.sinew({"check", "robots/leg/gain.dat", "robots/leg/gain-damping.dat"}).code, 0);
  write_text(w / "mine.toml",
             "format = \"sinew.experiment/1\"\nbase = \"experiments/walk-test-1.toml\"\n"
             "files = { gains = \"robots/leg/gain.dat\" }\nrobot = \"robots/leg/robot.toml\"\n");
  ASSERT_EQ(w.sinew({"run", walk, "-o", "own"}).code, 0);
  const Result mine = w.sinew({"run", "mine.toml", "-o", "mine"});
  ASSERT_EQ(mine.code, 0) << mine.err;
  EXPECT_EQ(keys_of(w, "mine/summary.json"), keys_of(w, "own/summary.json"));

  w.edit("mine.toml", "gain.dat", "gain-damping.dat");
  ASSERT_EQ(w.sinew({"run", "mine.toml", "-o", "damped"}).code, 0);
  EXPECT_THAT(read_text(w / "damped/resolved.toml"), HasSubstr("gain.dat, B.5"));
  EXPECT_NE(keys_of(w, "damped/summary.json"), keys_of(w, "own/summary.json"));
}

}  // namespace
}  // namespace sinew::test::thesis_files_test
