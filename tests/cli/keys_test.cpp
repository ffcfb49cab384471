// `sinew keys` by the program.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace sinew::test::keys_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(Keys, WithoutAWordTellsTheKindsAndWhatStandsAtTheirTop) {
  const Workspace w;
  const Result r = w.sinew({"keys"});
  EXPECT_EQ(r.code, 0);
  for (const char* word : {"robot ", "joint", "actuator ", "phase", "rig ", "element", "tuning "})
    EXPECT_THAT(r.out, HasSubstr(word));
  EXPECT_THAT(r.out, Not(HasSubstr("joint.")));
}

TEST(Keys, AWordFindsUnitRangeDefaultAndMeaning) {
  const Workspace w;
  const Result r = w.sinew({"keys", "joint.hip.damping"});
  EXPECT_EQ(r.code, 0);
  EXPECT_THAT(
      r.out, AllOf(StartsWith("Robot: robots/*/robot.toml\n"), HasSubstr("joint.<name>.damping"),
                   HasSubstr("N m s/rad"), HasSubstr("at least 0 N m s/rad"), HasSubstr("required"),
                   HasSubstr("viscous")));
  const Result all = w.sinew({"keys", "damping"});
  EXPECT_THAT(all.out, AllOf(HasSubstr("actuator.<name>.long_end.damping"),
                             HasSubstr("trolley.stop_damping"), Not(HasSubstr("robot_name"))));
}

TEST(Keys, JsonHasTheSame) {
  const Workspace w;
  const Result r = w.sinew({"keys", "phase.swing.stiffness.hip", "--json"});
  ASSERT_EQ(r.code, 0) << r.err;
  const auto all = nlohmann::json::parse(r.out);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0]["key"], "phase.<name>.stiffness.<name>");
  EXPECT_EQ(all[0]["unit"], "N m/rad");
  EXPECT_EQ(all[0]["max"], 1e5);
  EXPECT_EQ(all[0]["why"], "the low level takes no more");
}

// Write the page again with: sinew keys --page > docs/keys.md
TEST(Keys, ThePageInDocsIsTodays) {
  const Workspace w;
  const Result r = w.sinew({"keys", "--page"});
  ASSERT_EQ(r.code, 0);
  EXPECT_TRUE(r.out == read_text(SINEW_SOURCE_DIR "/docs/keys.md"))
      << "found another docs/keys.md; expected what `sinew keys --page` writes; write it again";
}

// Wrong words end with code 1 and a message that says what there is; wrong lines with code 2.
struct Wrong {
  Words words;
  int code;
  std::string says;
};

TEST(Keys, WhatIsWrongIsToldWithTheNearest) {
  const Workspace w;
  const std::string key = "expected a key, the beginning of one, or a word of its description";
  const std::string kinds = "expected robot, actuator, valves, wiring, experiment, rig, plan";
  for (const Wrong& wrong : std::vector<Wrong>{
           {{"dampnig"}, 1, "found \"dampnig\"; " + key + "; try damping"},
           {{"joint.hip.dampnig"}, 1, "; try joint.hip.damping"},
           {{"joint.hip.damping.more"}, 1, key},
           {{"joint..damping"}, 1, "found \"joint..damping\""},
           {{"muscle.hip.mount_lenght"}, 1, "try muscle.hip.mount_length"},
           {{"zzz"}, 1, "found \"zzz\"; " + key + "; try sinew keys, for the tables"},
           {{""}, 1, "found \"\""},
           {{"damping", "zzz"}, 1, "found \"zzz\""},
           {{"damping", "title"}, 1, "expected a word that a key has beside the others"},
           {{"\xff\xfe"}, 1, "expected a key"},
           {{"pola\xc3\xa4re"}, 1, "found \"pola\xc3\xa4re\""},
           {{std::string(5000, 'x')}, 1, "…\""},
           {{"damping", "--kind", "robt"}, 2, "--kind: found \"robt\"; " + kinds},
           {{"damping", "--kind", "plan"}, 1, "expected a key of kind plan"},
           {{"--kind", "Robot"}, 2, "try \"robot\""},
           {{"--kind", "sinew.robot/1"}, 2, kinds},
           {{"--schema", "robots"}, 2, "schema: found \"robots\"; " + kinds},
           {{"--schema", "any"}, 2, "schema: found \"any\""},
           {{"--schema"}, 2, "--schema"},
           {{"--kind"}, 2, "--kind"},
           {{"--schema", "rig", "damping"}, 2, "--schema"},
           {{"--schema", "rig", "--json"}, 2, "--schema"},
           {{"--page", "damping"}, 2, "--page"},
           {{"--jsn"}, 2, "--jsn"}}) {
    Words words{"keys"};
    words.insert(words.end(), wrong.words.begin(), wrong.words.end());
    const Result r = w.sinew(words);
    EXPECT_EQ(r.code, wrong.code) << wrong.says;
    EXPECT_THAT(r.err, HasSubstr(wrong.says));
    EXPECT_EQ(r.out, "") << wrong.says;
  }
}

}  // namespace
}  // namespace sinew::test::keys_test
