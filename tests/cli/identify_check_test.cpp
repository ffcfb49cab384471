// `identify check` from the outside, and `identify static`, which asks the same first.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::identify_check_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

// Names a shipped map and its columns.
Words of_map(const std::string& method, const Words& more) {
  Words out{"identify",
            method,
            SINEW_SOURCE_DIR "/data/martens_boblan_2017/DMSP-10-250_force_map.csv",
            "--map",
            "force=F_N,pressure=P_gauge_Pa,length=L_m",
            "--unit",
            "F_N=N",
            "--unit",
            "P_gauge_Pa=Pa gauge",
            "--unit",
            "L_m=m"};
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

TEST(IdentifyCheck, SaysWhatItRecognisedAndWhatAFitCouldTell) {
  const Workspace w;
  const Words good = {"--rest-length", "250 mm", "--diameter", "10 mm"};
  const Result words = w.sinew(of_map("check", good));
  EXPECT_EQ(words.code, 0) << words.err;
  EXPECT_THAT(words.out, AllOf(HasSubstr("mount [mm]"), HasSubstr("noise of force"),
                               HasSubstr("green   rest length"), HasSubstr("a fit could tell"),
                               HasSubstr("the same pressures on the way up and on the way down")));

  Words as_json = good;
  as_json.emplace_back("--json");
  const Json json = Json::parse(w.sinew(of_map("check", as_json)).out);
  EXPECT_EQ(json["format"], "sinew.check/1");
  EXPECT_EQ(json["red"], false);
  EXPECT_EQ(json["recognised"]["files"][0]["rows"], 85);
  EXPECT_EQ(json["recognised"]["mounts"].size(), 5u);
  EXPECT_EQ(json["recognised"]["mounts"][4]["pressures"], 17);
  EXPECT_EQ(json["determined"]["parameters"][0]["name"], "thread_length");
}

TEST(IdentifyCheck, TakesWhatStaticTakes) {
  const Workspace w;
  const Result some = w.sinew(
      of_map("check", {"--rest-length", "250 mm", "--fit-where", "L_m=0.198,0.25", "--json"}));
  ASSERT_EQ(some.code, 0) << some.err;
  const Json mounts = Json::parse(some.out)["recognised"]["mounts"];
  EXPECT_EQ(mounts[1]["points"], 0);
  EXPECT_EQ(mounts[1]["held_out"], 17);
  EXPECT_EQ(mounts[4]["points"], 17);
  EXPECT_EQ(w.sinew(of_map("check", {"--branch", "sideways"})).code, 2);
  EXPECT_EQ(w.sinew(of_map("check", {"--hold-out", "nonsense"})).code, 2);
  const Result diameter = w.sinew(of_map("check", {"--diameter", "10 kg"}));
  EXPECT_EQ(diameter.code, 2);
  EXPECT_THAT(diameter.err, HasSubstr("--diameter: found"));
}

// Two things are wrong: both are told, in the words of the command line, and nothing is written.
// Anyway they are warnings of the report, of its JSON and of its page.
TEST(IdentifyCheck, StaticRefusesWhatIsRedUnlessItIsToBeFittedAnyway) {
  const Workspace w;
  const Words wrong = {"--rest-length", "230 mm", "--diameter", "40 mm", "-o", "mine.toml"};
  const Result refused = w.sinew(of_map("static", wrong));
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("rest length: The longest mount, 250 mm, is 108.7 %"),
                                 HasSubstr("force unit: 542.5 N"), HasSubstr("1 lbf is 4.448 N"),
                                 HasSubstr("check: found 2 red"), HasSubstr("--anyway"),
                                 Not(HasSubstr("=true"))));
  EXPECT_FALSE(std::filesystem::exists(w / "mine.toml"));
  EXPECT_EQ(w.sinew(of_map("check", {"--rest-length", "230 mm"})).code, 1);

  Words anyway = wrong;
  anyway.insert(anyway.end(), {"--anyway", "--model", "saturating-elastic", "--json"});
  const Result fitted = w.sinew(of_map("static", anyway));
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  EXPECT_THAT(fitted.err, HasSubstr("warning: rest length: The longest mount"));
  const Json warnings = Json::parse(fitted.out)["warnings"];
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_THAT(warnings[0].get<std::string>(), HasSubstr("force unit"));
  EXPECT_TRUE(std::filesystem::exists(w / "mine.toml"));
  if (!SINEW_HAS_PAGE) return;
  std::ifstream file(w / "mine.html");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  EXPECT_THAT(page, HasSubstr("is 108.7 % of the rest length"));
}

// Good data are quiet.
TEST(IdentifyCheck, StaticWarnsOfNothingInGoodData) {
  const Workspace w;
  const Result good = w.sinew(of_map(
      "static", {"--rest-length", "250 mm", "--diameter", "10 mm", "--model", "saturating"}));
  EXPECT_EQ(good.code, 0);
  EXPECT_THAT(good.err, Not(HasSubstr("warning")));
}

}  // namespace
}  // namespace sinew::test::identify_check_test
