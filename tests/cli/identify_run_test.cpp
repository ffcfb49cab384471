// `identify run` from the outside: numbers of a machine from a run of it, and what is refused.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::identify_run_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

const Words run_bench{
    "run", "experiments/one-joint.toml", "--set", "sequence.repeat=1", "--quiet", "--no-report"};

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// A short run on the bench in `bench`, of a machine whose friction is another one.
void run_on_the_bench(const Workspace& w) {
  const Result result =
      w.sinew(with(run_bench, {"--set", "joint.lever.dry_friction=0.07 N m", "-o", "bench"}));
  ASSERT_EQ(result.code, 0) << result.err;
}

Result identified(const Workspace& w, const Words& more) {
  return w.sinew(with({"identify", "run", "bench", "--threads", "1", "--quiet"}, more));
}

TEST(IdentifyRun, FindsTheFrictionThatWasChangedAndWritesIt) {
  const Workspace w;
  run_on_the_bench(w);
  const Result result =
      identified(w, {"--fit", "friction", "--start", "joint.lever.dry_friction=0.05 N m", "--json",
                     "--base", "robots/one-joint/robot.toml", "-o", "mine.toml"});
  ASSERT_EQ(result.code, 0) << result.err;
  const Json out = Json::parse(result.out);
  const Json& found = out["parameters"][0];
  EXPECT_EQ(found["name"], "joint.lever.dry_friction");
  EXPECT_LT(found["low"], 0.07);
  EXPECT_GT(found["high"], 0.07);
  EXPECT_LT(found["high"].get<double>() - found["low"].get<double>(), 0.002);
  EXPECT_EQ(out["rough"], false);
  EXPECT_LT(out["roughness"], 0.05);
  EXPECT_EQ(out["intervals"], true);
  EXPECT_EQ(out["landings"], 0);

  EXPECT_EQ(w.sinew({"check", "mine.toml"}).code, 0);
  EXPECT_THAT(read_text(w / "mine.toml"),
              AllOf(HasSubstr("dry_friction"), HasSubstr("uncertainty"), HasSubstr("fit = true")));
  EXPECT_THAT(read_text(w / "mine.html"), HasSubstr("lever_angle"));
}

TEST(IdentifyRun, TellsWhatIsLeftOfEachChannel) {
  const Workspace w;
  run_on_the_bench(w);
  const Result result = identified(
      w, {"--fit", "friction", "--freeze", "joint.lever.damping=0.4 lbf in s/rad", "--prior",
          "joint.lever.dry_friction=0.07 N m ± 0.01 N m", "--hold-out", "0.3"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("in % of each sensor's noise\n"), HasSubstr("lever_angle: "),
                    HasSubstr("joint.lever.dry_friction"), HasSubstr("held out: the run from"),
                    Not(HasSubstr("joint.lever.damping"))));
}

// A leg that walks: the numbers, and in place of intervals why there are none.
TEST(IdentifyRun, SaysWhyAWalkHasNoIntervals) {
  const Workspace w;
  ASSERT_EQ(w.sinew({"run", "experiments/walk-test-1.toml", "--set", "sequence.repeat=1", "--quiet",
                     "--no-report", "-o", "bench"})
                .code,
            0);
  const Words words{"--fit", "joint.knee.damping"};
  const Result json = identified(w, with(words, {"--json"}));
  ASSERT_EQ(json.code, 0) << json.err;
  const Json out = Json::parse(json.out);
  EXPECT_EQ(out["intervals"], false);
  EXPECT_GT(out["landings"], 0);
  EXPECT_THAT(out["no_intervals_because"].get<std::string>(), HasSubstr("a foot comes down"));
  EXPECT_TRUE(out["parameters"][0]["low"].is_null());
  EXPECT_TRUE(out["parameters"][0]["high"].is_null());

  const Result text = w.sinew(with({"identify", "run", "bench", "--threads", "1"}, words));
  EXPECT_THAT(text.out, HasSubstr("no interval"));
  EXPECT_THAT(text.err, HasSubstr("intervals are not given: a foot comes down on the ground"));
}

