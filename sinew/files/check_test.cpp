// Check of files of each kind.
#include "sinew/files/check.h"
#include "tests/places.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace sinew::files::check_test {
namespace {

namespace fs = std::filesystem;
const std::string root = sinew::test::source_dir() + "/";

class Written {
 public:
  Written(const std::string& name, const std::string& text) {
    std::string pattern = fs::temp_directory_path() / "sinew-files-XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
    std::ofstream(folder_ / name) << text;
    path_ = (folder_ / name).string();
  }
  ~Written() { fs::remove_all(folder_); }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  const std::string& path() const { return path_; }

 private:
  fs::path folder_;
  std::string path_;
};

bool says(const std::vector<std::string>& sentences, const std::string& words) {
  for (const std::string& sentence : sentences)
    if (sentence.find(words) != sentence.npos) return true;
  return false;
}

TEST(Check, FindsNothingWrongWithAFileOfEachKind) {
  for (const char* file :
       {"experiments/walk-test-1.toml", "robots/leg/robot.toml", "robots/leg/actuator.toml",
        "robots/leg/valves.toml", "robots/leg/wiring.toml", "robots/leg/predict.dat"}) {
    const Finding found = check(root + file);
    EXPECT_TRUE(found.problems.empty()) << file << ": " << found.problems.front();
    EXPECT_EQ(found.file, root + file);
  }
}

TEST(Check, ReturnsWhatIsWrongWithItsPlaceAndNeverThrows) {
  const Written typo("robot.toml", "format = \"sinew.robot/1\"\nbase = \"" + root +
                                       "robots/leg/robot.toml\"\n[trolley]\ndrags = \"1 lbf\"\n");
  const Finding found = check(typo.path());
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_EQ(found.problems[0].find(typo.path() + ":4:"), 0u) << found.problems[0];
  EXPECT_TRUE(says(found.problems, "drag"));
  for (const char* text : {"", "format = 1", "format = \"sinew.nothing/1\"", "\xff\xfe", "[["}) {
    const Written file("x.toml", text);
    EXPECT_FALSE(check(file.path()).problems.empty()) << text;
  }
  EXPECT_FALSE(check("/nowhere/at-all.toml").problems.empty());
  const Written log("x.mcap", "no log");
  EXPECT_FALSE(check(log.path()).problems.empty());
}

TEST(Check, ReportsWhatAnExperimentBreaksAndWhatNeverActs) {
  const std::string base = "format = \"sinew.experiment/2\"\nbase = \"" + root +
                           "experiments/walk-test-1.toml\"\ntitle = \"broken\"\n";
  const Written broken("broken.toml", base +
                                          "[[fault]]\nat = \"1 s\"\nof = \"hip_flexor.inlet\"\n"
                                          "what = \"stuck open\"\nfor = \"0.2 s\"\n"
                                          "[[fault]]\nat = \"3000 s\"\nof = \"hip_flexor.inlet\"\n"
                                          "what = \"stuck open\"\nfor = \"0.2 s\"\n");
  const Finding found = check(broken.path());
  EXPECT_TRUE(found.problems.empty()) << found.problems.front();
  EXPECT_EQ(found.faults.size(), 2u);
  EXPECT_TRUE(says(found.warnings, "fault[1] never acts"));
  EXPECT_FALSE(says(found.warnings, "fault[0] never acts"));
}

}  // namespace
}  // namespace sinew::files::check_test
