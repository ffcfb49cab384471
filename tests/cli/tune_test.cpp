// `tune`: the best candidate, its file, and what is refused.
#include <gmock/gmock.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"

namespace sinew::test::tune_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const std::string lever =
    "format = \"sinew.tuning/1\"\n"
    "title = \"A lever that follows\"\n"
    "experiment = \"experiments/one-joint.toml\"\n"
    "tune = [\"joint.lever.angle_gain=0.05:0.3 %/count log\"]\n"
    "minimize = [\"joints.lever.tracking_rms_rad [deg]\"]\n"
    "where = [\"joints.lever.passiveness >= 50 %\"]\n"
    "population = 6\n"
    "generations = 3\n";

class Tune : public ::testing::Test {
 protected:
  Tune() { write_text(w / "lever.toml", lever); }

  Result tune(const Words& more) {
    Words words = {"tune", "lever.toml"};
    words.insert(words.end(), more.begin(), more.end());
    return w.sinew(words);
  }

  Workspace w;
};

TEST_F(Tune, PrintsTheBestBesideWhatIsThere) {
  const Result r = tune({"--best", "best.toml"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.out,
              AllOf(HasSubstr("18 candidates in 3 generations, 1 run each"), HasSubstr("as it is"),
                    HasSubstr("sinew run experiments/one-joint.toml "
                              "--set \"joint.lever.angle_gain=")));
  EXPECT_THAT(r.err, AllOf(HasSubstr("generation 3 of 3: best joints.lever.tracking_rms [deg] = "),
                           HasSubstr("lever.db\n")));
  // The file is an experiment like any other, and runs to the same figure.
  const Json best = Json::parse(tune({"--json"}).out).at("best").at(0);
  const Result run = w.sinew({"run", "best.toml", "-o", "r", "--json", "--quiet"});
  EXPECT_EQ(run.code, 0) << run.err;
  const double rms = Json::parse(run.out).at("joints").at("lever").at("tracking_rms_rad");
  EXPECT_NEAR(rms * 180 / 3.14159265358979,
              best.at("goals").at("joints.lever.tracking_rms [deg]").get<double>(), 1e-6);
  EXPECT_EQ(w.sinew({"check", "best.toml", "lever.toml"}).code, 0);
}

TEST_F(Tune, AnotherCandidateCanBeWrittenFromItsStudy) {
  EXPECT_EQ(tune({"-o", "all.csv"}).code, 0);
  const Result r = tune({"--best", "c.toml", "--candidate", "4"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("lever.db: 18 of 18 runs are there"));
  const std::string table = read_text(w / "all.csv");
  const std::string row = table.substr(table.find("\n4,") + 1);
  std::string gain;  // behind candidate, generation, feasible, violation, holds
  std::istringstream cells(row);
  for (int i = 0; i < 6; ++i) std::getline(cells, gain, ',');
  EXPECT_THAT(read_text(w / "c.toml"),
              AllOf(HasSubstr("# Candidate 4 (generation 0) of lever.toml"),
                    HasSubstr("angle_gain = { value = \"" + gain + " %/count\"")));
}

TEST_F(Tune, NothingFeasibleIsAFailureThatSaysHowCloseItCame) {
  w.edit("lever.toml", ">= 50 %", ">= 99.99 %");
  const Result r = tune({});
  EXPECT_EQ(r.code, 1);
  EXPECT_THAT(r.out, HasSubstr("nothing keeps every limit; the closest:"));
}

TEST_F(Tune, RefusesWhatCannotBe) {
  const auto refused = [&](const Words& more, const std::string& words) {
    const Result r = tune(more);
    EXPECT_NE(r.code, 0) << words;
    EXPECT_THAT(r.err, HasSubstr(words));
  };
  refused({"--best", "experiments/one-joint.toml", "--force"}, "experiments/one-joint.toml");
  EXPECT_EQ(tune({"--best", "best.toml"}).code, 0);
  refused({"--best", "best.toml"}, "--force");
  refused({"--best", "b.toml", "--candidate", "18"}, "--candidate: found 18; expected the number");
  refused({"--candidate", "1"}, "--best");
  refused({"--results", "none/s.db"}, "none");
  write_text(w / "text.db", "no database, but longer than its magic word");
  refused({"--results", "text.db"}, "is no database of SQLite");
  w.edit("lever.toml", "joints.lever.tracking_rms_rad", "joints.lever.trakcing_rms_rad");
  refused({"--results", "new.db"}, "joints.lever.tracking_rms_rad");
  w.edit("lever.toml", "population = 6", "population = 4");
  refused({}, "lever.toml:7:1: population: found 4; expected 5 or more");
}

// As where it was built without pagmo: nothing is begun. The program looks for its modules beside
// its own folder, so the copy gets a folder in the workspace, where no module can be.
TEST_F(Tune, IsRefusedWithoutItsModule) {
  fs::create_directory(w / "bin");
  fs::copy_file(SINEW_PROGRAM, w / "bin/alone");
  const std::string line = "cd " + w.path().string() + " && bin/alone tune lever.toml 2>err";
  EXPECT_NE(std::system(line.c_str()), 0);
  EXPECT_THAT(read_text(w / "err"),
              AllOf(HasSubstr("this program was built without pagmo"), HasSubstr("libpagmo-dev")));
}

// What a tuning's file of experiments/tuned says of itself comes out again.
TEST(Tuned, ShippedCandidatesReachWhatTheySay) {
  const Workspace w;
  int files = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(SINEW_SOURCE_DIR) / "experiments/tuned")) {
    const std::string text = read_text(entry.path());
    const std::size_t begin = text.find("#   ") + 4, equals = text.find(" = ", begin);
    const std::string figure = text.substr(begin, equals - begin);
    const double said = std::stod(text.substr(equals + 3));
    // In a heading a key's own unit is left out: "trolley.mean_speed [in/s]".
    const std::map<std::string, std::string> keys = {
        {"trolley.mean_speed [in/s]", "trolley.mean_speed_m_per_s [in/s]"},
        {"foot.tracking_rms [in]", "foot.tracking_rms_m [in]"}};
    ASSERT_TRUE(keys.contains(figure)) << figure;
    const Result r =
        w.sinew({"sweep", entry.path().string(), "--seeds", "2", "--report", keys.at(figure)});
    ASSERT_EQ(r.code, 0) << r.err;
    std::istringstream rows(r.out);
    std::string row;
    double sum = 0;
    std::getline(rows, row);
    while (std::getline(rows, row)) sum += std::stod(row.substr(row.find(',') + 1));
    EXPECT_NEAR(sum / 2, said, 0.03 * said) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 2);
}