// A table of somebody's knows edges to one of its rows; duties beside them say more, and are taken.
TEST(IdentifyRun, TakesAnImportedRecording) {
  const Workspace w;
  run_on_the_bench(w);
  const auto imported = [&](const std::string& channels, const std::string& folder) {
    Words words{"export",
                "bench",
                "--csv",
                "-o",
                folder + ".csv",
                "--quiet",
                "--channels",
                "/joint/lever/angle",
                "/muscle/flexor/tension",
                channels};
    EXPECT_EQ(w.sinew(words).code, 0);
    words = {"import", folder + ".csv", "--experiment", "experiments/one-joint.toml",
             "-o",     folder,          "--quiet"};
    EXPECT_EQ(w.sinew(words).code, 0);
    return w.sinew({"identify", "run", folder, "--fit", "friction", "--threads", "1", "--json"});
  };
  const Result result = imported("*", "table");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("edges were made from duties"));
  const Json found = Json::parse(result.out)["parameters"][0];
  EXPECT_NEAR(found["value"], 0.07, 0.001);
  EXPECT_THAT(imported("/valve/*", "edges").err,
              HasSubstr("knows when 4 valves switch to one of its rows only"));
  EXPECT_THAT(imported("/joint/*", "none").err,
              HasSubstr("expected the edges of every valve, or its duty in each period"));
}

TEST(IdentifyRun, RefusesWrongWordsInSentences) {
  const Workspace w;
  run_on_the_bench(w);
  const auto refused = [&](const Words& words) {
    const Result result = identified(w, words);
    EXPECT_NE(result.code, 0);
    return result.err;
  };
  EXPECT_EQ(refused({"--hold-out", "20"}),
            "--hold-out: found \"20\"; expected a share of the run, from 0 to below 90 %; try "
            "\"20 %\" or \"0.2\"\n");
  EXPECT_EQ(refused({"--hold-out", "95 %"}),
            "--hold-out: found \"95 %\"; expected a share of the run, from 0 to below 90 %; try "
            "\"20 %\"\n");
  EXPECT_EQ(
      refused({"--fit", "frction"}),
      "--fit: found \"frction\"; expected a number's key of this robot, or friction, damping, "
      "dead-time, volume, leak; try \"friction\"\n");
  EXPECT_THAT(refused({"--fit", "joint.lever.dampng"}), HasSubstr("try \"joint.lever.damping\""));
  EXPECT_THAT(refused({"--prior", "joint.lever.dampng=1 N m s/rad ± 1 N m s/rad"}),
              HasSubstr("--prior: found \"joint.lever.dampng\"; expected a number's key of this "
                        "robot; try \"joint.lever.damping\""));
  EXPECT_THAT(refused({"--prior", "joint.lever.damping=0.05 N m s/rad"}),
              HasSubstr("expected a key, its value and its standard deviation"));
  EXPECT_EQ(refused({"--fit", "damping", "--prior", "joint.lever.dry_friction=1 N m +- 1 N m"}),
            "--prior: found \"joint.lever.dry_friction\", which is not fitted; expected one of "
            "joint.lever.damping; try to fit it too\n");
  EXPECT_THAT(refused({"--freeze", "joint.lever.damping"}),
              HasSubstr("--freeze: found \"joint.lever.damping\"; expected a key and its value"));
  EXPECT_THAT(
      refused({"--fit", "joint.lever.damping", "--freeze", "joint.lever.damping=0.04 N m s/rad"}),
      HasSubstr("--freeze: found \"joint.lever.damping\", which is to be fitted"));
  EXPECT_THAT(refused({"--from", "1 h"}), HasSubstr("a time within the run of"));
  EXPECT_THAT(refused({"--base", "robots/one-joint/robot.toml"}),
              HasSubstr("--base: found no --out"));
  EXPECT_THAT(w.sinew({"identify", "run", "nothing"}).err,
              HasSubstr("nothing: found nothing; expected the folder of a run, or its log"));
}

}  // namespace
}  // namespace sinew::test::identify_run_test
