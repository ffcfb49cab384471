// A tuning's file is parsed, or refused with the place of the fault.
#include "sinew/tune/optimizer/tuning.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "sinew/config/diagnostics.h"
#include "tests/places.h"

namespace sinew::tune::tuning_test {
namespace {

namespace fs = std::filesystem;

class TuningTest : public ::testing::Test {
 protected:
  TuningTest() { fs::create_directories(folder_); }
  ~TuningTest() override { fs::remove_all(folder_); }

  // Returns a valid file with one line replaced.
  std::string with(const std::string& line, const std::string& other) const {
    std::string text =
        "format = \"sinew.tuning/1\"\n"
        "title = \"t\"\n"
        "experiment = \"" +
        sinew::test::source_dir() +
        "/experiments/one-joint.toml\"\n"
        "tune = [\"joint.lever.angle_gain=0.01:0.3 %/count log\"]\n"
        "minimize = [\"joints.lever.tracking_rms_rad [deg]\"]\n"
        "where = [\"joints.lever.passiveness >= 50 %\"]\n"
        "generations = 4\n";
    const std::size_t at = text.find(line);
    EXPECT_NE(at, text.npos) << line;
    const std::string path = (folder_ / "t.toml").string();
    std::ofstream(path) << text.replace(at, line.size(), other);
    return path;
  }

  std::string refusal(const std::string& line, const std::string& other) const {
    try {
      load_tuning(with(line, other));
    } catch (const config::Error& e) {
      return e.what();
    }
    return "";
  }

  void refuses(const std::string& line, const std::string& other, const std::string& words) const {
    const std::string said = refusal(line, other);
    EXPECT_NE(said.find(words), std::string::npos) << words << "\nbut: " << said;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("sinew-tuning-" + std::to_string(getpid()));
};

TEST_F(TuningTest, IsUnderstood) {
  const Tuning t = load_tuning(with("title", "title"));
  EXPECT_EQ(t.method.kind, MethodKind::cmaes);
  EXPECT_EQ(t.method.population, 16U);
  EXPECT_EQ(points(t.runs), 64U);
  EXPECT_EQ(t.goals.limits[0].limit, 50) << "in the unit it is written in";
  ASSERT_EQ(t.start.size(), 1U);
  EXPECT_GT(t.start[0], 0);
}

TEST_F(TuningTest, TakesNumbersBesideWhatIsTuned) {
  const Tuning t = load_tuning(with("generations = 4", "generations = 4\nstep = 0.1\nhold = 0.9"));
  EXPECT_EQ(t.method.step, 0.1);
  EXPECT_EQ(t.goals.hold, 0.9);
}

TEST_F(TuningTest, ReportsWhereAndWhatIsWrong) {
  refuses("generations = 4", "generations = 0", "t.toml:7:1: generations");
  refuses("generations = 4", "generation = 4", "generations");
  refuses("minimize", "maximise", "maximise");
  refuses("minimize = [\"joints.lever.tracking_rms_rad [deg]\"]", "", "no goal");
  refuses("tune = [\"joint.lever", "tune = [\"joint.lever.angle_gain=0.1 %/count\"]\n#",
          "t.toml:4:9: tune: found \"0.1 %/count\"; expected KEY=from:to");
  refuses("tune = [\"joint.lever.angle_gain", "tune = [\"joint.lever.angel_gain", "angle_gain");
  refuses("tune = [\"joint.lever.angle_gain=0.01:0.3 %/count log\"]",
          "tune = [\"joint.lever.angle_gain=0.3:0.3 %/count\"]", "a low end below the high end");
  refuses(">= 50 %\"", ">= 50 %\", \"joints.lever.passiveness < 0.4\"",
          "expected limits that a number can keep together");
  refuses("[deg]", "[lbf]", "t.toml:5:13: minimize: found");
  refuses("generations = 4", "maximize = [\"air_used_kg\"]\npopulation = 6", "a multiple of 4");
  refuses("generations = 4", "method = \"cmaes\"\nmaximize = [\"air_used_kg\"]",
          "\"cmaes\" with several goals");
  refuses("generations = 4", "method = \"nsga2\"", "\"nsga2\" with one goal");
  refuses("generations = 4", "draws = 4", "found no spread");
  refuses("generations = 4", "generations = 100000\nseeds = 10",
          "t.toml:8:1: seeds: found 1600000 x 10");
  refuses("generations = 4", "[[case]]\nname = \"a\"\nset = [\"sequence.repaet=2\"]", "repeat");
  refuses("generations = 4", "[[case]]\nname = \"a\"\n[[case]]\nname = \"a\"",
          "\"a\" twice; expected a name of its own");
  refuses("tune = [\"joint.lever.angle_gain=0.01:0.3 %/count log\"]", "tune = [\"robot=1:2\"]",
          "found robot: a range; expected a key that has numbers");
  refuses("sinew.tuning/1", "sinew.plan/1", "sinew.tuning/1");
}

// A tuning made by a program has no file that a fault could name.
TEST(TuningInCode, IsRefusedWithoutAPlace) {
  try {
    (void)tuning_of("", TuningFile{});
    FAIL();
  } catch (const config::Error& e) {
    EXPECT_EQ(std::string(e.what()).find("maximize: found no goal"), 0U) << e.what();
  }
}

}  // namespace
}  // namespace sinew::tune::tuning_test