// docs/tuned.md: twice the speed of test 1 with little air, also with seeds that the tuning did not
// see.
TEST(Tuned, TheFasterWalkKeepsWhatWasAskedWithEverySeed) {
  const Workspace w;
  const auto file = fs::path(SINEW_SOURCE_DIR) / "experiments/tuned/faster-walk.toml";
  const Result r = w.sinew({"sweep", file.string(), "--seeds", "10", "--report",
                            "trolley.mean_speed_m_per_s [in/s], passiveness [%], "
                            "phases.swing.joints.hip.most_turning_points, "
                            "phases.swing.joints.knee.most_turning_points"});
  ASSERT_EQ(r.code, 0) << r.err;
  std::istringstream rows(r.out);
  std::string row;
  double sum = 0;
  int runs = 0;
  std::getline(rows, row);
  for (; std::getline(rows, row); ++runs) {
    double seed = 0, speed = 0, passiveness = 0, hip = 0, knee = 0;
    ASSERT_EQ(
        std::sscanf(row.c_str(), "%lf,%lf,%lf,%lf,%lf", &seed, &speed, &passiveness, &hip, &knee),
        5)
        << row;
    sum += speed;
    EXPECT_GE(passiveness, 90) << row;
    EXPECT_LE(std::max(hip, knee), 2) << row;
  }
  ASSERT_EQ(runs, 10);
  EXPECT_GE(sum / runs, 9) << "[in/s]";
}

}  // namespace
}  // namespace sinew::test::tune_test
